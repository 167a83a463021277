#include "io/base/output_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <deque>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/replaced_file.h"

namespace vorpipe {
namespace {

namespace fs = std::filesystem;

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

Result<OutputFile> OutputFile::createDirect(const std::string& path) {
  OutputFile file(path, "");
  // A copy of the descriptor keeps the position of a file that the shell redirected to.
  const int standard = path == "/dev/stdout" ? STDOUT_FILENO : path == "/dev/stderr" ? STDERR_FILENO : -1;
  const int descriptor = standard >= 0 ? ::fcntl(standard, F_DUPFD_CLOEXEC, 3)
                                       : ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  file.stream_.reset(descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb"));
  if (!file.stream_) {
    return systemError(ErrorCode::input, path, "cannot be written", errno);
  }
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
  const auto target = followLinks(path);
  if (!target) {
    return tl::unexpected(target.error());
  }
  OutputFile file(path, target->string());
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
  if (!temporary_) {
    return {};
  }
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
    auto file = OutputFile::create(path);
    if (!file) {
      return tl::unexpected(file.error());
    }
    const auto isSame = [&](const OutputFile& other) {
      return !file->target().empty() && file->target() == other.target();
    };
    for (const auto& made : {std::span<const OutputFile>(files), others}) {
      if (const auto same = std::ranges::find_if(made, isSame); same != made.end()) {
        return inputError(fmt::format("{}: is the same output file as {}", path, same->name()));
      }
    }
    files.push_back(std::move(*file));
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
