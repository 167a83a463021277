#include "space/cell_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>

#include "space/predicates.h"

namespace vorpipe::space {
namespace {

/// Faces of a cell with fewer than 128 vertices.
constexpr std::size_t most_small = 64;
constexpr std::size_t vector_size = 8;

/// What is known of two faces that follow each other around a cell: the face that follows these, and the
/// vertex of the three. Of cells of any size.
class LargeIndex {
 public:
  struct Entry {
    std::size_t next, vertex;
  };
  static constexpr std::size_t none = SIZE_MAX;
  explicit LargeIndex(std::size_t) {}
  std::size_t& next(std::size_t a, std::size_t b) { return at(a, b).next; }
  std::size_t& vertex(std::size_t a, std::size_t b) { return at(a, b).vertex; }

 private:
  Entry& at(std::size_t a, std::size_t b) {
    return map_.try_emplace(std::uint64_t{a} << 32 | b, Entry{none, none}).first->second;
  }
  std::unordered_map<std::uint64_t, Entry> map_;
};

/// The same for few faces.
class SmallIndex {
 public:
  static constexpr std::uint8_t none = 255;
  explicit SmallIndex(std::size_t faces) : faces_(faces) { std::memset(next_, none, faces * faces); }
  std::uint8_t& next(std::size_t a, std::size_t b) { return next_[a * faces_ + b]; }
  /// Undefined where none was set.
  std::uint8_t& vertex(std::size_t a, std::size_t b) { return vertex_[a * faces_ + b]; }

 private:
  std::size_t faces_;
  std::uint8_t next_[most_small * most_small], vertex_[most_small * most_small];
};

}  // namespace

CellCheck::CellCheck(const Places& places, const Rows& rows, bool moments)
    : places_(places),
      rows_(rows),
      find_corners_(findCorners()),
      tie_wall_(std::min({places.box.xmax - places.box.xmin, places.box.ymax - places.box.ymin,
                          places.box.zmax - places.box.zmin})) {
  job_.h_size = nullptr;
  job_.moments = moments;
}

void CellCheck::reserve(std::size_t faces, std::size_t edge_ends) {
  const std::size_t vertices = edge_ends / 3, edges = edge_ends / 2;
  if (faces + vector_size > face_room_) {
    face_room_ = 2 * faces + 64;
    by_face_.assign(8 * face_room_, 0);
    nx_ = by_face_.data();
    ny_ = nx_ + face_room_;
    nz_ = ny_ + face_room_;
    h_ = nz_ + face_room_;
    distance_ = h_ + face_room_;
    job_.nx = nx_;
    job_.ny = ny_;
    job_.nz = nz_;
    job_.h = h_;
    job_.distance = distance_;
    job_.twice_area = distance_ + face_room_;
    if (places_.weights != nullptr) {
      h_size_ = job_.twice_area + face_room_;
      job_.h_size = h_size_;
      job_.h_around = h_size_ + face_room_;
    }
  }
  if (vertices + vector_size > vertex_room_) {
    vertex_room_ = 2 * vertices + 128;
    by_vertex_.assign(4 * vertex_room_, 0);
    job_.x = by_vertex_.data();
    job_.y = job_.x + vertex_room_;
    job_.z = job_.y + vertex_room_;
    job_.error = job_.z + vertex_room_;
    corners_.assign(3 * vertex_room_, 0);
    for (std::size_t k = 0; k < 3; ++k) job_.corner[k] = corners_.data() + k * vertex_room_;
    turned_.assign(vertex_room_, 0);
    job_.turned = turned_.data();
  }
  if (edges + vector_size > edge_room_) {
    edge_room_ = 2 * edges + 192;
    edges_.assign(4 * edge_room_, 0);
    job_.a = edges_.data();
    job_.b = job_.a + edge_room_;
    job_.from = job_.b + edge_room_;
    job_.to = job_.from + edge_room_;
    unproved_.assign(edge_room_, 0);
    job_.unproved = unproved_.data();
  }
}

/// Takes the faces of the row: each neighbor once, none of them the site, and each with a cell of its own.
bool CellCheck::takeRow() {
  if (row_.faces < 4) return false;
  const Point3 p = places_.sites[site_];
  for (std::size_t f = 0; f < row_.faces; ++f) {
    const Label label = row_.neighbor[f];
    if (isWallLabel(label)) {
      const int wall = wallOf(label);
      if (wall >= walls) return false;
      const double outward = isUpper(wall) ? 1 : -1;
      const int axis = axisOf(wall);
      nx_[f] = axis == 0 ? outward : 0;
      ny_[f] = axis == 1 ? outward : 0;
      nz_[f] = axis == 2 ? outward : 0;
      h_[f] = outward * (places_.offset(wall) - (axis == 0 ? p.x : axis == 1 ? p.y : p.z));
      distance_[f] = tie_wall_;
      if (h_size_ != nullptr) h_size_[f] = std::abs(h_[f]);
    } else {
      if (label == site_ || static_cast<std::size_t>(label) >= rows_.size()) return false;
      rows_.prefetch(static_cast<std::size_t>(label));
      const Point3 q = places_.sites[label];
      nx_[f] = q.x - p.x;
      ny_[f] = q.y - p.y;
      nz_[f] = q.z - p.z;
      const double squared = nx_[f] * nx_[f] + ny_[f] * ny_[f] + nz_[f] * nz_[f];
      h_[f] = squared / 2;
      distance_[f] = std::sqrt(squared);
      if (h_size_ == nullptr) continue;
      const double lighter = places_.weights[site_] - places_.weights[label];
      h_[f] = (squared + lighter) / 2;
      h_size_[f] = (squared + std::abs(lighter)) / 2;
    }
  }
  if (row_.faces <= most_small) {
    for (std::size_t f = 1; f < row_.faces; ++f) {
      bool again = false;
      for (std::size_t g = 0; g < f; ++g) again = again || row_.neighbor[g] == row_.neighbor[f];
      if (again) return false;
    }
    return true;
  }
  std::vector<Label> sorted(row_.neighbor, row_.neighbor + row_.faces);
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) == sorted.end();
}

