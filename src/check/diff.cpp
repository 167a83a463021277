#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/refusal.h"
#include "base/try.h"
#include "check/globe_sites.h"
#include "check/run.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr std::size_t sites_kept = 10;

/// Compares cells of two diagrams; reuses buffers for lists that must be sorted.
class CellComparison {
 public:
  CellComparison(const Diagram& a, const Diagram& b) : a_(a), b_(b) {
    const auto cells = static_cast<double>(std::ranges::count(a.status, Status::ok));
    slack_ = cells > 0 ? area_slack_of_mean * areaSum(a) / cells : 0;
  }

  CellDifference at(std::size_t i) {
    const double area_a = a_.area[i], area_b = b_.area[i];
    return {static_cast<std::uint32_t>(i), a_.status[i] != b_.status[i] || a_.owner[i] != b_.owner[i],
            !sameNeighbors(i),
            // NaN differs from everything.
            !(partOfAllowed(area_a, area_b) <= 1), area_a, area_b};
  }

  [[nodiscard]] double partOfAllowed(double a, double b) const {
    const double difference = std::abs(a - b);
    return difference == 0 ? 0 : difference / (area_slack_of_cell * std::max(a, b) + slack_);
  }

 private:
  using List = std::span<const std::int64_t>;

  static List neighborsOf(const Diagram& diagram, std::size_t i) {
    const std::uint64_t begin = diagram.cell_offsets[i];
    return List(diagram.neighbors).subspan(begin, diagram.cell_offsets[i + 1] - begin);
  }

  bool sameNeighbors(std::size_t i) {
    const List a = neighborsOf(a_, i), b = neighborsOf(b_, i);
    if (a.size() != b.size()) return false;
    const bool periodic = !a_.neighbor_shifts.empty() || !b_.neighbor_shifts.empty();
    if (!periodic && std::ranges::equal(a, b)) return true;
    sort(a_, i, sorted_a_);
    sort(b_, i, sorted_b_);
    return sorted_a_ == sorted_b_;
  }

  /// A neighbor and the shift of its image.
  using Image = std::pair<std::int64_t, std::array<std::int32_t, 2>>;

  static void sort(const Diagram& diagram, std::size_t i, std::vector<Image>& sorted) {
    sorted.clear();
    for (auto e = diagram.cell_offsets[i]; e < diagram.cell_offsets[i + 1]; ++e) {
      const auto& shifts = diagram.neighbor_shifts;
      sorted.emplace_back(diagram.neighbors[e], shifts.empty() ? std::array<std::int32_t, 2>{} : shifts[e]);
    }
    std::ranges::sort(sorted);
  }

  const Diagram& a_;
  const Diagram& b_;
  double slack_ = 0;  ///< of an area, independent of the cell's own
  std::vector<Image> sorted_a_, sorted_b_;
};

constexpr std::size_t places_kept = 10;

using Ids = std::span<const std::uint32_t>;

/// The pixels of a frame in pictures that are `columns` pixels wide.
struct PixelGrid {
  int width, height;
  int columns = width;
  int top = 0, left = 0;
  [[nodiscard]] std::size_t at(int row, int column) const {
    return static_cast<std::size_t>(top + row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(left + column);
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] bool holds(int row, int column) const {
    return row >= 0 && row < height && column >= 0 && column < width;
  }
};

/// Some images of a site.
struct Images {
  std::array<Point, 4> place;
  std::size_t count = 0;
  [[nodiscard]] auto all() const { return std::span(place).first(count); }
};

/// Distance in pixels from the center of a pixel to the bisector of two sites, with weights; infinite if
/// there is no bisector. It uses only differences of coordinates, so it holds far from the origin. In a
/// periodic domain, which contains its sites, the nearest images count; they are as exact as its periods.
class BisectorDistance {
 public:
  BisectorDistance(const Sites& sites, const Box& domain, PixelGrid grid,
                   std::array<double, 2> periods = {0, 0})
      : sites_(&sites),
        domain_(domain),
        periods_(periods),
        pixel_x_((domain.xmax - domain.xmin) / grid.width),
        pixel_y_((domain.ymax - domain.ymin) / grid.height),
        longer_(std::max(pixel_x_, pixel_y_)) {
    metric_x_ = pixel_x_ / longer_ * (pixel_x_ / longer_);
    metric_y_ = pixel_y_ / longer_ * (pixel_y_ / longer_);
  }

