#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "base/try.h"
#include "domain/edge_tree.h"
#include "domain/geos_outline.h"
#include "domain/rings.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

/// A region thinner than this is rounding, not area: relative to its length, or to its extent beside that of
/// the outline.
constexpr double thinnest = 1e-10;

double lengthOfRing(std::span<const Point> ring) {
  double length = 0;
  eachSide(ring, [&](Point a, Point b) { length += std::hypot(b.x - a.x, b.y - a.y); });
  return length;
}

double areaOf(const Outline& outline, std::size_t polygon) {
  const auto begin = outline.polygon_offsets[polygon];
  double area = 0;
  for (auto r = begin; r < outline.polygon_offsets[polygon + 1]; ++r) {
    area += (r == begin ? 1 : -1) * std::abs(areaOfRing(ringAt(outline, r)));
  }
  return area;
}

double areaOf(const Outline& outline) {
  double area = 0;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) area += areaOf(outline, p);
  return area;
}

/// The outline without polygons and holes that are slivers; counts these.
Outline withoutSlivers(const Outline& outline, std::size_t& slivers) {
  Outline kept;
  kept.ring_offsets = kept.polygon_offsets = {0};
  if (outline.empty()) return kept;
  const Box box = boxOf(outline.points);
  const double least = thinnest * thinnest * (box.xmax - box.xmin) * (box.ymax - box.ymin);
  const auto isSliver = [&](std::span<const Point> ring) {
    const double length = lengthOfRing(ring);
    return std::abs(areaOfRing(ring)) <= std::max(least, thinnest * length * length);
  };
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    const auto begin = outline.polygon_offsets[p];
    for (auto r = begin; r < outline.polygon_offsets[p + 1]; ++r) {
      const auto ring = ringAt(outline, r);
      if (isSliver(ring)) {
        ++slivers;
        if (r == begin) break;
        continue;
      }
      kept.points.insert(kept.points.end(), ring.begin(), ring.end());
      kept.ring_offsets.push_back(kept.points.size());
    }
    if (kept.ring_offsets.size() - 1 > kept.polygon_offsets.back()) {
      kept.polygon_offsets.push_back(kept.ring_offsets.size() - 1);
    }
  }
  return kept;
}

/// The rings of a polygon unchanged; they may cross.
Rings ringsOf(const Outline& outline, std::size_t polygon) {
  Rings rings;
  rings.offsets.push_back(0);
  for (auto r = outline.polygon_offsets[polygon]; r < outline.polygon_offsets[polygon + 1]; ++r) {
    const auto points = ringAt(outline, r);
    rings.points.insert(rings.points.end(), points.begin(), points.end());
    rings.ring.insert(rings.ring.end(), points.size(), static_cast<std::uint32_t>(rings.offsets.size() - 1));
    rings.offsets.push_back(static_cast<std::uint32_t>(rings.points.size()));
  }
  return rings;
}

/// Decides which places belong to a polygon.
class Windings {
 public:
  explicit Windings(const Rings& rings)
      : rings_(rings), index_(rings), xmax_(boxOf(rings.points).xmax), odd_(rings.offsets.size() - 1) {}

  /// Whether the first ring winds around p an odd number of times, and none of the others does.
  bool contains(Point p) {
    std::fill(odd_.begin(), odd_.end(), false);
    index_.edgesIn({p.x, p.y, std::max(p.x, xmax_), p.y}, edges_);
    for (const auto e : edges_) {
      const auto ring = rings_.ring[e];
      odd_[ring] = odd_[ring] != crossesRay(rings_.points[e], rings_.endOf(e), p);
    }
    return odd_.front() && std::find(odd_.begin() + 1, odd_.end(), true) == odd_.end();
  }

 private:
  const Rings& rings_;
  OutlineIndex index_;
  double xmax_;
  std::vector<bool> odd_;  ///< by ring
  std::vector<std::uint32_t> edges_;
};

/// All faces that rings separate from each other, as polygons.
GeosGeometry facesOf(const Geos& geos, const Rings& rings) {
  std::vector<GeosGeometry> lines;
  for (std::size_t r = 0; r + 1 < rings.offsets.size(); ++r) {
    const auto begin = rings.offsets[r], end = rings.offsets[r + 1];
    lines.push_back(geosRing(geos, std::span(rings.points).subspan(begin, end - begin)));
  }
  const GeosGeometry crossing = collected(geos, GEOS_GEOMETRYCOLLECTION, std::move(lines));
  if (!crossing) return owned(geos, nullptr);
  const GeosGeometry parted = owned(geos, GEOSUnaryUnion_r(geos.handle(), crossing.get()));
  if (!parted) return owned(geos, nullptr);
  const GEOSGeometry* const all = parted.get();
  return owned(geos, GEOSPolygonize_r(geos.handle(), &all, 1));
}

/// Returns the region that a polygon's outer ring winds around an odd number of times, minus the like regions
/// of its holes. Null if GEOS refuses. Time and memory grow with the number of edges and their crossings.
GeosGeometry repairedPolygon(const Geos& geos, const Outline& outline, std::size_t polygon) {
  const Rings rings = ringsOf(outline, polygon);
  const GeosGeometry faces = facesOf(geos, rings);
  if (!faces) return owned(geos, nullptr);
  Windings windings(rings);
  std::vector<GeosGeometry> kept;
  const int count = GEOSGetNumGeometries_r(geos.handle(), faces.get());
  for (int k = 0; k < count; ++k) {
    const GEOSGeometry* const face = GEOSGetGeometryN_r(geos.handle(), faces.get(), k);
    const GeosGeometry within = owned(geos, GEOSPointOnSurface_r(geos.handle(), face));
    Point p{0, 0};
    if (!readPoint(geos, within.get(), p)) return owned(geos, nullptr);
    if (windings.contains(p)) kept.push_back(owned(geos, GEOSGeom_clone_r(geos.handle(), face)));
  }
  const GeosGeometry parts = collected(geos, GEOS_MULTIPOLYGON, std::move(kept));
  return owned(geos, parts ? GEOSUnaryUnion_r(geos.handle(), parts.get()) : nullptr);
}

