#include "space/short_edges.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "space/edge_length.h"

namespace vorpipe::space {
namespace {

double shortestSide(const Box3& box) {
  return std::min({box.xmax - box.xmin, box.ymax - box.ymin, box.zmax - box.zmin});
}

double squaredDistance(const Point3& a, const Point3& b) {
  const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
  return (x * x + y * y) + z * z;
}

/// Finds the short edges of cells, one after another.
class EdgeSearch {
 public:
  /// `asked`: by site, 1 for those whose cells are searched.
  EdgeSearch(const Places& places, const Rows& rows, const std::vector<std::uint8_t>& asked)
      : places_(places),
        rows_(rows),
        asked_(asked),
        corners_(places),
        squared_side_(shortestSide(places.box) * shortestSide(places.box)) {}

  void search(Label site, std::vector<ShortEdge>& found) {
    const Row row = rows_[static_cast<std::size_t>(site)];
    site_ = site;
    vertices_.number(row);
    corners_.take(site, row);
    place_.assign(vertices_.size(), {0, 0, 0, -1});
    for (std::size_t f = 0; f < row.faces; ++f) {
      if (comesBefore(row.neighbor[f])) continue;
      const Ring ring = row.ring(f);
      const std::size_t begin = row.ringBegin(f), n = ring.size();
      for (std::size_t k = 0; k < n; ++k) {
        if (ring[k] < f || comesBefore(row.neighbor[ring[k]])) continue;
        look(row, f, ring[k], begin + k, begin + (k == 0 ? n - 1 : k - 1), found);
      }
    }
  }

 private:
  /// Whether the edges around a neighbor are searched in its cell.
  [[nodiscard]] bool comesBefore(Label neighbor) const {
    return !isWallLabel(neighbor) && neighbor < site_ && asked_[static_cast<std::size_t>(neighbor)] != 0;
  }

  const VertexPlace& placeAt(std::size_t edge_end) {
    const std::size_t vertex = vertices_.atEnd()[edge_end];
    if (place_[vertex].error < 0) place_[vertex] = corners_.at(vertices_.faces()[vertex]);
    return place_[vertex];
  }

  void look(const Row& row, std::size_t face, std::size_t other, std::size_t end, std::size_t end_before,
            std::vector<ShortEdge>& found) {
    const VertexPlace a = placeAt(end_before), b = placeAt(end);
    const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
    const double length = std::sqrt((x * x + y * y) + z * z);
    const double error = a.error + b.error + 0x1p-52 * length;
    const double tie =
        tie_part * std::sqrt(squaredLeast(row.neighbor[face], row.neighbor[other], face, other));
    if (length - error > tie) return;
    ShortEdge edge{site_, static_cast<std::uint32_t>(end), static_cast<std::uint32_t>(end_before), 0};
    constexpr double known = 1e-4;
    if (error <= known * tie && length + error <= no_length * tie) {
      edge.part = static_cast<float>(length / tie);
      found.push_back(edge);
      return;
    }
    const double part = lengthInTies(places_, rows_, edge, no_length * known);
    if (part > 1) return;
    edge.part = static_cast<float>(part);
    found.push_back(edge);
  }

  [[nodiscard]] double squaredLeast(Label a, Label b, std::size_t face_a, std::size_t face_b) const {
    const bool is_wall_a = isWallLabel(a), is_wall_b = isWallLabel(b);
    double least =
        is_wall_a || is_wall_b ? squared_side_ : squaredDistance(places_.sites[a], places_.sites[b]);
    if (!is_wall_a) least = std::min(least, corners_.face(face_a).squared());
    if (!is_wall_b) least = std::min(least, corners_.face(face_b).squared());
    return least;
  }

  const Places& places_;
  const Rows& rows_;
  const std::vector<std::uint8_t>& asked_;
  CellPlaces corners_;
  RowVertices vertices_;
  std::vector<VertexPlace> place_;
  double squared_side_;
  Label site_ = 0;
};

}  // namespace

EdgeAround edgeAround(const Row& row, std::size_t edge_end) {
  EdgeAround around{};
  std::size_t low = 0, high = row.faces;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (row.ringBegin(middle) <= edge_end ? low : high) = middle;
  }
  const Ring ring = row.ring(low);
  const std::size_t begin = row.ringBegin(low), k = edge_end - begin, n = ring.size();
  around.face = low;
  around.other = ring[k];
  around.before = ring[k == 0 ? n - 1 : k - 1];
  around.after = ring[k + 1 == n ? 0 : k + 1];
  return around;
}

EdgeLabels labelsAround(const Row& row, Label site, std::size_t edge_end) {
  const EdgeAround around = edgeAround(row, edge_end);
  return edgeLabels(site, row.neighbor[around.face], row.neighbor[around.other]);
}

double tieOf(const Places& places, const EdgeLabels& labels) {
  double squared = HUGE_VAL;
  for (std::size_t a = 0; a < labels.size(); ++a) {
    if (isWallLabel(labels[a])) squared = std::min(squared, std::pow(shortestSide(places.box), 2));
    for (std::size_t b = 0; b < a; ++b) {
      if (isWallLabel(labels[a]) || isWallLabel(labels[b])) continue;
      squared = std::min(squared, squaredDistance(places.sites[labels[a]], places.sites[labels[b]]));
    }
  }
  return tie_part * std::sqrt(squared);
}

double lengthInTies(const Places& places, const Rows& rows, const ShortEdge& edge, double fine) {
  const Row row = rows[static_cast<std::size_t>(edge.site)];
  const EdgeAround around = edgeAround(row, edge.edge_end);
  const EdgeLabels labels{edge.site, row.neighbor[around.face], row.neighbor[around.other]};
  const double tie = tieOf(places, labels);
  return edgeLength(places, labels[0], labels[1], labels[2], row.neighbor[around.before],
                    row.neighbor[around.after], fine * tie) /
         tie;
}

std::vector<ShortEdge> shortEdges(const Places& places, const Rows& rows,
                                  std::span<const std::uint32_t> sites, int threads) {
  constexpr std::size_t block = 256;
  std::vector<std::uint8_t> asked(rows.size(), 0);
  for (const auto site : sites) asked[site] = rows[site].faces != 0;
  std::vector<std::vector<ShortEdge>> found((sites.size() + block - 1) / block);
  parallelFor(sites.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    EdgeSearch search(places, rows, asked);
    for (std::size_t c = begin; c < end; ++c) {
      if (asked[sites[c]] != 0) search.search(static_cast<Label>(sites[c]), found[c / block]);
    }
  });
  std::vector<ShortEdge> edges;
  std::size_t count = 0;
  for (const auto& part : found) count += part.size();
  edges.reserve(count);
  for (auto& part : found) {
    edges.insert(edges.end(), part.begin(), part.end());
    part = {};
  }
  return edges;
}

}  // namespace vorpipe::space