  double operator()(int row, int column, std::uint32_t a, std::uint32_t b) const {
    if (a >= sites_->size() || b >= sites_->size()) return none;
    const double weight_difference = sites_->weight.empty() ? 0 : sites_->weight[a] - sites_->weight[b];
    const Images of_a = imagesNear(row, column, a), of_b = imagesNear(row, column, b);
    double least = none;
    for (const Point at_a : of_a.all()) {
      for (const Point at_b : of_b.all())
        least = std::min(least, between(row, column, at_a, at_b, weight_difference));
    }
    return least;
  }

 private:
  static constexpr double none = std::numeric_limits<double>::infinity();

  /// The nearest image of a site, and images farther by less than a pixel.
  [[nodiscard]] Images imagesNear(int row, int column, std::uint32_t i) const {
    const Point site{sites_->x[i], sites_->y[i]};
    if (periods_[0] == 0 && periods_[1] == 0) return {{site}, 1};
    const Point center{domain_.xmin + (column + 0.5) * pixel_x_, domain_.ymax - (row + 0.5) * pixel_y_};
    const auto along = [](double from, double to, double period) {
      if (period == 0) return std::array{from, none};
      const double first = from + std::floor((to - from) / period) * period;
      return std::array{first, first + period};
    };
    const auto xs = along(site.x, center.x, periods_[0]);
    const auto ys = along(site.y, center.y, periods_[1]);
    const auto distance = [&](double x, double y) { return std::hypot(x - center.x, y - center.y); };
    double nearest = none;
    for (const double x : xs) {
      for (const double y : ys) nearest = std::min(nearest, distance(x, y));
    }
    Images images;
    for (const double x : xs) {
      for (const double y : ys) {
        if (distance(x, y) <= nearest + std::max(pixel_x_, pixel_y_)) images.place[images.count++] = {x, y};
      }
    }
    return images;
  }

  [[nodiscard]] double between(int row, int column, Point at_a, Point at_b, double weight_difference) const {
    const double ax = at_a.x, ay = at_a.y, bx = at_b.x, by = at_b.y;
    // The bisector's normal: in the picture it is not along b - a if pixels are not square.
    const double nx = (bx - ax) / pixel_x_ * metric_x_;
    const double ny = (by - ay) / pixel_y_ * metric_y_;
    const double length = std::hypot(nx, ny);
    // Twice the vector from the midpoint of the sites to the center, y upward.
    const double x = 2 * (column + 0.5) - (ax - domain_.xmin) / pixel_x_ - (bx - domain_.xmin) / pixel_x_;
    const double y = (domain_.ymax - ay) / pixel_y_ + (domain_.ymax - by) / pixel_y_ - 2 * (row + 0.5);
    const double moved = weight_difference / longer_ / longer_ / length;
    const double distance = std::abs(x * (nx / length) + y * (ny / length) - moved) / 2;
    return std::isfinite(distance) ? distance : none;
  }

  const Sites* sites_;
  Box domain_;
  std::array<double, 2> periods_;  ///< along x and y; 0 if the domain does not repeat
  double pixel_x_, pixel_y_, longer_;
  double metric_x_ = 1, metric_y_ = 1;
};

/// Whether a cell ends at one of the pixel's four sides; the picture's frame ends every cell.
bool besideBoundary(Ids ids, PixelGrid grid, int row, int column) {
  if (row == 0 || column == 0 || row == grid.height - 1 || column == grid.width - 1) return true;
  const std::uint32_t id = ids[grid.at(row, column)];
  return ids[grid.at(row - 1, column)] != id || ids[grid.at(row + 1, column)] != id ||
         ids[grid.at(row, column - 1)] != id || ids[grid.at(row, column + 1)] != id;
}

/// Number of pixel sides at which a cell ends.
std::uint64_t boundaryLength(Ids ids, PixelGrid grid) {
  std::uint64_t length =
      2 * (static_cast<std::uint64_t>(grid.width) + static_cast<std::uint64_t>(grid.height));
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const std::uint32_t id = ids[grid.at(row, column)];
      if (column + 1 < grid.width && ids[grid.at(row, column + 1)] != id) ++length;
      if (row + 1 < grid.height && ids[grid.at(row + 1, column)] != id) ++length;
    }
  }
  return length;
}

