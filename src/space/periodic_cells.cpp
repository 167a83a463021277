#include "space/periodic_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "base/parallel.h"
#include "base/try.h"
#include "space/box_cells.h"
#include "space/period.h"
#include "vorpipe/forecast.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_of_part = 512;

/// a - b + c
Shift relativeShift(Shift a, const Shift& b, const Shift& c) {
  for (std::size_t r = 0; r < 3; ++r) a[r] += c[r] - b[r];
  return a;
}

/// A band that is wide enough for white noise, in most runs.
double likelyBand(const Period& period, std::size_t sites) {
  // The largest of the empty balls, of 6.77 for each site, whose volumes times the density have a gamma
  // distribution of order 3. In a long or flat period that few sites fill, they lie in a row or a layer.
  const auto n = static_cast<double>(sites);
  std::array<double, 3> length{};
  for (std::size_t r = 0; r < 3; ++r) {
    const Vector3& v = period.vectors()[r];
    length[r] = std::hypot(v[0], v[1], v[2]);
  }
  std::ranges::sort(length);
  const double spacing = std::max({std::cbrt(period.volume() / n),
                                   std::sqrt(length[1] / n) * std::sqrt(length[2]), length[2] / n}),
               radius = std::cbrt(0.2387 * (std::log(n) + 0.5));
  constexpr double of_few = 1.75;  // the diagonal of a cube
  return spacing * std::max(of_few, 2 * radius);
}

/// A band that is wide enough for any sites. No place is farther from some image of the heaviest site than
/// this distance r: half of each vector, and to the farther wall. So where the cell of another ends, that
/// has a power of at most r^2 less the largest weight; its empty balls have at most the radius r, and their
/// centers are not farther than r from the site.
double enoughBand(const Period& period, std::span<const Point3> sites, const Cells3Options& options) {
  const auto heaviest =
      options.weights.empty() ? 0 : std::ranges::max_element(options.weights) - options.weights.begin();
  const Point3& p = sites[static_cast<std::size_t>(heaviest)];
  const Vector3 at{p.x, p.y, p.z};
  double squared = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    const Vector3& v = period.vectors()[r];
    const double length = std::hypot(v[0], v[1], v[2]);
    const double most = period.repeats(r) ? length / 2 : length / 2 + std::abs(at[r] - period.middle()[r]);
    squared += most * most;
  }
  return 2 * std::sqrt(squared);
}

/// From the diagram of sites and images to that of the sites.
class PeriodEnd {
 public:
  PeriodEnd(const Period& period, const ImagedSites& imaged, std::span<const Point3> sites, int threads,
            Diagram3& diagram)
      : period_(period),
        imaged_(imaged),
        sites_(sites),
        is_any_moved_(std::ranges::find_if(imaged.home, [](const Shift& home) { return home != Shift{}; }) !=
                      imaged.home.end()),
        threads_(threads),
        out_(diagram) {}

