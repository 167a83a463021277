/// The records of cells before and after they are clipped to an outline.
#pragma once

#include <memory>
#include <span>

#include "cells/cell_record.h"
#include "cells/neighbor_rows.h"
#include "domain/clip_cell.h"
#include "sites/site_set.h"

namespace vorpipe::core {

/// The sites and the domain of a diagram, and the cells as they were found.
struct ClippedRun {
  const Sites& sites;
  const Box& domain;
  const SiteSet& set;
  const NeighborRows& rows;
  int exponent;  ///< computation is in the caller's units times 2^exponent
  int threads;
};

/// A diagram's cells, scaled so that the domain's size is about 1.
class ScaledDiagram {
 public:
  ScaledDiagram(const ClippedRun& run, const Diagram& diagram);

  [[nodiscard]] std::size_t size() const { return diagram_.status.size(); }
  [[nodiscard]] int threads() const { return run_.threads; }
  [[nodiscard]] const Box& domain() const { return domain_; }
  /// The site of a cell of the set.
  [[nodiscard]] std::uint32_t siteOf(std::size_t cell) const { return run_.set.id[cell]; }
  [[nodiscard]] bool hasCell(std::size_t site) const { return diagram_.status[site] == Status::ok; }
  [[nodiscard]] Point site(std::size_t site) const {
    return scaled({run_.sites.x[site], run_.sites.y[site]});
  }
  /// In the caller's units.
  [[nodiscard]] Point givenSite(std::size_t site) const { return {run_.sites.x[site], run_.sites.y[site]}; }
  [[nodiscard]] Point centroid(std::size_t site) const { return scaled(diagram_.centroid[site]); }
  [[nodiscard]] std::size_t begin(std::size_t site) const { return diagram_.cell_offsets[site]; }
  [[nodiscard]] std::size_t end(std::size_t site) const { return diagram_.cell_offsets[site + 1]; }
  [[nodiscard]] Point vertex(std::size_t edge) const { return scaled(diagram_.vertices[edge]); }
  [[nodiscard]] std::int64_t neighbor(std::size_t edge) const { return diagram_.neighbors[edge]; }
  [[nodiscard]] std::size_t next(std::size_t site, std::size_t edge) const {
    return edge + 1 < end(site) ? edge + 1 : begin(site);
  }
  /// Whether both ends of an edge of a site's cell are equal after rounding. Clipped cells omit such edges,
  /// in both of their cells.
  [[nodiscard]] bool isPoint(std::size_t site, std::size_t edge) const {
    const Point a = vertex(edge), b = vertex(next(site, edge));
    return a.x == b.x && a.y == b.y;
  }
  /// Appends the cell of a site, where edge k has the neighbor k.
  void appendCell(std::size_t site, std::vector<Point>& vertices, std::vector<std::int64_t>& neighbors) const;

  [[nodiscard]] double scaled(double value, int power = 1) const { return scale_(value, power); }
  [[nodiscard]] Point scaled(Point p) const { return scale_(p); }
  [[nodiscard]] double unscaled(double value, int power = 1) const { return unscale_(value, power); }
  [[nodiscard]] Point unscaled(Point p) const { return unscale_(p); }

 private:
  const ClippedRun& run_;
  const Diagram& diagram_;
  Unscale scale_, unscale_;
  Box domain_;
};

/// The outcome for a cell; a cell that is neither outside nor cut stays as it is.
enum class Fate : std::uint8_t { none, inside, outside, cut };

struct ClippedCells {
  explicit ClippedCells(std::size_t sites) : fate(sites, Fate::none), parts(sites) {}
  std::vector<Fate> fate;                           ///< by site
  std::vector<std::unique_ptr<ClippedCell>> parts;  ///< of cells that are cut
};

/// Replaces the records in `diagram`, which `cells` refers to, as clipToOutline specifies, except the
/// measures of cells that are cut.
void writeClipped(const ScaledDiagram& cells, const ClippedCells& clipped, Diagram& diagram);

}  // namespace vorpipe::core
