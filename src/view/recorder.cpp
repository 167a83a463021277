#include "view/recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/output_file.h"
#include "io/pictures/png_file.h"

// Not every system declares it in a header. NOLINTNEXTLINE(readability-redundant-declaration)
extern char** environ;

namespace vorpipe::view {
namespace {

namespace fs = std::filesystem;

/// Returns the program's path in the folders of PATH; empty if not found.
std::string foundOnPath(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::string folders = path == nullptr ? "" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::string candidate = (fs::path(folders.substr(0, end)) / program).string();
    if (access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate)) return candidate;
    folders.erase(0, std::min(end + 1, folders.size()));
  }
  return {};
}

class Film final : public Recorder {
 public:
  Film(std::string ffmpeg, std::string path, OutputFile file)
      : ffmpeg_(std::move(ffmpeg)), path_(std::move(path)), file_(std::move(file)) {}
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  ~Film() override {
    if (process_ > 0) {
      kill(process_, SIGTERM);
      await();
    }
  }

  Result<void> add(const Image& frame) override {
    if (!begun_) {
      VORPIPE_TRY(begin(frame.width, frame.height));
    }
    return writeAll(fitted(frame));
  }

  Result<void> finish() override {
    if (!begun_) return {};
    const int status = await();
    if (status != 0) return deviceError(fmt::format("{}: ffmpeg failed, exit status {}", path_, status));
    return file_.commit();
  }

 private:
  Result<void> begin(int width, int height) {
    width_ = width;
    height_ = height;
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      return systemError(ErrorCode::device, path_, "no pipe to ffmpeg", errno);
    }
    std::vector<std::string> arguments = {
        ffmpeg_, "-y", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgba", "-video_size",
        fmt::format("{}x{}", width, height), "-framerate", std::to_string(frame_rate), "-i", "-",
        // The usual color format of films needs even sides. Without color tags, players decode large films
        // with another color matrix than ffmpeg used.
        "-vf", "scale=out_color_matrix=bt709:out_range=tv,pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt",
        "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range",
        "tv", "-movflags", "+faststart", "-f", "mp4", file_.temporary()};
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // Ctrl-C must reach only this program, which then ends the film.
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int code = posix_spawn(&process_, ffmpeg_.c_str(), &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    pipe_ = ends[1];
    begun_ = true;
    if (code == 0) return {};
    process_ = 0;
    return systemError(ErrorCode::device, path_, "ffmpeg does not start", code);
  }

  std::vector<std::uint32_t> fitted(const Image& frame) const {
    if (frame.width == width_ && frame.height == height_) return frame.rgba;
    constexpr std::uint32_t dark = 0xFF000000;
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    const auto from_width = static_cast<std::size_t>(frame.width);
    std::vector<std::uint32_t> pixels(width * height, dark);
    for (std::size_t row = 0; row < std::min(height, static_cast<std::size_t>(frame.height)); ++row) {
      std::copy_n(frame.rgba.begin() + static_cast<std::ptrdiff_t>(row * from_width),
                  std::min(width, from_width), pixels.begin() + static_cast<std::ptrdiff_t>(row * width));
    }
    return pixels;
  }

  Result<void> writeAll(const std::vector<std::uint32_t>& pixels) {
    const char* next = reinterpret_cast<const char*>(pixels.data());
    std::size_t left = pixels.size() * sizeof(std::uint32_t);
    while (left > 0) {
      const ssize_t written = ::write(pipe_, next, left);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return systemError(ErrorCode::device, path_, "ffmpeg takes no more frames", errno);
      next += written;
      left -= static_cast<std::size_t>(written);
    }
    return {};
  }

  /// Closes ffmpeg's input, waits for it, and returns its exit status.
  int await() {
    if (pipe_ >= 0) close(std::exchange(pipe_, -1));
    int status = 0;
    if (process_ > 0) {
      while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
      }
    }
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string ffmpeg_, path_;
  OutputFile file_;  ///< ffmpeg writes to its temporary()
  bool begun_ = false;
  int width_ = 0, height_ = 0;
  pid_t process_ = 0;
  int pipe_ = -1;
};

Result<std::unique_ptr<Recorder>> openFilm(const std::string& path) {
  std::string ffmpeg = foundOnPath("ffmpeg");
  if (ffmpeg.empty()) {
    return deviceError(path +
                       ": films are made by ffmpeg, which is not on PATH; a folder gets numbered PNGs");
  }
  VORPIPE_VAR(file, OutputFile::create(path));
  if (file.temporary().empty()) {
    return inputError(path + ": a film is no stream: ffmpeg ends it at its beginning");
  }
  // If ffmpeg ends early, writing to it must fail and not end this program.
  signal(SIGPIPE, SIG_IGN);
  return std::make_unique<Film>(std::move(ffmpeg), path, std::move(file));
}

class Folder final : public Recorder {
 public:
  Folder(std::string path, std::uint64_t first) : path_(std::move(path)), next_(first) {}

  Result<void> add(const Image& frame) override {
    return savePng((fs::path(path_) / fmt::format("frame-{:05}.png", next_++)).string(), frame);
  }
  Result<void> finish() override { return {}; }

 private:
  std::string path_;
  std::uint64_t next_;
};

}  // namespace

Result<void> savePng(const std::string& path, const Image& image) {
  return writeFile(path, [&](ByteSink& to) { return writePng(to, image.width, image.height, image.rgba); });
}

Result<std::unique_ptr<Recorder>> openRecorder(const std::string& path) {
  if (lowerExtension(path) == film_extension) return openFilm(path);
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
