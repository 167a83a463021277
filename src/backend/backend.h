/// The interface between core and one device: what a backend is given and what it answers.
///
/// A backend does the geometry that core asks for and decides nothing else: which sites, in which
/// order, with which candidates, and what follows from a status is core's. Calls block.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// A line {p : p . (nx, ny) = h}; the cell lies where p . n <= h. n is a unit vector.
/// `bound` is a lower bound of the distance from the site at which this and every later line of the
/// same entry come from: once it reaches the security radius, the rest of the list cannot cut.
template <class Real>
struct Line {
  Real nx, ny, h, bound;
};

/// Unique sites, in scaled units (the input times a power of two, so that the domain's longer side
/// is in [1, 2)), in an order in which neighbors lie near each other.
struct SiteSet {
  std::vector<double> x, y;
  std::vector<std::uint32_t> id;  ///< index in the input
  Box domain{};                   ///< scaled
  [[nodiscard]] std::size_t size() const { return x.size(); }
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
    Real shift;                     ///< distance from the origin to the site, rounded up
  };
  std::vector<Entry> entries;
  std::vector<Line<Real>> lines;
};

/// What a shader found out about one entry; the numbers are shared with shaders/glsl/layout.glsl.
enum class CellStatus : std::uint8_t {
  missing = 0,    ///< the device did not answer
  certified = 1,  ///< complete: no other site can cut it
  empty = 2,      ///< certified, and nothing of it lies inside the domain
  overflow = 3,   ///< more edges than there was room for
  unsecured = 4,  ///< sites beyond the entry's reach might cut it
  open = 5,       ///< its edges do not close: rounding was too coarse
};

/// Where and how an entry is drawn.
struct DrawMark {
  float x, y;           ///< the entry's origin in normalized device coordinates of the view
  std::uint32_t id;     ///< what the id image gets
  std::uint32_t shade;  ///< index into the view's palette, 0 to 255
};

using Palette = std::array<std::uint32_t, 256>;  ///< RGBA, R in the lowest byte

/// A picture of `box` (scaled units); box may be a part of the domain.
struct View {
  Box box;
  int width, height;  ///< at most BackendInfo::max_view
  Palette palette;
};

/// Cells as data, entry by entry. Edge k of a cell runs from vertex k to vertex k + 1,
/// counter-clockwise, and lies on line[k]: an index into the entry's lines, or -1..-4 for
/// the walls xmin, xmax, ymin, ymax. Vertices are relative to the entry's origin.
struct CellPolygons {
  std::vector<CellStatus> status;
  std::vector<std::uint32_t> first;  ///< size: entries + 1
  std::vector<double> x, y;
  std::vector<std::int32_t> line;
};

struct BackendInfo {
  DeviceInfo device;
  int max_view = 0;               ///< largest width and height of a View
  std::uint64_t max_lines = 0;    ///< most lines in one batch
  std::uint32_t max_entries = 0;  ///< most entries in one batch
  int most_edges = 0;             ///< room for edges with Room::most
  int subpixel_bits = 8;          ///< vertices are snapped to 1 / 2^bits of a pixel
};

/// How many edges a cell may have at any time of its clipping.
enum class Room : std::uint8_t { fast, most };

class Backend {
 public:
  virtual ~Backend() = default;

  virtual const BackendInfo& info() const = 0;

  /// Replaces the sites. They outlive every later call.
  virtual Result<void> upload(const SiteSet& sites) = 0;

  /// Clears the picture: every pixel has no_site and color 0.
  virtual Result<void> begin(const View& view) = 0;

  /// Clips each entry, widened by half a step of the device's vertex grid so that neighbors leave
  /// no gap, and draws those that come out `certified` over what is there, in order.
  /// marks and status have one element per entry.
  virtual Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                            std::span<CellStatus> status) = 0;

  /// Reads the picture back. Row 0 is the bottom row of the view. Both spans hold width * height.
  virtual Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) = 0;

  /// Clips each entry and returns it as it is, not widened. `out` is replaced.
  virtual Result<void> cells(const CellBatch<double>& batch, CellPolygons& out) = 0;

  /// What the validation layers said since the last call.
  virtual std::vector<std::string> validationMessages() { return {}; }
};

}  // namespace vorpipe
