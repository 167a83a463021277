/// Sites that repeat: the vectors of their period, each site within one period, and its images around.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe/result.h"
#include "vorpipe/space.h"

namespace vorpipe::space {

using Vector3 = std::array<double, 3>;
using Shift = std::array<std::int32_t, 3>;

/// An image of a site: moved by that many vectors of a period.
struct Image {
  std::uint32_t site;
  Shift shift;
};

/// The vectors by which sites repeat: the sides of a box along some axes, or those of a lattice, reduced: no
/// sum of them is shorter (Nguyen and Stehle 2009, "Low-dimensional lattice basis reduction revisited",
/// section 3).
class Period {
 public:
  /// Options have a period, and are valid.
  explicit Period(const Cells3Options& options);

  /// Whether sites repeat along an axis.
  [[nodiscard]] bool along(std::size_t axis) const { return is_lattice_ || repeats_[axis]; }
  [[nodiscard]] bool repeats(std::size_t r) const { return repeats_[r]; }
  /// By vector; of one that does not repeat, a side of the domain.
  [[nodiscard]] const std::array<Vector3, 3>& vectors() const { return vector_; }
  /// A point of which sites are not farther away than half of each vector.
  [[nodiscard]] const Vector3& middle() const { return middle_; }
  [[nodiscard]] double volume() const;
  /// Of the vectors of the options: the most that a sum of so many of each of these has.
  [[nodiscard]] std::int64_t mostOfOptions(const Shift& shift) const;
  /// As a multiple of the vectors of the options; see mostOfOptions().
  [[nodiscard]] Shift ofOptions(const Shift& shift) const;

 private:
  void reduce();
  void subtract(std::size_t from, std::size_t what, double times);

  bool is_lattice_;
  std::array<bool, 3> repeats_;
  std::array<Vector3, 3> vector_;
  std::array<std::array<std::int64_t, 3>, 3> of_options_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< by vector
  Vector3 middle_;
};

/// The sites of a period and their images within a band around it. Coordinates are relative to the middle of
/// the period, and along its axes multiples of one unit, as its vectors are: images are copies to the last
/// bit.
struct ImagedSites {
  Sites3 sites;                 ///< those of the caller, each in the period; then the images
  std::vector<double> weights;  ///< of all of these, or empty
  std::vector<Image> images;
  std::vector<Shift> home;  ///< by site of the caller: as many vectors from its place in the period to it
  std::array<Vector3, 3> vector;
  Vector3 middle;
  Box3 box;  ///< around the period and the band: all sites and images there are in `sites`
};

/// Errors (input): a site that is more than 2^29 periods away; more images than 2^31.
Result<ImagedSites> withImages(const Period& period, std::span<const Point3> sites,
                               const Cells3Options& options, double band, int threads);

}  // namespace vorpipe::space
