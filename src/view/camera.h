/// The part of the plane that a window shows.
#pragma once

#include "view/window/event.h"
#include "view/window/presenter.h"
#include "vorpipe/sites.h"

namespace vorpipe::view {

bool isEqual(const Box& a, const Box& b);

/// The view of a window: a box of the plane with the window's aspect ratio, so that nothing is stretched.
class Camera {
 public:
  /// Shows all of a domain.
  Camera(const Box& domain, int width, int height);

  /// Sets the size of the window, in pixels. A fitted view is fitted again; otherwise the center and the
  /// scale stay.
  void resize(int width, int height);
  /// Sets how many pixels at the window's left and right edges are covered. A fitted view is fitted again,
  /// beside them.
  void setCovered(double left, double right);
  /// Shows all of the domain with a small margin: beside what covers the window if that leaves half of its
  /// width, else in its middle.
  void fit();
  /// Sets the domain of what was opened, and shows all of it.
  void setDomain(const Box& domain);
  /// Moves the shown contents by pixels, to the right and down.
  void pan(double right, double down);
  /// Magnifies the view by `factor` and keeps the point at `fixed` in place. Limits: neighboring pixels stay
  /// distinguishable in double, and the domain does not get smaller than a pixel.
  void zoom(Position fixed, double factor);

  [[nodiscard]] Box view() const;
  [[nodiscard]] double unitsPerPixel() const { return scale_; }
  [[nodiscard]] Point pointAt(Position position) const;
  [[nodiscard]] Position positionOf(Point point) const;
  /// Returns where a picture of the box `pictured` lies in the window; for the view itself, the whole window.
  [[nodiscard]] Placement placementOf(const Box& pictured) const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  Box domain_;
  int width_, height_;
  double covered_left_ = 0, covered_right_ = 0;
  Point middle_{0, 0};
  double scale_ = 1;  ///< units of the plane per pixel
  bool fitted_ = true;
};

}  // namespace vorpipe::view
