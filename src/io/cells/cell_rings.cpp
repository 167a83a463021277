#include "io/cells/cell_rings.h"

#include <algorithm>

namespace vorpipe {
namespace {

constexpr std::uint64_t least_vertices = 3;

}  // namespace

std::vector<Ring> ringsOf(const Diagram& diagram, std::size_t site) {
  const CellRings all = diagram.cell(site).rings();
  std::vector<Ring> rings;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (all[r].size() >= least_vertices) rings.push_back({all.begin(r), all.end(r), all.isHole(r)});
  }
  return rings;
}

std::vector<std::span<const Ring>> piecesOf(std::span<const Ring> rings) {
  std::vector<std::span<const Ring>> pieces;
  while (!rings.empty()) {
    const auto next =
        std::find_if(rings.begin() + 1, rings.end(), [](const Ring& ring) { return !ring.hole; });
    const auto size = static_cast<std::size_t>(next - rings.begin());
    pieces.push_back(rings.first(size));
    rings = rings.subspan(size);
  }
  return pieces;
}

bool hasPolygon(const Diagram& diagram, std::size_t site) { return !ringsOf(diagram, site).empty(); }

}  // namespace vorpipe