/// Takes vertices and edges out of the rings: a vertex is a cyclic triple of faces, the same in three rings.
/// Branches that cannot be foreseen would take longer than all else.
template <class Index, class Begin, class Entry>
bool CellCheck::takeRingsOf(Index& index, const Begin* begin, const Entry* rings) {
  using Number = std::remove_reference_t<decltype(index.next(0, 0))>;
  auto *const first = corners_.data(), *const second = first + vertex_room_,
              *const third = second + vertex_room_;
  const std::size_t faces = row_.faces, most = row_.edge_ends / 3;
  std::size_t vertices = 0, edges = 0;
  bool wrong = begin[faces] != row_.edge_ends;
  for (std::size_t a = 0; a < faces; ++a) {
    const std::size_t ring_end = begin[a + 1];
    if (ring_end < begin[a] + std::size_t{3} || ring_end > row_.edge_ends) return false;
    std::size_t b = rings[begin[a]];
    for (std::size_t k = begin[a]; k < ring_end; ++k) {
      const std::size_t c = rings[k + 1 == ring_end ? begin[a] : k + 1];
      if (b >= faces || c >= faces || vertices > most) return false;
      wrong |= a == b || b == c || c == a || index.next(a, b) != Index::none;
      index.next(a, b) = static_cast<Number>(c);
      first[vertices] = static_cast<std::int32_t>(a);
      second[vertices] = static_cast<std::int32_t>(b);
      third[vertices] = static_cast<std::int32_t>(c);
      vertices += a < b && a < c ? 1 : 0;
      b = c;
    }
  }
  // A third of all pairs of faces that follow each other begin a vertex with its least face. If each of these
  // follows in two more rings, all pairs belong to one.
  if (wrong || 3 * vertices != row_.edge_ends) return false;
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto a = static_cast<std::size_t>(first[v]), b = static_cast<std::size_t>(second[v]),
               c = static_cast<std::size_t>(third[v]);
    wrong |= index.next(b, c) != a || index.next(c, a) != b;
    index.vertex(a, b) = index.vertex(b, c) = index.vertex(c, a) = static_cast<Number>(v);
  }
  if (wrong) return false;
  auto *const edge_a = edges_.data(), *const edge_b = edge_a + edge_room_, *const from = edge_b + edge_room_,
              *const to = from + edge_room_;
  for (std::size_t a = 0; a < faces; ++a) {
    for (std::size_t k = begin[a]; k < begin[a + 1]; ++k) {
      const std::size_t b = rings[k];
      edge_a[edges] = static_cast<std::int32_t>(a);
      edge_b[edges] = static_cast<std::int32_t>(b);
      from[edges] = static_cast<std::int32_t>(index.vertex(a, b));
      to[edges] = static_cast<std::int32_t>(index.vertex(b, a));
      edges += b > a ? 1 : 0;
    }
  }
  job_.faces = faces;
  job_.vertices = vertices;
  job_.edges = edges;
  // What lies behind the last in a vector of them: any.
  for (std::size_t k = 0; k < vector_size; ++k) {
    first[vertices + k] = first[0];
    second[vertices + k] = second[0];
    third[vertices + k] = third[0];
    edge_a[edges + k] = edge_a[0];
    edge_b[edges + k] = edge_b[0];
    from[edges + k] = from[0];
    to[edges + k] = to[0];
  }
  return 2 * edges == row_.edge_ends;
}