/// Mends one outline.
class Mending {
 public:
  Mending(const Outline& outline, bool repair, const OutlineWords& words)
      : outline_(outline), repair_(repair), words_(words) {}

  Result<MendedOutline> run() {
    const GeosGeometry whole = geometryOf(geos_, outline_);
    VORPIPE_LET(fault, faultOf(geos_, whole.get(), words_.place));
    if (!fault) return MendedOutline{outline_, {}};
    VORPIPE_TRY(checkEach());
    return unite();
  }

 private:
  [[nodiscard]] tl::unexpected<Error> failed() const {
    return refuseOutline(fmt::format("GEOS could not mend it: {}", geos_.message()));
  }

  /// Keeps each polygon that is valid by itself; repairs the others.
  Result<void> checkEach() {
    for (std::size_t p = 0; p + 1 < outline_.polygon_offsets.size(); ++p) {
      GeosGeometry polygon = polygonOf(geos_, outline_, p);
      VORPIPE_LET(fault, faultOf(geos_, polygon.get(), words_.place));
      if (fault) {
        if (!repair_) {
          return refuseOutline(
              fmt::format("{}; rings must not cross themselves or each other, and holes must lie "
                          "inside their polygon",
                          *fault));
        }
        if (repaired_ == 0) first_fault_ = *fault;
        ++repaired_;
        polygon = repaired(p);
        if (!polygon) return failed();
      }
      sum_ += area(polygon);
      parts_.push_back(std::move(polygon));
    }
    return {};
  }

  [[nodiscard]] double area(const GeosGeometry& geometry) const {
    double area = 0;
    return GEOSArea_r(geos_.handle(), geometry.get(), &area) == 1 ? area : 0;
  }

  /// Same as repairedPolygon, with counting.
  GeosGeometry repaired(std::size_t polygon) {
    area_before_ += areaOf(outline_, polygon);
    rings_before_ += outline_.polygon_offsets[polygon + 1] - outline_.polygon_offsets[polygon];
    GeosGeometry inside = repairedPolygon(geos_, outline_, polygon);
    Outline after;
    if (!inside || !addPolygons(geos_, inside.get(), after)) return owned(geos_, nullptr);
    rings_after_ += after.ring_offsets.size() - 1;
    parts_made_ += after.polygon_offsets.size() - 1;
    area_after_ += area(inside);
    return inside;
  }

  Result<MendedOutline> unite() {
    const std::size_t parts = parts_.size() - repaired_ + parts_made_;
    const GeosGeometry all = collected(geos_, GEOS_GEOMETRYCOLLECTION, std::move(parts_));
    if (!all) return failed();
    const GeosGeometry together = owned(geos_, GEOSUnaryUnion_r(geos_.handle(), all.get()));
    Outline united;
    if (!together || !addPolygons(geos_, together.get(), united)) return failed();
    MendedOutline mended;
    std::size_t slivers = 0;
    mended.outline = withoutSlivers(united, slivers);
    if (mended.outline.empty()) return refuseOutline("nothing of it has an area");
    mended.changes = changes(parts, mended.outline, slivers);
    return mended;
  }

  [[nodiscard]] std::string changes(std::size_t parts, const Outline& after, std::size_t slivers) const {
    std::string text;
    if (repaired_ > 0) {
      text = fmt::format(
          "{} of {} polygons repaired, the first for a {}: their rings were {} and are {}, "
          "their area was {:.6g} and is {:.6g}{}",
          repaired_, outline_.polygon_offsets.size() - 1, first_fault_, rings_before_, rings_after_,
          area_before_, area_after_, words_.unit_of_area);
    }
    const std::size_t left = after.polygon_offsets.size() - 1;
    constexpr double rounding = 1e-9;
    const double area = areaOf(after);
    const bool overlap = sum_ - area > rounding * sum_;
    if (overlap || left + (slivers > 0 ? 1 : 0) < parts || repaired_ == 0) {
      text += fmt::format("{}{} polygons that {} dissolved into {}", text.empty() ? "" : "; ", parts,
                          overlap ? "overlap" : "touch", left);
      if (overlap)
        text += fmt::format(", the area of all was {:.6g}, without overlaps it is {:.6g}{}", sum_, area,
                            words_.unit_of_area);
    }
    if (slivers > 0) text += fmt::format("; slivers without area left out: {}", slivers);
    return text;
  }

  Geos geos_;
  const Outline& outline_;
  bool repair_;
  const OutlineWords& words_;
  std::vector<GeosGeometry> parts_;  ///< by polygon
  double sum_ = 0;                   ///< of the areas of parts
  std::size_t repaired_ = 0, parts_made_ = 0, rings_before_ = 0, rings_after_ = 0;
  double area_before_ = 0, area_after_ = 0;
  std::string first_fault_;
};

}  // namespace
}  // namespace vorpipe::core

namespace vorpipe {

Result<MendedOutline> mended(const Outline& outline, bool repair, const OutlineWords& words) {
  if (outline.empty()) return MendedOutline{};
  try {
    VORPIPE_TRY(core::checkRings(outline));
    return core::Mending(outline, repair, words).run();
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "there is not enough memory to mend the outline"});
  }
}

}  // namespace vorpipe
