#include "io/sites/mapped_sites.h"
#include "io/sites/sites_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/npy_array.h"

namespace vorpipe {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Whether the elements can be used as sites in place.
bool areSites(const NpyHeader& header) {
  const bool is_real = header.kind == 'f' && (header.size == sizeof(float) || header.size == sizeof(double));
  const bool is_native = header.big_endian == (std::endian::native == std::endian::big);
  return is_real && is_native && header.shape.size() == 2 && header.shape[1] == 2;
}

/// Results of one pass over some sites.
struct Seen {
  Box box{infinite, infinite, -infinite, -infinite};
  std::uint64_t unusable = std::numeric_limits<std::uint64_t>::max();  ///< the first that is not finite

  void add(const Seen& other) {
    box = {std::min(box.xmin, other.box.xmin), std::min(box.ymin, other.box.ymin),
           std::max(box.xmax, other.box.xmax), std::max(box.ymax, other.box.ymax)};
    unusable = std::min(unusable, other.unusable);
  }
};

Seen lookAt(const SitesInPlace& sites, std::size_t begin, std::size_t end) {
  Seen seen;
  for (auto i = begin; i < end; ++i) {
    const double x = sites.x[i], y = sites.y[i];
    if (!std::isfinite(x) || !std::isfinite(y)) seen.unusable = std::min<std::uint64_t>(seen.unusable, i);
    seen.box = {std::min(seen.box.xmin, x), std::min(seen.box.ymin, y), std::max(seen.box.xmax, x),
                std::max(seen.box.ymax, y)};
  }
  return seen;
}

/// Maps a file; null if the system refuses.
void* mapFile(const std::string& path, std::uint64_t bytes) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  struct stat status {};
  const bool is_same =
      ::fstat(descriptor, &status) == 0 && static_cast<std::uint64_t>(status.st_size) == bytes;
  void* begin = is_same ? ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, descriptor, 0) : MAP_FAILED;
  ::close(descriptor);
  return begin == MAP_FAILED ? nullptr : begin;
}

}  // namespace

void MappedSites::Unmap::operator()(void* begin) const { ::munmap(begin, bytes); }

Result<std::optional<MappedSites>> MappedSites::map(const std::string& path, int threads) {
  VORPIPE_VAR(file, InputFile::open(path));
  if (!file.size()) return std::nullopt;
  const std::uint64_t bytes = *file.size();
  const auto header = readNpyHeader(file);
  // A packed file has no known size by now.
  if (!file.size()) return std::nullopt;
  if (!header) return tl::unexpected(header.error());
  if (!areSites(*header)) return std::nullopt;
  const std::uint64_t count = header->shape[0];
  if (count == 0) return inputError(fmt::format("{}: has no sites", path));
  if (count > max_sites) {
    return inputError(fmt::format("{}: holds more than {} sites", path, max_sites));
  }
  void* begin = mapFile(path, bytes);
  if (begin == nullptr) return systemError(ErrorCode::device, path, "cannot be mapped into memory", errno);
  MappedSites mapped(begin, bytes);
  const std::size_t size = header->size;
  // The header's reader has checked that nothing follows the elements.
  const auto* first = static_cast<const std::byte*>(begin) + (bytes - 2 * count * size);
  const bool are_floats = size == sizeof(float);
  const std::size_t stride = header->fortran_order ? size : 2 * size;
  const std::size_t to_y = header->fortran_order ? count * size : size;
  mapped.sites_ = {{first, stride, are_floats}, {first + to_y, stride, are_floats}, count};
  VORPIPE_TRY(mapped.look(path, threads));
  return mapped;
}

Result<void> MappedSites::look(const std::string& path, int threads) {
  constexpr std::size_t grain = std::size_t{1} << 16;
  std::vector<Seen> parts((sites_.count + grain - 1) / grain);
  parallelFor(sites_.count, grain, threads,
              [&](std::size_t begin, std::size_t end) { parts[begin / grain] = lookAt(sites_, begin, end); });
  Seen all;
  for (const Seen& part : parts) all.add(part);
  if (const auto i = all.unusable; i < sites_.count) {
    const bool is_x = !std::isfinite(sites_.x[i]);
    return inputError(
        fmt::format("{}: element [{}, {}] (counted from 0; column {}) is {}, not a finite number", path, i,
                    is_x ? 0 : 1, is_x ? "x" : "y", is_x ? sites_.x[i] : sites_.y[i]));
  }
  corners_ = {{all.box.xmin, all.box.xmax}, {all.box.ymin, all.box.ymax}, {}};
  return {};
}

}  // namespace vorpipe
