#include "io/base/output_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"

namespace vorpipe {

/// A slot in a list that a signal handler can read at any moment: slots are added and reused, but never
/// freed.
struct UnfinishedSlot {
  std::atomic<const char*> path{nullptr};
  UnfinishedSlot* next = nullptr;
};

namespace {

std::atomic<UnfinishedSlot*> slots{nullptr};
std::atomic<bool> ending{false};  ///< removeUnfinished was called
static_assert(std::atomic<const char*>::is_always_lock_free && decltype(slots)::is_always_lock_free,
              "signal handlers use them");

UnfinishedSlot* hold(const char* path) {
  for (UnfinishedSlot* slot = slots; slot != nullptr; slot = slot->next) {
    const char* none = nullptr;
    if (slot->path.compare_exchange_strong(none, path)) return slot;
  }
  auto* const slot = new UnfinishedSlot;
  slot->path = path;
  slot->next = slots;
  while (!slots.compare_exchange_weak(slot->next, slot)) {
  }
  return slot;
}

/// Waits, briefly, while a handler on another thread ends the process.
void waitForEnd() {
  while (ending) pause();
}

}  // namespace

Unfinished::Unfinished(std::string path) : path_(std::move(path)), slot_(hold(path_.c_str())) {}

/// A handler on another thread may be reading the path: then the process ends before the path is freed.
Unfinished::~Unfinished() {
  if (is_there_) unlink(path_.c_str());
  slot_->path = nullptr;
  waitForEnd();
}

void Unfinished::noteCreated(bool created) {
  is_there_ = created;
  if (!created || !ending) return;
  unlink(path_.c_str());
  waitForEnd();
}

int Unfinished::create(unsigned mode) {
  const int descriptor = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  noteCreated(descriptor >= 0);
  return descriptor;
}

bool Unfinished::linkTo(const char* old) {
  noteCreated(link(old, path_.c_str()) == 0);
  return is_there_;
}

bool Unfinished::moveTo(const char* target) {
  is_there_ = std::rename(path_.c_str(), target) != 0;
  // Another thread may have removed it.
  if (is_there_) waitForEnd();
  return !is_there_;
}

void removeUnfinished() {
  ending = true;
  for (const UnfinishedSlot* slot = slots; slot != nullptr; slot = slot->next) {
    if (const char* const path = slot->path) unlink(path);
  }
}

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

/// Returns why an existing file cannot be replaced; empty if it can.
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

/// Returns a path in the folder of `target` that no other call returns.
std::string pathBeside(const std::string& target) {
  static std::atomic<unsigned> counter = 0;
  const auto name = fmt::format("{}{}-{}{}", temporary_begin, ::getpid(), counter++, temporary_end);
  return (fs::path(target).parent_path() / name).string();
}

/// A file about to be replaced. It keeps a second name during this object's lifetime, if the file system has
/// links.
class ReplacedFile {
 public:
  /// There need not be a file at the path.
  explicit ReplacedFile(std::string path) : path_(std::move(path)) {
    struct stat status {};
    was_there_ = ::lstat(path_.c_str(), &status) == 0 || errno != ENOENT;
    if (!was_there_) return;
    kept_ = std::make_unique<Unfinished>(pathBeside(path_));
    if (!kept_->linkTo(path_.c_str())) kept_.reset();
  }

  /// Restores what was at the path: no file if there was none.
  void putBack() {
    if (kept_) {
      kept_->moveTo(path_.c_str());
    } else if (!was_there_) {
      ::unlink(path_.c_str());
    }
  }

 private:
  std::string path_;
  std::unique_ptr<Unfinished> kept_;
  bool was_there_;
};

/// The path that `path` leads to; its last component may be a link whose target does not exist yet.
Result<fs::path> followLinks(const fs::path& path) {
  constexpr int max_links = 40;
  fs::path target = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    const fs::path next = fs::read_symlink(target, error);
    if (error || links == max_links) {
      return inputError(path.string() + ": cannot be written: the symbolic link leads nowhere");
    }
    target = target.parent_path() / next;
  }
  const fs::path directory = target.has_parent_path() ? target.parent_path() : ".";
  const fs::path real = fs::canonical(directory, error);
  if (error) {
    return inputError(fmt::format("{}: cannot be written: directory {}: {}", path.string(),
                                  directory.string(), error.message()));
  }
  return real / target.filename();
}

}  // namespace