void addWrong(IdDiff& diff, const IdDifference& place) {
  if (diff.first.size() < places_kept) diff.first.push_back(place);
  if (diff.wrong == 0 || place.distance > diff.worst.distance) diff.worst = place;
  ++diff.wrong;
}

/// `pictures` is the grid of all pixels, `frame` that of those that show the domain. `distance` returns the
/// distance for a differing pixel of the frame, as BisectorDistance does.
template <class Distance>
IdDiff compare(Ids a, Ids b, PixelGrid pictures, PixelGrid frame, const Distance& distance) {
  assert(a.size() == pictures.size() && b.size() == pictures.size());
  IdDiff diff;
  diff.pixels.assign(pictures.size(), PixelMatch::equal);
  for (int row = 0; row < pictures.height; ++row) {
    for (int column = 0; column < pictures.width; ++column) {
      const std::size_t pixel = pictures.at(row, column);
      if (a[pixel] == b[pixel]) continue;
      IdDifference place{row, column, a[pixel], b[pixel], std::numeric_limits<double>::infinity()};
      const int down = row - frame.top, right = column - frame.left;
      const bool inside = frame.holds(down, right);
      if (inside) place.distance = distance(down, right, place.a, place.b);
      const bool tie = inside && place.distance <= tie_distance &&
                       (besideBoundary(a, frame, down, right) || besideBoundary(b, frame, down, right));
      diff.pixels[pixel] = tie ? PixelMatch::tie : PixelMatch::wrong;
      if (tie) {
        ++diff.ties;
        diff.widest_tie = std::max(diff.widest_tie, place.distance);
      } else {
        addWrong(diff, place);
      }
    }
  }
  diff.equal = pictures.size() - diff.ties - diff.wrong;
  diff.ties_allowed = std::min(boundaryLength(a, frame), boundaryLength(b, frame));
  return diff;
}