bool CellCheck::takeRings() {
  if (row_.faces <= most_small) {
    SmallIndex index(row_.faces);
    return takeRingsOf(index, row_.small_begin, row_.small);
  }
  LargeIndex index(row_.faces);
  return row_.isSmall() ? takeRingsOf(index, row_.small_begin, row_.small)
                        : takeRingsOf(index, row_.large_begin, row_.large);
}

/// Whether each neighbor has this cell for a neighbor, and the ring of that face is this face's, reversed. Of
/// two cells the one of the lesser site compares rings.
bool CellCheck::isGlued(Verdict& verdict) const {
  for (std::size_t f = 0; f < row_.faces; ++f) {
    const Label label = row_.neighbor[f];
    if (isWallLabel(label)) continue;
    const Row other = rows_[static_cast<std::size_t>(label)];
    const std::size_t face = other.faceOf(site_);
    bool same = face < other.faces;
    if (same && site_ < label) {
      const Ring mine = row_.ring(f), theirs = other.ring(face);
      const std::size_t n = mine.size();
      same = n == theirs.size() && n > 0;
      if (same) {
        const Label start = row_.neighbor[mine[0]];
        std::size_t at = 0;
        while (at < n && other.neighbor[theirs[at]] != start) ++at;
        same = at < n;
        for (std::size_t k = 1; k < n && same; ++k) {
          at = at == 0 ? n - 1 : at - 1;
          same = row_.neighbor[mine[k]] == other.neighbor[theirs[at]];
        }
      }
    }
    if (same) continue;
    verdict.broken = Broken::glue;
    verdict.with[0] = label;
    return false;
  }
  return true;
}

/// Decides exactly what double does not prove.
bool CellCheck::provedExactly(Verdict& verdict, bool all) const {
  const auto isLeast = [this, all](Label label) { return all || isWallLabel(label) || site_ < label; };
  const auto label = [this](std::int32_t face) { return row_.neighbor[face]; };
  for (std::size_t v = 0; v < job_.vertices; ++v) {
    if (job_.turned[v] == 0) continue;
    const Label a = label(job_.corner[0][v]), b = label(job_.corner[1][v]), c = label(job_.corner[2][v]);
    if (!isLeast(a) || !isLeast(b) || !isLeast(c) || orientation(places_, site_, a, b, c) > 0) continue;
    verdict.broken = Broken::orientation;
    verdict.with = {a, b, c, -7};
    return false;
  }
  const auto third = [this](std::int32_t v, std::int32_t a, std::int32_t b) {
    return job_.corner[0][v] + job_.corner[1][v] + job_.corner[2][v] - a - b;
  };
  for (std::size_t e = 0; e < job_.edges; ++e) {
    if (job_.unproved[e] == 0) continue;
    const std::int32_t fa = job_.a[e], fb = job_.b[e];
    const Label a = label(fa), b = label(fb);
    if (!isLeast(a) || !isLeast(b)) continue;
    const Label c = label(third(job_.from[e], fa, fb)), d = label(third(job_.to[e], fa, fb));
    if (!cuts(places_, site_, a, b, c, d)) continue;
    verdict.broken = Broken::edge;
    verdict.with = {a, b, c, d};
    return false;
  }
  return true;
}

Verdict CellCheck::check(Label site, Signs signs, bool measure) {
  Verdict verdict;
  site_ = site;
  row_ = rows_[static_cast<std::size_t>(site)];
  reserve(row_.faces, row_.edge_ends);
  if (!takeRow()) {
    verdict.broken = Broken::row;
    return verdict;
  }
  if (!takeRings()) {
    verdict.broken = Broken::rings;
    return verdict;
  }
  job_.measure = measure;
  job_.tie = 1.01e-6;
  find_corners_(job_);
  verdict.tied = job_.tied;
  verdict.unsure = job_.unsure;
  for (std::size_t f = 0; f < row_.faces; ++f) {
    if (isWallLabel(row_.neighbor[f]) || !(distance_[f] < verdict.distance)) continue;
    verdict.nearest = static_cast<std::uint32_t>(row_.neighbor[f]);
    verdict.distance = distance_[f];
  }
  if (signs != Signs::all && !isGlued(verdict)) return verdict;
  if (signs != Signs::none && (job_.tied || job_.unsure)) provedExactly(verdict, signs == Signs::all);
  return verdict;
}

CellMeasures CellCheck::measures() const {
  return {job_.volume, job_.surface, {job_.centroid[0], job_.centroid[1], job_.centroid[2]}};
}

std::array<double, 6> CellCheck::secondMoments() const { return std::to_array(job_.second_moments); }

double CellCheck::faceArea(std::size_t face) const {
  const double squared = nx_[face] * nx_[face] + ny_[face] * ny_[face] + nz_[face] * nz_[face];
  return job_.twice_area[face] / (2 * std::sqrt(squared));
}

}  // namespace vorpipe::space
