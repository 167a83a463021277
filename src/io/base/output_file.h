/// Output files that appear whole or not at all (decision D68).
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

struct UnfinishedSlot;

/// A new file, removed with this object, or earlier by removeUnfinished(), unless it was moved away.
class Unfinished {
 public:
  /// create() makes the file, but removeUnfinished() has the path from here on: it never misses an existing
  /// file.
  explicit Unfinished(std::string path);
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished();

  /// Creates the file, which must not exist. Returns its descriptor, or -1 with errno set.
  int create(unsigned mode);
  /// Makes the file another name of an old one. Returns false with errno set on failure.
  bool linkTo(const char* old);
  /// Renames the file, which then stays. Returns false with errno set on failure.
  bool moveTo(const char* target);

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  /// Notes whether the file was created, which removeUnfinished() on another thread may have missed.
  void noteCreated(bool created);

  std::string path_;
  UnfinishedSlot* slot_;
  bool is_there_ = false;
};

/// Removes all unfinished files of all threads. For signal handlers: it makes only async-signal-safe calls.
/// They must then end the process, since threads with such a file wait for that.
void removeUnfinished();

/// Whether a killed process may have left a file of this name, given without its folder:
/// ".vorpipe-1234-0.tmp".
bool isLeftOver(std::string_view name);

/// Bytes go to a temporary file beside the target, which commit() renames onto it; without commit()
/// the target stays as it was; messages name the path as it was given. Something that is no regular file
/// (/dev/stdout, a pipe) is written to directly.
class OutputFile final : public ByteSink {
 public:
  /// Checks at once whether `path` can be written. A symbolic link is followed; a file that exists keeps its
  /// permissions. Errors (input): the directory is missing, the path is a directory, no permission, a name
  /// that is too long, a file that cannot be replaced.
  static Result<OutputFile> create(const std::string& path);
  OutputFile(OutputFile&& other) noexcept = default;
  OutputFile& operator=(OutputFile&& other) noexcept = default;
  ~OutputFile() override = default;

  /// Error (device): the system could not write them (the disk is full).
  Result<void> write(std::string_view bytes) override;

  /// Hands everything to the system; nothing can be written afterwards. Error (device): as write().
  Result<void> finish();

  /// Finishes, if that is not done, and puts the file in place. Error (device): the system refused.
  Result<void> commit();

  /// The file that is replaced, links followed; empty when it is written to directly.
  [[nodiscard]] const std::string& target() const { return target_; }
  /// The file beside it that holds the bytes until commit(); empty when it is written to directly.
  [[nodiscard]] std::string temporary() const { return temporary_ ? temporary_->path() : std::string(); }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using Stream = std::unique_ptr<std::FILE, Close>;

  OutputFile(std::string path, std::string target) : ByteSink(std::move(path)), target_(std::move(target)) {}
  static Result<OutputFile> createDirect(const std::string& path);
  Result<void> createTemporary();

  std::string target_;
  std::unique_ptr<Unfinished> temporary_;  ///< declared before stream_, which closes first
  Stream stream_;
};

/// Creates a file, has `write` fill it, and puts it in place. Errors: those of OutputFile and of `write`.
template <class Write>
Result<void> writeFile(const std::string& path, const Write& write) {
  VORPIPE_VAR(file, OutputFile::create(path));
  VORPIPE_TRY(write(file));
  return file.commit();
}

/// Creates an output file for each path, in order. Errors (input): those of create(), two paths are one file,
/// or one is that of `others`.
Result<std::vector<OutputFile>> createOutputs(std::span<const std::string> paths,
                                              std::span<const OutputFile> others = {});

/// Commits all files together: puts none in place unless all bytes of all were written. If one cannot be
/// replaced, the others are not replaced either.
Result<void> commitAll(std::span<OutputFile> files);

}  // namespace vorpipe