  void write() {
    const std::size_t n = sites_.size();
    out_.status.resize(n);
    out_.owner.resize(n);
    out_.volume.resize(n);
    out_.surface.resize(n);
    out_.centroid.resize(n);
    out_.face_offsets.resize(n + 1);
    out_.neighbors.resize(out_.face_offsets[n]);
    out_.face_areas.resize(out_.face_offsets[n]);
    const bool polyhedra = !out_.face_vertex_offsets.empty();
    if (polyhedra) {
      out_.second_moments.resize(n);
      takeVertices();
    }
    orderFaces(polyhedra);
    for (std::size_t i = 0; i < n; ++i)
      out_.centroid[i] = out_.status[i] == Status::ok ? placed(out_.centroid[i], imaged_.home[i]) : sites_[i];
    constexpr std::uint64_t least_faces = 4;
    out_.flat = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_flat = out_.face_offsets[i + 1] - out_.face_offsets[i] < least_faces;
      if (out_.status[i] == Status::ok && is_flat) ++out_.flat;
    }
  }

 private:
  /// The site of the caller that a neighbor is, or is an image of, and by how much that is moved.
  [[nodiscard]] Image imageOf(std::int64_t neighbor) const {
    const auto site = static_cast<std::uint32_t>(neighbor);
    return site < sites_.size() ? Image{site, {}} : imaged_.images[site - sites_.size()];
  }

  /// A place of the run, beside a site that is so many vectors away from its place in the run.
  [[nodiscard]] Point3 placed(const Point3& place, const Shift& home) const {
    Vector3 by = imaged_.middle;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t a = 0; a < 3; ++a) by[a] += home[r] * imaged_.vector[r][a];
    }
    return {place.x + by[0], place.y + by[1], place.z + by[2]};
  }

  struct FaceOfCell {
    std::int64_t neighbor;
    Shift shift;
    double area;
    std::uint64_t ring, ring_end;  ///< of vertices of the cell
    [[nodiscard]] auto key() const {
      return std::tuple(isWall(neighbor) ? -1 : neighbor, isWall(neighbor) ? neighbor : 0, shift);
    }
  };

  /// Names each face by the caller's site and by the shift to its image, and orders those of a cell so.
  void orderFaces(bool polyhedra) {
    reserveAll(out_.neighbor_shifts, out_.neighbors.size(), threads_);
    out_.neighbor_shifts.resize(out_.neighbors.size());
    parallelFor(sites_.size(), cells_of_part, threads_, [&](std::size_t begin, std::size_t end) {
      std::vector<FaceOfCell> faces;
      std::vector<std::uint32_t> rings;
      for (std::size_t i = begin; i < end; ++i) {
        if (!is_any_moved_ && hasNoImage(i)) continue;
        takeFaces(i, faces);
        if (polyhedra) orderRings(i, faces, rings);
        std::ranges::sort(faces, {}, &FaceOfCell::key);
        std::uint64_t to = out_.face_offsets[i];
        for (const auto& face : faces) {
          out_.neighbors[to] = face.neighbor;
          out_.neighbor_shifts[to] = face.shift;
          out_.face_areas[to++] = face.area;
        }
      }
    });
  }

  /// Whether no face is with an image: so it is of most cells.
  [[nodiscard]] bool hasNoImage(std::size_t i) const {
    const auto begin = out_.neighbors.begin();
    return std::all_of(
        begin + static_cast<std::ptrdiff_t>(out_.face_offsets[i]),
        begin + static_cast<std::ptrdiff_t>(out_.face_offsets[i + 1]),
        [count = static_cast<std::int64_t>(sites_.size())](std::int64_t n) { return n < count; });
  }

  void takeFaces(std::size_t i, std::vector<FaceOfCell>& faces) const {
    faces.clear();
    for (std::uint64_t f = out_.face_offsets[i]; f < out_.face_offsets[i + 1]; ++f) {
      FaceOfCell face{out_.neighbors[f], {}, out_.face_areas[f], 0, 0};
      if (!isWall(face.neighbor)) {
        const Image image = imageOf(face.neighbor);
        face.neighbor = image.site;
        face.shift = period_.ofOptions(relativeShift(image.shift, imaged_.home[image.site], imaged_.home[i]));
      }
      faces.push_back(face);
    }
  }

  void orderRings(std::size_t i, std::vector<FaceOfCell> faces, std::vector<std::uint32_t>& rings) {
    const std::uint64_t first = out_.face_offsets[i], begin = out_.face_vertex_offsets[first];
    for (std::size_t f = 0; f < faces.size(); ++f) {
      faces[f].ring = out_.face_vertex_offsets[first + f] - begin;
      faces[f].ring_end = out_.face_vertex_offsets[first + f + 1] - begin;
    }
    const std::uint32_t* const all = out_.face_vertices.data();
    rings.assign(all + begin, all + out_.face_vertex_offsets[first + faces.size()]);
    std::ranges::sort(faces, {}, &FaceOfCell::key);
    std::uint64_t to = begin;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (f > 0) out_.face_vertex_offsets[first + f] = to;  // where the cell begins others may be reading
      for (std::uint64_t k = faces[f].ring; k < faces[f].ring_end; ++k) out_.face_vertices[to++] = rings[k];
    }
  }

  /// Keeps the vertices of the caller's cells, at their places beside the sites. A vertex of two cells that
  /// are moved differently becomes two.
  void takeVertices() {
    const std::uint64_t faces = out_.face_offsets.back();
    out_.face_vertex_offsets.resize(faces + 1);
    out_.face_vertices.resize(out_.face_vertex_offsets.back());
    // Vertices are numbered by the first of their cells: those of the caller come first.
    std::uint32_t count = 0;
    for (const std::uint32_t v : out_.face_vertices) count = std::max(count, v + 1);
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> cell_of(count, none);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> copies;  // of a vertex, beside the cell of a site
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> copies_of;
    for (std::uint32_t i = 0; i < sites_.size(); ++i) {
      const std::uint64_t begin = out_.face_vertex_offsets[out_.face_offsets[i]],
                          end = out_.face_vertex_offsets[out_.face_offsets[i + 1]];
      for (std::uint64_t k = begin; k < end; ++k) {
        const std::uint32_t v = out_.face_vertices[k];
        if (cell_of[v] == none) cell_of[v] = i;
        if (imaged_.home[cell_of[v]] == imaged_.home[i]) continue;
        auto& known = copies_of[v];
        const auto same = std::ranges::find_if(
            known, [&](std::uint32_t c) { return imaged_.home[copies[c].second] == imaged_.home[i]; });
        if (same == known.end()) {
          known.push_back(static_cast<std::uint32_t>(copies.size()));
          copies.emplace_back(v, i);
          out_.face_vertices[k] = count + known.back();
        } else {
          out_.face_vertices[k] = count + *same;
        }
      }
    }
    std::vector<Point3> vertices(count + copies.size());
    std::vector<std::uint64_t> offsets(vertices.size() + 1, 0);
    std::vector<std::int64_t> sites;
    sites.reserve(4 * vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const auto [from, cell] = v < count ? std::pair(v, cell_of[v]) : copies[v - count];
      vertices[v] = placed(out_.vertices[from], imaged_.home[cell]);
      const std::size_t first = sites.size();
      for (std::uint64_t k = out_.vertex_site_offsets[from]; k < out_.vertex_site_offsets[from + 1]; ++k) {
        const std::int64_t number = out_.vertex_sites[k];
        sites.push_back(isWall(number) ? number : std::int64_t{imageOf(number).site});
      }
      std::sort(sites.begin() + static_cast<std::ptrdiff_t>(first), sites.end());
      offsets[v + 1] = sites.size();
    }
    out_.vertices = std::move(vertices);
    out_.vertex_site_offsets = std::move(offsets);
    out_.vertex_sites = std::move(sites);
  }

  const Period& period_;
  const ImagedSites& imaged_;
  std::span<const Point3> sites_;
  bool is_any_moved_;
  int threads_;
  Diagram3& out_;
};

