#include "io/base/shapefile.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/quoted.h"
#include "io/base/read_log.h"

extern char** environ;

namespace vorpipe {
namespace {

constexpr int no_program = 127;

/// Runs a program, whose messages go to a file. Returns its exit code; no_program if there is none of that
/// name.
int runProgram(std::vector<std::string> arguments, const std::string& messages) {
  constexpr mode_t mode = 0600;
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT, mode);
  pid_t process = 0;
  const int code = posix_spawnp(&process, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (code != 0) return no_program;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Opens the file and those beside it, so that the log of what was read has them.
Result<void> noteFiles(const std::string& path) {
  VORPIPE_TRY(InputFile::open(path));
  for (const char* extension : {".shx", ".SHX", ".dbf", ".DBF", ".prj", ".PRJ", ".cpg", ".CPG"}) {
    const std::string beside = besides(path, extension);
    std::error_code none;
    if (std::filesystem::is_regular_file(beside, none)) VORPIPE_TRY(InputFile::open(beside));
  }
  return {};
}

/// The first line of a file of messages.
std::string firstLine(const std::string& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 16;
  auto file = InputFile::open(path);
  if (!file) return {};
  const auto text = readText(*file, most_bytes);
  return text ? printable(text->substr(0, text->find('\n'))) : std::string();
}

}  // namespace

Result<ConvertedShapefile> ConvertedShapefile::of(const std::string& path) {
  VORPIPE_TRY(noteFiles(path));
  std::error_code none;
  std::string folder = (std::filesystem::temp_directory_path(none) / "vorpipe-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr)
    return systemError(ErrorCode::device, path, "there is no folder for its copy", errno);
  ConvertedShapefile converted(std::move(folder));
  const ReadLog::Pause pause;
  const std::string messages = converted.folder_ + "/messages";
  const int code =
      runProgram({"ogr2ogr", "-f", "GPKG", "-nlt", "PROMOTE_TO_MULTI", converted.file(), path}, messages);
  if (code == 0) return converted;
  if (code == no_program) {
    return inputError(
        fmt::format("{}: a shapefile is read by GDAL's ogr2ogr, which is not here: install gdal-bin, or make "
                    "a GeoPackage "
                    "of it elsewhere",
                    path));
  }
  return inputError(fmt::format("{}: ogr2ogr cannot read it: {}", path, firstLine(messages)));
}

ConvertedShapefile::ConvertedShapefile(ConvertedShapefile&& other) noexcept
    : folder_(std::exchange(other.folder_, {})) {}

ConvertedShapefile::~ConvertedShapefile() {
  std::error_code none;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, none);
}

}  // namespace vorpipe
