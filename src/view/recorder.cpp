#include "view/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/output_file.h"
#include "io/base/replaced_file.h"
#include "io/pictures/png_file.h"
#include "view/film.h"

namespace vorpipe::view {
namespace {

namespace fs = std::filesystem;

class Folder final : public Recorder {
 public:
  Folder(std::string path, std::uint64_t first) : path_(std::move(path)), next_(first) {}

  Result<void> add(const Image& frame) override {
    auto file = OutputFile::create((fs::path(path_) / fmt::format("frame-{:05}.png", next_++)).string());
    if (!file) return tl::unexpected(std::move(file.error()));
    VORPIPE_TRY(writePng(*file, frame.width, frame.height, frame.rgba));
    return file->commit();
  }
  Result<void> finish() override { return {}; }

 private:
  std::string path_;
  std::uint64_t next_;
};

}  // namespace

Result<std::unique_ptr<Recorder>> openRecorder(const std::string& path) {
  if (lowerExtension(path) == ".mp4") return openFilm(path);
  auto frames = openFrames(path, 1);
  if (!frames) return frames;
  const auto isOurs = [](const fs::directory_entry& entry) {
    return isLeftOver(entry.path().filename().string());
  };
  if (!std::ranges::all_of(fs::directory_iterator(path), isOurs)) {
    return inputError(path + ": the folder holds something; frames want an empty one");
  }
  return frames;
}

Result<std::unique_ptr<Recorder>> openFrames(const std::string& folder, std::uint64_t first) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return inputError(fmt::format("{}: {}", folder, code.message()));
  return std::make_unique<Folder>(folder, first);
}

}  // namespace vorpipe::view