/// How much wider the band must be at least; 0 if all cells are right. Balls that lie in the box hold all
/// sites that could cut them. So these cells are right; each side of one that is no wall is one of an image
/// of another, and if that has a cell, too, they fill the period: who has none has none among all images.
double missing(const Diagram3& diagram, const LeftOut& left_out, const ImagedSites& imaged, double band) {
  double missing = 0;
  bool is_any_empty = false;
  const std::size_t n = imaged.home.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (diagram.status[i] == Status::ok) missing = std::max(missing, left_out.beyond[i]);
    is_any_empty = is_any_empty || diagram.status[i] == Status::empty;
  }
  if (!is_any_empty) return missing;
  for (std::uint64_t f = 0; f < diagram.face_offsets[n]; ++f) {
    const std::int64_t neighbor = diagram.neighbors[f];
    if (isWall(neighbor)) continue;
    auto site = static_cast<std::size_t>(neighbor);
    if (site >= n) site = imaged.images[site - n].site;
    if (diagram.status[site] != Status::ok) missing = std::max(missing, band);
  }
  return missing;
}

}  // namespace

Result<Diagram3> periodicCells(std::span<const Point3> sites, const Cells3Options& options, int threads) {
  const Period period(options);
  const double enough = enoughBand(period, sites, options);
  constexpr double least_growth = 1.25, margin = 1.0001;
  double band = std::min(likelyBand(period, sites.size()), margin * enough);
  for (;;) {
    VORPIPE_LET(imaged, withImages(period, sites, options, band, threads));
    Cells3Options of_box = options;
    of_box.domain = imaged.box;
    of_box.weights = imaged.weights;
    of_box.periodic = {};
    of_box.lattice.reset();
    LeftOut left_out{{period.along(0), period.along(1), period.along(2)}, sites.size(), {}};
    VORPIPE_VAR(diagram, boxCells(imaged.sites, of_box, threads, &left_out));
    const double wider = missing(diagram, left_out, imaged, band);
    if (wider <= 0) {
      PeriodEnd(period, imaged, sites, threads, diagram).write();
      return std::move(diagram);
    }
    band = std::max(least_growth * band, std::min(band + wider, enough) * margin);
  }
}

}  // namespace vorpipe::space

namespace vorpipe {

std::uint64_t imagesInSpace(std::uint64_t sites, const Cells3Options& options) {
  Cells3Options of_any = options;
  of_any.weights = {};
  const Point3 any{};
  if (!options.repeats() || sites == 0 || !checkInput(std::span(&any, 1), of_any)) return 0;
  const space::Period period(options);
  const double band = space::likelyBand(period, sites);
  double ratio = 1 / period.volume();
  for (std::size_t a = 0; a < 3; ++a) {
    double side = period.along(a) ? 2 * band : 0;
    for (const auto& vector : period.vectors()) side += std::abs(vector[a]);
    ratio *= side;
  }
  return static_cast<std::uint64_t>((ratio - 1) * static_cast<double>(sites));
}

}  // namespace vorpipe
