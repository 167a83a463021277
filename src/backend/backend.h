/// The interface between core and one device: the input and the results of a backend (decision D1).
///
/// A backend only does the geometry that core asks for. Core decides which sites, in which order, with which
/// candidates, and what follows from a status. Calls block.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "backend/site_set.h"
#include "base/big_vector.h"
#include "vorpipe.h"

namespace vorpipe {

/// Which drivers to search for a device. `hardware` excludes any driver that computes on the host's
/// processors, before it is opened.
enum class Drivers : std::uint8_t { any, hardware };

/// A line {p : p . (nx, ny) = h}; the cell lies where p . n <= h. n is a unit vector. `bound` is a lower
/// bound of the distance between the site and the sites behind this and every later line of the entry. Once
/// it reaches the security radius, the rest of the list cannot cut the cell.
template <class Real>
struct HalfPlane {
  Real nx, ny, h, bound;
};

/// Cells to clip. Entry e is a cell, or one convex piece of a cell that has more edges than a
/// device holds. All lines are relative to the entry's origin, a point inside the domain: the site
/// itself, or the domain's point nearest to a site outside it.
/// Lines come in ascending order of `bound`.
template <class Real>
struct CellBatch {
  struct Entry {
    std::uint32_t first, count;     ///< its lines
    Real west, south, east, north;  ///< the domain's walls relative to the origin
    Real reach;                     ///< every site that has no line here is at least this far from the site
    Real origin_offset;             ///< distance from the origin to the site, rounded up
  };
  std::vector<Entry> entries;
  std::vector<HalfPlane<Real>> lines;
};

/// Result of a shader for one entry; the numbers are shared with shaders/glsl/layout.glsl.
enum class CellStatus : std::uint8_t {
  missing = 0,    ///< the device did not answer
  certified = 1,  ///< complete: no other site can cut it
  empty = 2,      ///< certified, and no part of it lies inside the domain
  overflow = 3,   ///< more edges at once than the capacity allows
  unsecured = 4,  ///< sites beyond the entry's reach might cut it
  open = 5,       ///< its edges do not close: rounding was too coarse
};

/// A place in a picture, and what is drawn there: the origin of an entry of a batch, or a corner of a
/// triangle.
struct DrawMark {
  float x, y;                   ///< in normalized device coordinates of the view
  std::uint32_t id;             ///< value written to the id image
  std::uint32_t palette_index;  ///< index into the view's palette, 0 to 255
};

using Palette = std::array<std::uint32_t, 256>;  ///< RGBA, R in the lowest byte

/// A picture of `box` (scaled units); box may be a part of the domain.
struct View {
  Box box;            ///< relative to `corner`
  int width, height;  ///< at most BackendInfo::max_view
  Palette palette;
  Point corner{0, 0};  ///< for example the domain's; kept apart so that no pixel's place is rounded
};

/// The neighbors of cells, entry by entry, counter-clockwise from the smallest number. Those of entry e are
/// at offsets[e] up to offsets[e + 1]. A neighbor is the index of a site in the SiteSet, or of a line in its
/// entry of a batch, or one of the walls -1..-4. An entry that is not `certified` has none, with one
/// exception. In a set with weights, an `empty` entry lists the sites and walls that leave nothing of it, in
/// any order and possibly with duplicates.
struct CellNeighbors {
  std::vector<CellStatus> status;
  BigVector<std::uint64_t> offsets;  ///< size: entries + 1
  BigVector<std::int32_t> neighbor;
};

struct BackendInfo {
  DeviceInfo device;
  int max_view = 0;               ///< largest width and height of a View
  std::uint64_t max_sites = 0;    ///< most sites in one upload
  std::uint64_t max_bins = 0;     ///< most bins of their grid
  std::uint64_t max_lines = 0;    ///< most lines in one batch, corners or triangles in one call
  std::uint32_t max_entries = 0;  ///< most entries in one batch, most sites in one call of cells or draw
  int most_edges = 0;             ///< that a cell may have at once, with Capacity::large
  int subpixel_bits = 8;          ///< vertices are snapped to 1 / 2^bits of a pixel
  bool has_vertices = true;       ///< whether pictures are drawn; else every pixel is searched for
};

/// Numbers for a device to compute with, so that its rounding can be measured.
struct Operands {
  float a, b, c, d;
};

/// The device's float results; shaders/glsl/arithmetic.glsl.
struct Computed {
  float quotient;       ///< a / b
  float root;           ///< of |a|
  float inverse_root;   ///< of |a|
  float product;        ///< a b
  float sum;            ///< a + b
  float product_sum;    ///< a b + c, where a single rounding is allowed
  float rounded_twice;  ///< a b + c, where a single rounding is not allowed
  float offset;         ///< (a - b) + (c - d), in this order
};

/// How many edges a cell may have at once while it is clipped in float.
enum class Capacity : std::uint8_t {
  small,  ///< EDGES_FAST edges at any time of the clipping
  large,  ///< the most that the backend has
};

class Backend {
 public:
  virtual ~Backend() = default;

  virtual const BackendInfo& info() const = 0;

  /// Replaces the sites. palette_index[i] is the index into a view's palette for the cell of site i; empty
  /// when nothing will be drawn. Both must outlive every later call that names sites by index, and read().
  /// The calls for batches, and begin(), do not need them.
  virtual Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) = 0;

  /// Finds the cells of the sites `which` (indices in the set) by searching the grid. Replaces `out`, with
  /// one entry for each. Neighborhoods are subject to rounding: neighbors across an edge of almost no length
  /// may or may not be listed.
  virtual Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) = 0;

  /// Clips each entry of a batch as with Capacity::large, and returns the neighbors of its cell.
  virtual Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) = 0;

  /// Clears the picture: every pixel has no_site and color 0.
  virtual Result<void> begin(const View& view) = 0;

  /// Finds the cells of the sites `which`, which have no weights, and draws the `certified` ones over the
  /// picture, in order. Cells are widened by half a step of the device's vertex grid so that neighbors leave
  /// no gap. If the grid is coarse, they are shrunk instead and may leave pixels at their edges uncovered. A
  /// cell whose float error might be visible is `unsecured` (precision.h). status has one element per site. A
  /// cell that is shrunk to nothing is `certified`.
  virtual Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                            std::span<CellStatus> status) = 0;

  /// The same for the entries of a batch, except that the caller accounts for their float error. marks and
  /// status have one element per entry.
  virtual Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
                            std::span<CellStatus> status) = 0;

  /// Draws triangles over the picture, in order. The corners of triangle t are the three that `corner_of`
  /// lists from index 3 t on. There are at most max_lines corners and at most max_lines triangles; all
  /// corners of a triangle have the same mark.
  virtual Result<void> drawTriangles(std::span<const DrawMark> corners,
                                     std::span<const std::uint32_t> corner_of) = 0;

  /// Reads the picture back. Row 0 is the bottom row of the view. Both spans hold width * height.
  virtual Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) = 0;

  /// Evaluates the operands in float, in some shader. out has one element for each of them.
  virtual Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) = 0;

  /// Returns how long the device has worked since it was opened, by its own clock. Negative if no clock is
  /// read: software devices, and devices without timestamps.
  [[nodiscard]] virtual double deviceSeconds() const { return -1; }

  /// Returns the pipelines made since the last call.
  virtual std::vector<PipelineTime> pipelinesMade() { return {}; }

  /// Returns the messages of the validation layers since the last call.
  virtual std::vector<std::string> validationMessages() { return {}; }
};

}  // namespace vorpipe
