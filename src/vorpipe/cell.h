/// One cell of a Diagram, read in place.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe/cells.h"

namespace vorpipe {

/// The closed rings that bound a cell: one, or none if the cell has no vertices. In a domain with an outline
/// there may be several: outer ones counter-clockwise, each followed by its holes, clockwise. Ring r is a
/// contiguous part of the cell's vertices, in the same order; its edges have the same positions among the
/// cell's neighbors. The diagram outlives this object.
class CellRings {
 public:
  CellRings(const Diagram& diagram, std::size_t cell)
      : vertices_(diagram.vertices), end_(diagram.cell_offsets[cell + 1]) {
    const std::uint64_t begin = diagram.cell_offsets[cell];
    if (begin == end_ || diagram.vertices.empty()) return;
    if (diagram.ring_starts.empty()) {
      begin_ = begin;
      size_ = 1;
      return;
    }
    const auto first = std::ranges::lower_bound(diagram.ring_starts, begin);
    const auto last = std::lower_bound(first, diagram.ring_starts.end(), end_);
    starts_ = std::span(first, last);
    size_ = starts_.size();
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }

  /// Where ring r begins and ends in Diagram::vertices.
  [[nodiscard]] std::uint64_t begin(std::size_t r) const {
    assert(r < size_);
    return starts_.empty() ? begin_ : starts_[r];
  }
  [[nodiscard]] std::uint64_t end(std::size_t r) const { return r + 1 < size_ ? begin(r + 1) : end_; }

  /// The vertices of ring r; the first is not repeated at its end.
  [[nodiscard]] std::span<const Point> operator[](std::size_t r) const {
    return vertices_.subspan(begin(r), end(r) - begin(r));
  }

  /// Whether ring r bounds a hole of the last outer ring before it.
  [[nodiscard]] bool isHole(std::size_t r) const {
    if (r == 0) return false;
    const auto ring = (*this)[r];
    double twice_area = 0;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      const Point &a = ring[k], &b = ring[k + 1];
      twice_area += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
    }
    return twice_area < 0;
  }

 private:
  std::span<const Point> vertices_;
  std::span<const std::uint64_t> starts_;  ///< empty without an outline
  std::uint64_t begin_ = 0, end_;
  std::size_t size_ = 0;
};

/// Cell `index` of a diagram, which outlives this object: the record of a site, whatever its status. Which
/// values exist depends on the run's Detail and density; asking for another value is an error of the caller.
/// Lists that the diagram lacks are empty.
class Cell {
 public:
  Cell(const Diagram& diagram, std::size_t index) : diagram_(&diagram), index_(index) {
    assert(index < diagram.size());
  }

  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] Status status() const { return at(diagram_->status); }
  /// The cell's own site; for a duplicate, the site that owns the cell.
  [[nodiscard]] std::uint32_t owner() const { return at(diagram_->owner); }

  [[nodiscard]] double area() const { return at(diagram_->area); }
  [[nodiscard]] double perimeter() const { return at(diagram_->perimeter); }
  [[nodiscard]] Point centroid() const { return at(diagram_->centroid); }
  /// About the centroid: integrals of xx, xy, yy.
  [[nodiscard]] std::array<double, 3> secondMoments() const { return at(diagram_->second_moments); }
  [[nodiscard]] double mass() const { return at(diagram_->mass); }
  [[nodiscard]] Point massCentroid() const { return at(diagram_->mass_centroid); }

  /// Number of edges and of vertices: edge k runs from vertex k to the next one of its ring.
  [[nodiscard]] std::size_t edges() const { return end() - begin(); }
  [[nodiscard]] std::span<const Point> vertices() const { return part(diagram_->vertices); }
  /// The neighbor across each edge: a site or a wall; see isWall().
  [[nodiscard]] std::span<const std::int64_t> neighbors() const { return part(diagram_->neighbors); }
  [[nodiscard]] std::span<const double> edgeLengths() const { return part(diagram_->edge_lengths); }
  /// Per neighbor in a periodic domain: the offset, in periods, of the image that the cell meets from the
  /// neighbor itself.
  [[nodiscard]] std::span<const std::array<std::int32_t, 2>> shifts() const {
    return part(diagram_->neighbor_shifts);
  }
  [[nodiscard]] CellRings rings() const { return {*diagram_, index_}; }

  /// The cell's range in the diagram's vertices, neighbors, edge lengths and shifts.
  [[nodiscard]] std::uint64_t begin() const { return diagram_->cell_offsets[index_]; }
  [[nodiscard]] std::uint64_t end() const { return diagram_->cell_offsets[index_ + 1]; }

 private:
  template <class Element>
  [[nodiscard]] Element at(const std::vector<Element>& array) const {
    assert(index_ < array.size());
    return array[index_];
  }
  template <class Element>
  [[nodiscard]] std::span<const Element> part(const std::vector<Element>& array) const {
    if (array.empty()) return {};
    return std::span(array).subspan(begin(), edges());
  }

  const Diagram* diagram_;
  std::size_t index_;
};

/// Iterates over the cells of a diagram.
class CellIterator {
 public:
  using value_type = Cell;
  using difference_type = std::ptrdiff_t;

  CellIterator() = default;
  CellIterator(const Diagram& diagram, std::size_t index) : diagram_(&diagram), index_(index) {}

  Cell operator*() const { return {*diagram_, index_}; }
  CellIterator& operator++() {
    ++index_;
    return *this;
  }
  CellIterator operator++(int) {
    const CellIterator before = *this;
    ++index_;
    return before;
  }
  friend bool operator==(const CellIterator&, const CellIterator&) = default;

 private:
  const Diagram* diagram_ = nullptr;
  std::size_t index_ = 0;
};

inline Cell Diagram::cell(std::size_t site) const { return {*this, site}; }
inline CellIterator Diagram::begin() const { return {*this, 0}; }
inline CellIterator Diagram::end() const { return {*this, size()}; }

}  // namespace vorpipe
