/// Power centers of many triples of sites at once, in double-double, vectorized over the triples.
#pragma once

#include <array>
#include <cstddef>

#include "geometry/vertex_position.h"

namespace vorpipe::core {

class CenterBatch {
 public:
  static constexpr std::size_t room = 64;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool isFull() const { return size_ == room; }
  void clear() { size_ = 0; }
  /// `corner` is the caller's number for the triple; corner(k) returns it.
  void add(std::size_t corner, const Triple& triple);

  /// Finds all centers.
  void place();

  [[nodiscard]] std::size_t corner(std::size_t k) const { return corner_[k]; }
  [[nodiscard]] AnchoredPoint center(std::size_t k) const {
    return {{base_x_[k], base_y_[k]}, {rest_x_[k], rest_y_[k]}};
  }

 private:
  using Numbers = std::array<double, room>;
  struct Sites {
    Numbers x, y, weight;
    void set(std::size_t k, const WeightedPoint& site) {
      x[k] = site.x;
      y[k] = site.y;
      weight[k] = site.weight;
    }
    [[nodiscard]] WeightedPoint at(std::size_t k) const { return {{x[k], y[k]}, weight[k]}; }
  };

  std::size_t size_ = 0;
  std::array<std::size_t, room> corner_;
  Sites i_, j_, k_;
  Numbers base_x_, base_y_, rest_x_, rest_y_;
};

}  // namespace vorpipe::core
