/// A device that is as bad as the standards allow.
#pragma once

#include <memory>

#include "backend/backend.h"
#include "support/devices/sloppy_number.h"

namespace vorpipe::test {

struct SloppyOptions {
  int subpixel_bits = 4;  ///< vertices are moved to the nearest multiple of 1 / 2^bits of a pixel
  Sloppiness::Way way = Sloppiness::Way::random;
  std::uint64_t seed = 1;
};

/// Draws as cell.geom does, but for what that does for cells of single pixels: the shared text in such
/// numbers, vertices that are snapped, and triangles of the strip in integers. Cells as data are the cpu's.
class SloppyDevice : public Backend {
 public:
  /// How far a vertex was drawn beyond the bisector of its cell's site and any other, at most, in pixels.
  [[nodiscard]] virtual double farthestBeyond() const = 0;
  /// Cells that were not drawn because floats might lose too much of them.
  [[nodiscard]] virtual std::uint64_t unsecured() const = 0;
};

std::unique_ptr<SloppyDevice> makeSloppyDevice(const SloppyOptions& options);

/// What the shared text loses at most of bisectors, in parts of 2^-24.
struct BisectorLoss {
  double length = 0;     ///< of the normal, which should be 1
  double direction = 0;  ///< of the normal, as an angle
  double distance = 0;   ///< of h, as a part of it
};

/// Of those between the first of some sites of the unit square and each of the others, in numbers that are
/// off in this way. Differences of the sites are floats.
BisectorLoss lossOfBisectors(const Sites& sites, Sloppiness::Way way, std::uint64_t seed);

}  // namespace vorpipe::test
