#include "io/base/replaced_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace vorpipe {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_begin = ".vorpipe-", temporary_end = ".tmp";

/// Whether the file is a mount point, such as an outside file in a container: no other can replace it.
bool isMountPoint(const std::string& file) {
  struct statx status {};
  return ::statx(AT_FDCWD, file.c_str(), AT_NO_AUTOMOUNT, 0, &status) == 0 &&
         (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// Whether a sticky folder like /tmp keeps others from replacing a file that is not theirs.
bool isKeptByItsFolder(const struct stat& file, const fs::path& folder) {
  struct stat status {};
  const uid_t user = ::geteuid();
  return ::stat(folder.c_str(), &status) == 0 && (status.st_mode & S_ISVTX) != 0 && user != 0 &&
         user != status.st_uid && user != file.st_uid;
}

}  // namespace

std::string whyNotReplaced(const std::string& file, const struct stat& status) {
  if (::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0) {
    return std::error_code(errno, std::generic_category()).message();
  }
  if (isMountPoint(file)) return "it is mounted from elsewhere; name a file in a folder that is";
  if (isKeptByItsFolder(status, fs::path(file).parent_path())) {
    return "it is another user's, whom its folder protects";
  }
  return {};
}

std::string pathBeside(const std::string& target) {
  static std::atomic<unsigned> counter = 0;
  const auto name = fmt::format("{}{}-{}{}", temporary_begin, ::getpid(), counter++, temporary_end);
  return (fs::path(target).parent_path() / name).string();
}

bool isLeftOver(std::string_view name) {
  return name.starts_with(temporary_begin) && name.ends_with(temporary_end);
}

ReplacedFile::ReplacedFile(std::string path) : path_(std::move(path)) {
  struct stat status {};
  was_there_ = ::lstat(path_.c_str(), &status) == 0 || errno != ENOENT;
  if (!was_there_) return;
  kept_ = std::make_unique<Unfinished>(pathBeside(path_));
  if (!kept_->linkTo(path_.c_str())) kept_.reset();
}

void ReplacedFile::putBack() {
  if (kept_) {
    kept_->moveTo(path_.c_str());
  } else if (!was_there_) {
    ::unlink(path_.c_str());
  }
}

}  // namespace vorpipe