bool isLeftOver(std::string_view name) {
  return name.starts_with(temporary_begin) && name.ends_with(temporary_end);
}

Result<OutputFile> OutputFile::createDirect(const std::string& path) {
  OutputFile file(path, "");
  // A copy of the descriptor keeps the position of a file that the shell redirected to.
  const int standard = path == "/dev/stdout" ? STDOUT_FILENO : path == "/dev/stderr" ? STDERR_FILENO : -1;
  const int descriptor = standard >= 0 ? ::fcntl(standard, F_DUPFD_CLOEXEC, 3)
                                       : ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  file.stream_.reset(descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb"));
  if (!file.stream_) return systemError(ErrorCode::input, path, "cannot be written", errno);
  return file;
}

Result<void> OutputFile::createTemporary() {
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return systemError(ErrorCode::input, name(), "cannot be written", errno);
  if (exists) {
    const std::string why_not = whyNotReplaced(target_, status);
    if (!why_not.empty()) return inputError(fmt::format("{}: cannot be written: {}", name(), why_not));
  }
  int descriptor = -1;
  // Skips files left by a killed process with the same id.
  do {
    temporary_ = std::make_unique<Unfinished>(pathBeside(target_));
    descriptor = temporary_->create(0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) {
    return systemError(ErrorCode::input, name(), "cannot be written: no file can be created beside it",
                       errno);
  }
  stream_.reset(::fdopen(descriptor, "wb"));
  if (!stream_) ::close(descriptor);
  if (!stream_ || (exists && ::fchmod(descriptor, status.st_mode & 07777) != 0)) {
    return systemError(ErrorCode::device, name(), "cannot be written", errno);
  }
  return {};
}

Result<OutputFile> OutputFile::create(const std::string& path) {
  if (path.empty() || path.ends_with('/')) {
    return inputError(path + (path.empty() ? "the name of the output file is empty" : ": is a directory"));
  }
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    return inputError(path + ": is a directory; the name of a file is needed");
  }
  if (path == "/dev/stdout" || path == "/dev/stderr" || (exists && !S_ISREG(status.st_mode))) {
    return createDirect(path);
  }
  VORPIPE_LET(target, followLinks(path));
  OutputFile file(path, target.string());
  VORPIPE_TRY(file.createTemporary());
  return file;
}

Result<void> OutputFile::write(std::string_view bytes) {
  assert(stream_ && "nothing can be written after finish()");
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) {
    return systemError(ErrorCode::device, name(), "writing failed", errno);
  }
  return {};
}

Result<void> OutputFile::finish() {
  // fclose reports errors that buffered writes could not.
  if (stream_ && std::fclose(stream_.release()) != 0) {
    return systemError(ErrorCode::device, name(), "writing failed", errno);
  }
  return {};
}

Result<void> OutputFile::commit() {
  VORPIPE_TRY(finish());
  if (!temporary_) return {};
  if (!temporary_->moveTo(target_.c_str())) {
    return systemError(ErrorCode::device, name(), "the finished file could not be put in place", errno);
  }
  temporary_.reset();
  return {};
}

Result<std::vector<OutputFile>> createOutputs(std::span<const std::string> paths,
                                              std::span<const OutputFile> others) {
  std::vector<OutputFile> files;
  for (const std::string& path : paths) {
    VORPIPE_VAR(file, OutputFile::create(path));
    const auto isSame = [&](const OutputFile& other) {
      return !file.target().empty() && file.target() == other.target();
    };
    for (const auto& made : {std::span<const OutputFile>(files), others}) {
      if (const auto same = std::ranges::find_if(made, isSame); same != made.end()) {
        return inputError(fmt::format("{}: is the same output file as {}", path, same->name()));
      }
    }
    files.push_back(std::move(file));
  }
  return files;
}

Result<void> commitAll(std::span<OutputFile> files) {
  for (OutputFile& file : files) {
    VORPIPE_TRY(file.finish());
  }
  std::deque<ReplacedFile> replaced;
  for (OutputFile& file : files) {
    // A single file needs no restoring: it is replaced or not.
    if (files.size() > 1 && !file.target().empty()) replaced.emplace_back(file.target());
    if (auto committed = file.commit(); !committed) {
      for (ReplacedFile& old : replaced) old.putBack();
      return committed;
    }
  }
  return {};
}

}  // namespace vorpipe
