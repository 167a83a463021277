/// Sites of a .npy file that is mapped into memory instead of read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "vorpipe.h"
#include "vorpipe/tiled.h"

namespace vorpipe {

class MappedSites {
 public:
  /// Maps a file of float32 or float64 (N, 2) in this machine's byte order, in any order of its axes; none if
  /// it is something else that readSites may accept: packed, other columns, a pipe. Errors (input): the file
  /// cannot be read, or is no whole .npy file; it has no sites or too many; one is not finite.
  static Result<std::optional<MappedSites>> map(const std::string& path, int threads);

  [[nodiscard]] const SitesInPlace& sites() const { return sites_; }
  [[nodiscard]] std::uint64_t bytes() const { return begin_.get_deleter().bytes; }
  /// A few sites that have the same box as all.
  [[nodiscard]] const Sites& corners() const { return corners_; }

 private:
  struct Unmap {
    std::uint64_t bytes;
    void operator()(void* begin) const;
  };
  MappedSites(void* begin, std::uint64_t bytes) : begin_(begin, Unmap{bytes}) {}
  Result<void> look(const std::string& path, int threads);

  std::unique_ptr<void, Unmap> begin_;
  SitesInPlace sites_;
  Sites corners_;
};

}  // namespace vorpipe
