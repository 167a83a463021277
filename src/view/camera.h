/// What of the plane a window shows.
#pragma once

#include "view/window/event.h"
#include "view/window/presenter.h"
#include "vorpipe/sites.h"

namespace vorpipe::view {

bool isEqual(const Box& a, const Box& b);

/// The view of a window: a box of the plane with the window's aspect, so that nothing is stretched.
class Camera {
 public:
  /// Shows all of a domain.
  Camera(const Box& domain, int width, int height);

  /// Of the window, in pixels. What fitted fits again; else the middle and the scale stay.
  void resize(int width, int height);
  /// How many pixels of the window something covers, from its left and from its right edge. What fitted fits
  /// again, beside that.
  void setCovered(double left, double right);
  /// Shows all of the domain, and a little more: in the middle of the window, or beside what covers it, if
  /// that leaves half of its width.
  void fit();
  /// Of what was opened; shows all of it.
  void setDomain(const Box& domain);
  /// Moves what is shown by pixels, to the right and down.
  void pan(double right, double down);
  /// What is at `fixed` stays there, and all else is so much larger. It ends where neighboring pixels could
  /// not be told apart any more in double, and where the domain is smaller than a pixel.
  void zoom(Place fixed, double factor);

  [[nodiscard]] Box view() const;
  [[nodiscard]] double unitsPerPixel() const { return scale_; }
  [[nodiscard]] Point pointAt(Place place) const;
  [[nodiscard]] Place placeOf(Point point) const;
  /// Where the picture of another view stands in the window; of the view itself, the window.
  [[nodiscard]] Placement placementOf(const Box& pictured) const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  Box domain_;
  int width_, height_;
  double covered_left_ = 0, covered_right_ = 0;
  Point middle_{0, 0};
  double scale_ = 1;  ///< units of the plane to a pixel
  bool fitted_ = true;
};

}  // namespace vorpipe::view
