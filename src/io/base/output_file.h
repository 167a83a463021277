/// Output files that appear whole or not at all (decision D68).
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/byte_sink.h"
#include "io/base/unfinished.h"
#include "vorpipe.h"

namespace vorpipe {

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

/// Creates an output file for each path, in order. Errors (input): those of create(), two paths are one file,
/// or one is that of `others`.
Result<std::vector<OutputFile>> createOutputs(std::span<const std::string> paths,
                                              std::span<const OutputFile> others = {});

/// Commits all files together: puts none in place unless all bytes of all were written. If one cannot be
/// replaced, the others are not replaced either.
Result<void> commitAll(std::span<OutputFile> files);

}  // namespace vorpipe
