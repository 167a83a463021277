/// gzip, inflated while it is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vorpipe.h"

struct z_stream_s;

namespace vorpipe {

class Inflater {
 public:
  /// One deflated byte inflates to at most this many.
  static constexpr std::uint64_t largest_ratio = 1032;

  /// Fills the given span unless the file ends first; returns the number of bytes filled.
  using Source = std::function<Result<std::size_t>(std::span<char>)>;

  /// Whether bytes begin as a gzip file does.
  static bool isGzip(std::span<const char> bytes);

  /// Error (device): memory ran out.
  static Result<Inflater> create();

  /// Fills `bytes` unless `source` ends first; returns the number of bytes filled. Concatenated gzip files
  /// count as one. Errors: they are damaged or end too early (input); those of `source`. `name` begins the
  /// message.
  Result<std::size_t> read(std::span<char> bytes, const Source& source, const std::string& name);

 private:
  struct Free {
    void operator()(z_stream_s* stream) const;
  };
  explicit Inflater(std::unique_ptr<z_stream_s, Free> stream);
  Result<bool> refill(const Source& source);

  std::unique_ptr<z_stream_s, Free> stream_;
  std::vector<char> packed_;
  bool between_ = false;  ///< one of several gzip files has ended
};

}  // namespace vorpipe
