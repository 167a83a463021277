#include "view/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorpipe::view {
namespace {

/// Size of a fitted view relative to the domain, so that the walls are visible.
constexpr double margin = 1.04;

}  // namespace

bool isEqual(const Box& a, const Box& b) {
  return a.xmin == b.xmin && a.ymin == b.ymin && a.xmax == b.xmax && a.ymax == b.ymax;
}

Camera::Camera(const Box& domain, int width, int height)
    : domain_(domain), width_(std::max(width, 1)), height_(std::max(height, 1)) {
  fit();
}

void Camera::resize(int width, int height) {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
  if (fitted_) fit();
}

void Camera::fit() {
  middle_ = {domain_.xmin + (domain_.xmax - domain_.xmin) / 2,
             domain_.ymin + (domain_.ymax - domain_.ymin) / 2};
  const bool beside = width_ - covered_left_ - covered_right_ >= width_ / 2.0;
  const double left = beside ? covered_left_ : 0, right = beside ? covered_right_ : 0;
  const double wide = domain_.xmax - domain_.xmin, high = domain_.ymax - domain_.ymin;
  scale_ = margin * std::max(wide / (width_ - left - right), high / height_);
  fitted_ = true;
  if (left == 0 && right == 0) return;
  // Moves the domain away from the window's middle no farther than necessary.
  const double reach = margin * wide / scale_ / 2, free = width_ / 2.0;
  middle_.x -= scale_ * std::max(0.0, reach - (free - left));
  middle_.x += scale_ * std::max(0.0, reach - (free - right));
}

void Camera::setCovered(double left, double right) {
  if (left == covered_left_ && right == covered_right_) return;
  covered_left_ = left;
  covered_right_ = right;
  if (fitted_) fit();
}

void Camera::setDomain(const Box& domain) {
  domain_ = domain;
  fit();
}

void Camera::pan(double right, double down) {
  middle_.x -= right * scale_;
  middle_.y += down * scale_;
  fitted_ = false;
}

void Camera::zoom(Position fixed, double factor) {
  const double side = std::max(domain_.xmax - domain_.xmin, domain_.ymax - domain_.ymin);
  const double farthest = std::max(
      {std::abs(domain_.xmin), std::abs(domain_.xmax), std::abs(domain_.ymin), std::abs(domain_.ymax), side});
  // Leaves precision for drawing: a pixel is some thousand ulps of the largest coordinate.
  constexpr double steps = 4096;
  const double least = steps * farthest * std::numeric_limits<double>::epsilon();
  const Point kept = pointAt(fixed);
  scale_ = std::clamp(scale_ / factor, least, std::max(side, scale_));
  const Point moved = pointAt(fixed);
  middle_.x += kept.x - moved.x;
  middle_.y += kept.y - moved.y;
  fitted_ = false;
}

Box Camera::view() const {
  const double half_width = scale_ * width_ / 2, half_height = scale_ * height_ / 2;
  return {middle_.x - half_width, middle_.y - half_height, middle_.x + half_width, middle_.y + half_height};
}

Point Camera::pointAt(Position position) const {
  return {middle_.x + (position.x - width_ / 2.0) * scale_,
          middle_.y - (position.y - height_ / 2.0) * scale_};
}

Position Camera::positionOf(Point point) const {
  return {width_ / 2.0 + (point.x - middle_.x) / scale_, height_ / 2.0 - (point.y - middle_.y) / scale_};
}

Placement Camera::placementOf(const Box& pictured) const {
  if (isEqual(pictured, view())) return {0, 0, static_cast<double>(width_), static_cast<double>(height_)};
  const Position corner = positionOf({pictured.xmin, pictured.ymax});
  return {corner.x, corner.y, (pictured.xmax - pictured.xmin) / scale_,
          (pictured.ymax - pictured.ymin) / scale_};
}

}  // namespace vorpipe::view
