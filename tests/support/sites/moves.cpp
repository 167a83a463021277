#include "support/sites/moves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vorpipe::test {
namespace {

/// The wall that lies where a wall of the moved domain was.
std::int64_t wallBefore(std::int64_t wall, const Move& move) {
  constexpr std::array<std::array<int, 2>, 4> outward{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  if (wall < wall_ymax) return wall;
  const auto [x, y] = outward[static_cast<std::size_t>(-1 - wall)];
  const std::array<int, 2> before{move.xx * x + move.yx * y, move.xy * x + move.yy * y};
  return -1 - (std::ranges::find(outward, before) - outward.begin());
}

Periodic turned(Periodic periodic) {
  if (periodic == Periodic::x) return Periodic::y;
  return periodic == Periodic::y ? Periodic::x : periodic;
}

}  // namespace

Point Move::operator()(Point p) const {
  return {scale * (xx * p.x + xy * p.y) + shift.x, scale * (yx * p.x + yy * p.y) + shift.y};
}

Box Move::operator()(const Box& box) const {
  const Point a = (*this)(Point{box.xmin, box.ymin}), b = (*this)(Point{box.xmax, box.ymax});
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
}

HardInput moved(const HardInput& input, const Move& move) {
  HardInput out = input;
  for (std::size_t i = 0; i < out.sites.size(); ++i) {
    const Point p = move(Point{input.sites.x[i], input.sites.y[i]});
    out.sites.x[i] = p.x;
    out.sites.y[i] = p.y;
  }
  for (double& weight : out.sites.weight) weight *= move.scale * move.scale;
  for (Point& p : out.outline.points) p = move(p);
  out.domain = move(input.domain);
  if (move.turns()) {
    out.periodic = turned(input.periodic);
    std::swap(out.width, out.height);
  }
  return out;
}

HardInput chosen(const HardInput& input, std::span<const std::uint32_t> sites) {
  HardInput out = input;
  out.sites = {};
  for (const auto i : sites) {
    out.sites.x.push_back(input.sites.x[i]);
    out.sites.y.push_back(input.sites.y[i]);
    if (!input.sites.weight.empty()) out.sites.weight.push_back(input.sites.weight[i]);
  }
  return out;
}

Diagram movedBack(const Diagram& diagram, const Move& move) {
  Diagram back = diagram;
  for (double& area : back.area) area /= move.scale * move.scale;
  for (double& length : back.edge_lengths) length /= move.scale;
  for (auto& neighbor : back.neighbors) {
    if (neighbor < 0) neighbor = wallBefore(neighbor, move);
  }
  for (auto& [x, y] : back.neighbor_shifts) {
    const auto widths = x, heights = y;
    x = move.xx * widths + move.yx * heights;
    y = move.xy * widths + move.yy * heights;
  }
  return back;
}

Diagram renumbered(const Diagram& diagram, std::span<const std::uint32_t> sites, std::size_t count) {
  Diagram out;
  out.status.assign(count, Status::empty);
  out.owner.resize(count);
  out.area.assign(count, 0);
  out.cell_offsets.push_back(0);
  std::vector<std::size_t> place(count, sites.size());
  for (std::size_t k = 0; k < sites.size(); ++k) place[sites[k]] = k;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto k = place[i];
    out.owner[i] = i;
    if (k < sites.size()) {
      out.status[i] = diagram.status[k];
      out.owner[i] = sites[diagram.owner[k]];
      out.area[i] = diagram.area[k];
      for (auto e = diagram.cell_offsets[k]; e < diagram.cell_offsets[k + 1]; ++e) {
        const auto neighbor = diagram.neighbors[e];
        out.neighbors.push_back(neighbor < 0 ? neighbor : sites[static_cast<std::size_t>(neighbor)]);
        out.edge_lengths.push_back(diagram.edge_lengths[e]);
        if (!diagram.neighbor_shifts.empty()) out.neighbor_shifts.push_back(diagram.neighbor_shifts[e]);
      }
    }
    out.cell_offsets.push_back(out.neighbors.size());
  }
  return out;
}

std::vector<std::uint32_t> movedBack(const Image& image, const Move& move) {
  const int width = move.turns() ? image.height : image.width;
  const int height = move.turns() ? image.width : image.height;
  std::vector<std::uint32_t> ids;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      // Twice the way of the pixel's center from the picture's, upward.
      const int x = 2 * column + 1 - width, y = height - 2 * row - 1;
      const int to_x = move.xx * x + move.xy * y, to_y = move.yx * x + move.yy * y;
      const int to_column = (to_x + image.width - 1) / 2, to_row = (image.height - 1 - to_y) / 2;
      ids.push_back(image.ids[static_cast<std::size_t>(to_row * image.width + to_column)]);
    }
  }
  return ids;
}

}  // namespace vorpipe::test
