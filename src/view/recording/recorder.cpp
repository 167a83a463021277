#include "view/recording/recorder.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "io/files/error.h"
#include "io/files/extension.h"
#include "io/files/output_file.h"
#include "io/pictures/png_file.h"
#include "view/recording/film.h"

namespace vorpipe::view {
namespace {

namespace fs = std::filesystem;

class Folder final : public Recorder {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {}

  Result<void> add(const Image& frame) override {
    auto file = OutputFile::create((fs::path(path_) / fmt::format("frame-{:05}.png", ++frames_)).string());
    if (!file) return tl::unexpected(std::move(file.error()));
    if (auto written = writePng(*file, frame.width, frame.height, frame.rgba); !written) return written;
    return file->commit();
  }
  Result<void> finish() override { return {}; }

 private:
  std::string path_;
  std::uint64_t frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<Recorder>> openRecorder(const std::string& path) {
  if (lowerExtension(path) == ".mp4") return openFilm(path);
  std::error_code code;
  fs::create_directories(path, code);
  if (code) return inputError(fmt::format("{}: {}", path, code.message()));
  if (!fs::is_empty(path, code)) {
    return inputError(path + ": the folder holds something; frames want an empty one");
  }
  return std::make_unique<Folder>(path);
}

}  // namespace vorpipe::view
