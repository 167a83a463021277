/// Size and hash of a file's contents.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "vorpipe.h"

struct XXH3_state_s;

namespace vorpipe {

/// Number of bytes and their 128-bit XXH3 hash, as `xxh128sum` prints it.
struct Contents {
  std::uint64_t bytes = 0;
  std::string xxh128;
  friend bool operator==(const Contents&, const Contents&) = default;
};

/// Hashes bytes that come in pieces.
class ContentHash {
 public:
  ContentHash();
  void add(std::string_view bytes);
  /// Contents of all bytes added so far.
  [[nodiscard]] Contents contents() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
  std::uint64_t bytes_ = 0;
};

/// Reads a whole file; does not inflate gzip. Errors: those of InputFile.
Result<Contents> contentsOf(const std::string& path);

}  // namespace vorpipe
