#include "picture/pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vorpipe::core {
namespace {

/// `rest` is the value of pixels outside the frame.
void spread(std::vector<std::uint32_t>& pixels, const PictureFrame& frame, int width, int height,
            std::uint32_t rest) {
  const auto at = [&](std::ptrdiff_t index) { return pixels.begin() + index; };
  const auto placeOf = [&](std::ptrdiff_t row) { return (frame.top + row) * width + frame.left; };
  pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  // Goes from the last row to the first: each moves to a higher place, so that none is overwritten before it
  // has moved.
  for (std::ptrdiff_t row = frame.height - 1; row >= 0; --row) {
    const std::ptrdiff_t from = row * frame.width, to = placeOf(row);
    std::copy_backward(at(from), at(from + frame.width), at(to + frame.width));
  }
  std::ptrdiff_t rest_from = 0;
  for (std::ptrdiff_t row = 0; row < frame.height; ++row) {
    std::fill(at(rest_from), at(placeOf(row)), rest);
    rest_from = placeOf(row) + frame.width;
  }
  std::fill(at(rest_from), pixels.end(), rest);
}

}  // namespace

std::uint32_t mixed(std::uint32_t color, double part, std::uint32_t below) {
  constexpr double most = 255;
  const double over = part * (color >> 24) / most;
  const double under = (1 - over) * (below >> 24) / most;
  const double alpha = over + under;
  std::uint32_t result = static_cast<std::uint32_t>(std::lround(most * alpha)) << 24;
  for (int shift = 0; shift < 24; shift += 8) {
    const double channel = over * (color >> shift & 0xFF) + under * (below >> shift & 0xFF);
    if (alpha > 0) result |= static_cast<std::uint32_t>(std::lround(channel / alpha)) << shift;
  }
  return result;
}

void blend(Image& image, int row, int column, std::uint32_t color, double part) {
  if (!(part > 0) || row < 0 || row >= image.height || column < 0 || column >= image.width) return;
  std::uint32_t& pixel = image.rgba[pixelAt(image, row, column)];
  pixel = mixed(color, std::min(part, 1.0), pixel);
}

void blendBox(const Box& box, std::uint32_t color, Image& image) {
  const auto pixel = [](double at) { return static_cast<int>(std::lround(at)); };
  for (int row = pixel(box.ymin); row < pixel(box.ymax); ++row) {
    for (int column = pixel(box.xmin); column < pixel(box.xmax); ++column)
      blend(image, row, column, color, 1);
  }
}

Box boxOfRows(const Box& box, int first, int last, int rows) {
  const auto upper = [&](int row) {
    return row == rows ? box.ymin : box.ymax - (box.ymax - box.ymin) * row / rows;
  };
  return {box.xmin, upper(last), box.xmax, upper(first)};
}

void layOver(std::uint32_t background, Image& image) {
  constexpr std::uint32_t opaque = 0xFF000000u;
  for (std::uint32_t& pixel : image.rgba) {
    if (pixel < opaque) pixel = mixed(pixel, 1, background);
  }
}

void clearColors(Image& image) { std::ranges::fill(image.rgba, 0); }

Image partOf(const Image& image, const PictureFrame& part) {
  Image cut{part.width, part.height, {}, {}};
  for (int row = 0; row < part.height; ++row) {
    const auto from = static_cast<std::ptrdiff_t>(part.top + row) * image.width + part.left;
    const auto append = [&](const std::vector<std::uint32_t>& pixels, std::vector<std::uint32_t>& to) {
      to.insert(to.end(), pixels.begin() + from, pixels.begin() + from + part.width);
    };
    append(image.rgba, cut.rgba);
    append(image.ids, cut.ids);
  }
  return cut;
}

void putPart(const Image& from, const PictureFrame& part, Image& image) {
  for (int row = 0; row < part.height; ++row) {
    const auto first = static_cast<std::ptrdiff_t>(row) * part.width;
    const auto to = static_cast<std::ptrdiff_t>(part.top + row) * image.width + part.left;
    std::copy_n(from.rgba.begin() + first, part.width, image.rgba.begin() + to);
    std::copy_n(from.ids.begin() + first, part.width, image.ids.begin() + to);
  }
}

void putIntoFrame(const PictureFrame& frame, int width, int height, Image& image) {
  if (image.width == width && image.height == height) return;
  spread(image.rgba, frame, width, height, 0);
  spread(image.ids, frame, width, height, no_site);
  image.width = width;
  image.height = height;
}

}  // namespace vorpipe::core