int channelDifference(std::uint32_t a, std::uint32_t b) {
  int largest = 0;
  for (int shift = 0; shift < 32; shift += 8) {
    const int difference = static_cast<int>(a >> shift & 0xFF) - static_cast<int>(b >> shift & 0xFF);
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

}  // namespace

Result<CellsDiff> diffCells(const Diagram& a, const Diagram& b) {
  if (a.status.size() != b.status.size()) {
    return tl::unexpected(Error{
        ErrorCode::input,
        fmt::format("cells of {} and of {} sites cannot be compared", a.status.size(), b.status.size())});
  }
  CellsDiff diff;
  CellComparison comparison(a, b);
  for (std::size_t i = 0; i < a.status.size(); ++i) {
    const CellDifference site = comparison.at(i);
    const double part = comparison.partOfAllowed(site.area_a, site.area_b);
    if (!(part <= diff.worst_area)) {
      diff.worst_area = part;
      diff.worst_site = site.site;
    }
    diff.statuses += site.status ? 1 : 0;
    diff.neighbors += site.neighbors ? 1 : 0;
    diff.areas += site.area ? 1 : 0;
    if (!site.status && !site.neighbors && !site.area) {
      ++diff.equal;
    } else if (diff.first.size() < sites_kept) {
      diff.first.push_back(site);
    }
  }
  return diff;
}

IdDiff diffIds(Ids a, Ids b, int width, int height) {
  const PixelGrid grid{width, height};
  return compare(a, b, grid, grid, [](auto...) { return std::numeric_limits<double>::infinity(); });
}

Result<IdDiff> diffIds(Ids a, Ids b, int width, int height, const Sites& sites, const Box& domain,
                       Periodic periodic, Fit fit) {
  RenderOptions options{};
  options.domain = domain;
  options.periodic = periodic;
  options.width = width;
  options.height = height;
  options.fit = fit;
  return diffIds(a, b, sites, options);
}

namespace {

/// The same for pixels of the globe.
IdDiff diffOnGlobe(Ids a, Ids b, const Sites& sites, const RenderOptions& options) {
  const core::checks::GlobeSites placed(sites);
  const core::checks::GlobePixels places(options);
  const PictureFrame& frame = places.frame();
  const PixelGrid pictures{options.width, options.height},
      grid{frame.width, frame.height, options.width, frame.top, frame.left};
  return compare(a, b, pictures, grid, [&](int row, int column, std::uint32_t of_a, std::uint32_t of_b) {
    const auto place = places.at(row, column);
    if (!place || of_a >= placed.size() || of_b >= placed.size()) {
      return std::numeric_limits<double>::infinity();
    }
    return places.pixelsOfRadian() * std::abs(placed.beyond(of_a, of_b, *place));
  });
}

}  // namespace

Result<IdDiff> diffIds(Ids a, Ids b, const Sites& sites, const RenderOptions& options) {
  if (options.globe) {
    VORPIPE_TRY(checkView(options));
    return diffOnGlobe(a, b, sites, options);
  }
  const Box& domain = options.domain;
  const bool valid = std::isfinite(domain.xmax - domain.xmin) && domain.xmin < domain.xmax &&
                     std::isfinite(domain.ymax - domain.ymin) && domain.ymin < domain.ymax;
  if (!valid) {
    return tl::unexpected(refusalOf(Subject::domain, "needs finite xmin < xmax and ymin < ymax"));
  }
  VORPIPE_TRY(checkView(options));
  const PixelGrid pictures{options.width, options.height};
  const PictureFrame frame = shownFrame(options), shown = domainFrame(options);
  const PixelGrid grid{shown.width, shown.height, options.width, shown.top, shown.left};
  const PixelGrid of_view{frame.width, frame.height};
  // Pixels of the domain, numbered from the beginning of the view.
  const auto compareBy = [&](const BisectorDistance& distance) {
    const int down = shown.top - frame.top, right = shown.left - frame.left;
    return compare(a, b, pictures, grid, [&](int row, int column, std::uint32_t of_a, std::uint32_t of_b) {
      return distance(row + down, column + right, of_a, of_b);
    });
  };
  const Box& box = shownBox(options);
  if (options.periodic == Periodic::none) return compareBy(BisectorDistance(sites, box, of_view));
  VORPIPE_LET(inside, wrapped(sites, domain, options.periodic));
  // Corners are rounded as sides of the domain are: this makes images of twins twins.
  VORPIPE_LET(corners, core::checks::placedCorners(domain, options.periodic));
  const auto& [low, high] = corners;
  return compareBy(BisectorDistance(inside, box, of_view,
                                    {options.periodic == Periodic::y ? 0 : high.x - low.x,
                                     options.periodic == Periodic::x ? 0 : high.y - low.y}));
}

ImageDiff diffImages(Ids a, Ids b, int width, int height, int tolerated) {
  const PixelGrid grid{width, height};
  assert(a.size() == grid.size() && b.size() == grid.size());
  ImageDiff diff;
  diff.pixels.assign(grid.size(), PixelMatch::equal);
  diff.left = width;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const std::size_t pixel = grid.at(row, column);
      if (a[pixel] == b[pixel]) continue;
      const int difference = channelDifference(a[pixel], b[pixel]);
      diff.largest = std::max(diff.largest, difference);
      if (difference <= tolerated) {
        diff.pixels[pixel] = PixelMatch::tie;
        ++diff.close;
        continue;
      }
      diff.pixels[pixel] = PixelMatch::wrong;
      if (diff.first.size() < places_kept) diff.first.push_back({row, column, a[pixel], b[pixel]});
      if (diff.different++ == 0) {
        diff.first_row = diff.top = row;
        diff.first_column = column;
      }
      diff.bottom = row;
      diff.left = std::min(diff.left, column);
      diff.right = std::max(diff.right, column);
    }
  }
  return diff;
}

}  // namespace vorpipe
