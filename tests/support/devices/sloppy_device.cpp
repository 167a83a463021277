#include "support/devices/sloppy_device.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "backend/cpu/cpu.h"
#include "backend/cpu/glsl.h"
#include "backend/view_uniform.h"
#include "layout.glsl"

namespace vorpipe::cpu {

template <>
struct Number<test::Sloppy> : Number<float> {};

}  // namespace vorpipe::cpu

namespace vorpipe::test {

float Sloppiness::off(double right, double units) {
  if (way == Way::none || right == 0 || !std::isfinite(right)) return static_cast<float>(right);
  constexpr int digits = 24;
  const double step = std::ldexp(1.0, std::ilogb(right) + 1 - digits);
  const double sign = way == Way::up ? 1 : way == Way::down ? -1 : random.below(2) == 0 ? 1 : -1;
  const double part = way == Way::random ? std::sqrt(random.uniform()) : 1;
  // Half a step less, for what rounding adds.
  return static_cast<float>(right + sign * part * (units - 0.5) * step);
}

Sloppiness& sloppiness() {
  thread_local Sloppiness mine;
  return mine;
}

namespace {

#include "strip.glsl"

namespace glsl {

using cpu::greaterWhere;
using cpu::lesserWhere;
using cpu::Number;
using std::max;
using std::min;

/// What the shared text is given.
struct Words {
  using real = Sloppy;
  struct vec2 {
    Sloppy x, y;
    vec2() = default;
    vec2(Sloppy first, Sloppy second) : x(first), y(second) {}
    friend vec2 operator-(const vec2& a, const vec2& b) { return {a.x - b.x, a.y - b.y}; }
  };
  struct vec4 {
    Sloppy x, y, z, w;
    vec4() = default;
    vec4(Sloppy first, Sloppy second, Sloppy third, Sloppy fourth)
        : x(first), y(second), z(third), w(fourth) {}
  };
  static constexpr int MAX_EDGES = EDGES_MOST;
  static constexpr int edgeEnd() { return MAX_EDGES; }

  const SiteSet* sites = nullptr;
  const CellBatch<float>* batch = nullptr;
  std::size_t whose = 0;  ///< the site of the cell

  [[nodiscard]] SiteTexel texel(Point p) const { return siteTexel(sites->domain, {0, 0}, p); }
  /// As the shaders take it: the differences of the two floats are exact or rounded, and never fused.
  [[nodiscard]] vec2 offset(const SiteTexel& to) const {
    const SiteTexel here = texel({sites->x[whose], sites->y[whose]});
    return {(to.x_high - here.x_high) + (to.x_low - here.x_low),
            (to.y_high - here.y_high) + (to.y_low - here.y_low)};
  }
  [[nodiscard]] vec2 offsetTo(int index) const {
    const auto i = static_cast<std::size_t>(index);
    return offset(texel({sites->x[i], sites->y[i]}));
  }
  [[nodiscard]] int firstOfBin(int bin) const {
    return static_cast<int>(sites->grid.offsets[static_cast<std::size_t>(bin)]);
  }
  [[nodiscard]] vec4 lineAt(int index) const {
    const auto& line = batch->lines[static_cast<std::size_t>(index)];
    return {line.nx, line.ny, line.h, line.bound};
  }
};

#define DRAWN
struct Even : Words {
#include "cell.glsl"
#include "grid.glsl"
#include "list.glsl"
};
#undef DRAWN

}  // namespace glsl

struct Vertex {
  std::int64_t x, y;  ///< in steps of the device's grid
};

class Device final : public SloppyDevice {
 public:
  explicit Device(const SloppyOptions& options)
      : options_(options), cpu_(makeCpuBackend(BackendOptions{})), info_(cpu_->info()) {
    info_.device.backend = "sloppy";
    info_.subpixel_bits = options.subpixel_bits;
    info_.has_vertices = true;
    constexpr int largest_view = 4096;
    info_.max_view = largest_view;
    info_.most_edges = EDGES_MOST;
    sloppiness() = {options.way, Random(options.seed)};
  }

  const BackendInfo& info() const override { return info_; }
  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override {
    sites_ = &sites;
    palette_index_ = palette_index;
    return cpu_->upload(sites, palette_index);
  }
  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override {
    return cpu_->cells(which, capacity, out);
  }
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override {
    return cpu_->cells(batch, out);
  }
  Result<void> begin(const View& view) override {
    view_ = view;
    const auto pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
    ids_.assign(pixels, no_site);
    rgba_.assign(pixels, 0);
    return {};
  }
  Result<void> draw(std::span<const std::uint32_t> which, Capacity, std::span<CellStatus> status) override {
    for (std::size_t e = 0; e < which.size(); ++e) {
      status[e] = drawSite(which[e]);
    }
    return {};
  }
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity,
                    std::span<CellStatus> status) override {
    const ViewUniform uniform = viewUniform(view_, info_.subpixel_bits, view_.box);
    glsl::Even clip;
    clip.batch = &batch;
    for (std::size_t e = 0; e < status.size(); ++e) {
      const auto& entry = batch.entries[e];
      glsl::Even::Cell cell;
      const int found = clip.clipCell(cell, {entry.west, entry.south, entry.east, entry.north},
                                      {uniform.outset_x, uniform.outset_y}, static_cast<int>(entry.first),
                                      static_cast<int>(entry.count), entry.reach, entry.origin_offset);
      status[e] = finish(clip, cell, found, uniform, [](const auto&) { return false; });
      if (status[e] != CellStatus::certified) continue;
      paint(clip, cell, {marks[e].x, marks[e].y}, uniform, marks[e].id,
            view_.palette[marks[e].palette_index]);
    }
    return {};
  }
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    std::ranges::copy(rgba_, rgba.begin());
    std::ranges::copy(ids_, ids.begin());
    return {};
  }
  Result<void> drawTriangles(std::span<const DrawMark> corners,
                             std::span<const std::uint32_t> corner_of) override {
    for (std::size_t t = 0; t < corner_of.size(); t += 3) {
      std::vector<Vertex> vertices;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& corner = corners[corner_of[t + k]];
        vertices.push_back(snapped({corner.x, corner.y}));
      }
      const auto& mark = corners[corner_of[t]];
      if (!isAroundACenter(vertices)) measure(vertices, mark.id);
      fill(vertices[0], vertices[1], vertices[2], mark.id, view_.palette[mark.palette_index]);
    }
    return {};
  }
  Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) override {
    return cpu_->compute(operands, out);
  }
  [[nodiscard]] double farthestBeyond() const override { return farthest_beyond_; }
  [[nodiscard]] std::uint64_t unsecured() const override { return unsecured_; }

 private:
  using vec2 = glsl::Words::vec2;
  using vec4 = glsl::Words::vec4;

  /// As sites.glsl does it.
  CellStatus drawSite(std::uint32_t site) {
    const SiteSet& s = *sites_;
    glsl::Even clip;
    clip.sites = &s;
    clip.whose = site;
    const Point p{s.x[site], s.y[site]};
    const Point origin{std::clamp(p.x, s.domain.xmin, s.domain.xmax),
                       std::clamp(p.y, s.domain.ymin, s.domain.ymax)};
    const auto seen = [&](double x, double y) { return std::pair{x - origin.x, y - origin.y}; };
    const auto boxSeen = [&](const Box& box) {
      constexpr double far = 1e30;
      const auto [west, south] = seen(box.xmin, box.ymin);
      const auto [east, north] = seen(box.xmax, box.ymax);
      return vec4(std::max(west, -far), std::max(south, -far), std::min(east, far), std::min(north, far));
    };
    const SiteGridUniform grid = siteGridUniform(s);
    glsl::Even::Bins bins;
    bins.columns = grid.columns;
    bins.rows = grid.rows;
    bins.size = grid.size;
    const auto [low_x, low_y] = seen(s.grid.xmin, s.grid.ymin);
    bins.low = {low_x, low_y};
    const double longest =
        std::max({std::abs(low_x), std::abs(low_y), std::abs(low_x + grid.columns * s.grid.size),
                  std::abs(low_y + grid.rows * s.grid.size)});
    bins.slack = static_cast<double>(grid.slack) * longest;
    bins.coverage = boxSeen(s.coverage);
    bins.most = grid.most;
    const ViewUniform uniform = viewUniform(view_, info_.subpixel_bits, s.domain);
    const vec2 outset(uniform.outset_x, uniform.outset_y), origin_offset(p.x - origin.x, p.y - origin.y);
    glsl::Even::Cell cell;
    clip.beginLines(uniform.allowed);
    const int found =
        clip.clipSite(cell, bins, boxSeen(s.domain), outset, static_cast<int>(site), origin_offset);
    const auto status = finish(clip, cell, found, uniform,
                               [&](const auto& drawn) { return clip.losesTooMuch(drawn, origin_offset); });
    if (status == CellStatus::unsecured) ++unsecured_;
    if (status != CellStatus::certified) return status;
    const vec2 to_site = clip.offset(uniform.center);
    const vec2 at((-origin_offset.x - to_site.x) * uniform.scale_x,
                  (-origin_offset.y - to_site.y) * uniform.scale_y);
    paint(clip, cell, at, uniform, s.id[site], view_.palette[palette_index_[site]]);
    return status;
  }

  /// As statusOfShape of pixels.glsl.
  template <class Clip, class TooCoarse>
  static CellStatus finish(Clip& clip, const typename Clip::Cell& cell, int found, const ViewUniform& uniform,
                           const TooCoarse& tooCoarse) {
    auto status = static_cast<CellStatus>(found);
    if (status == CellStatus::open && clip.hasClosedShape(cell)) status = CellStatus::certified;
    const bool shrunk = uniform.outset_x < 0 || uniform.outset_y < 0;
    if (status == CellStatus::empty && shrunk) status = CellStatus::certified;
    const bool coarse = status == CellStatus::certified && !cell.empty && tooCoarse(cell);
    return coarse ? CellStatus::unsecured : status;
  }

  /// Where a vertex is on the device's grid.
  [[nodiscard]] Vertex snapped(vec2 ndc) const {
    const auto along = [&](Sloppy at, int pixels) {
      const Sloppy window = (at + Sloppy(1)) * Sloppy(0.5F * static_cast<float>(pixels));
      return std::llround(std::ldexp(static_cast<double>(window.value()), options_.subpixel_bits));
    };
    return {along(ndc.x, view_.width), along(ndc.y, view_.height)};
  }

  template <class Clip>
  void paint(Clip& clip, const typename Clip::Cell& cell, vec2 origin, const ViewUniform& uniform,
             std::uint32_t id, std::uint32_t color) {
    typename Clip::Order order;
    clip.orderEdges(cell, order);
    std::vector<Vertex> strip;
    for (int index = 0; index < order.count; ++index) {
      const vec2 start = clip.startOfRank(cell, order, rankInStrip(index, order.count));
      strip.push_back(snapped({origin.x + start.x * uniform.scale_x, origin.y + start.y * uniform.scale_y}));
    }
    measure(strip, id);
    for (std::size_t k = 2; k < strip.size(); ++k) fill(strip[k - 2], strip[k - 1], strip[k], id, color);
  }

  /// Whether a triangle stands for a cell on one pixel: its corners are not the cell's.
  [[nodiscard]] bool isAroundACenter(const std::vector<Vertex>& vertices) const {
    const auto half = (std::int64_t{1} << options_.subpixel_bits) / 2;
    const auto isShort = [&](auto along) {
      const auto [low, high] = std::ranges::minmax(vertices, {}, along);
      return along(high) - along(low) <= half + 1;
    };
    return isShort([](const Vertex& v) { return v.x; }) && isShort([](const Vertex& v) { return v.y; });
  }

  /// By brute force, in double, seen from the view's corner.
  void measure(const std::vector<Vertex>& vertices, std::uint32_t id) {
    const SiteSet& s = *sites_;
    const auto own = static_cast<std::size_t>(std::ranges::find(s.id, id) - s.id.begin());
    const double pixel_x = (view_.box.xmax - view_.box.xmin) / view_.width;
    const double pixel_y = (view_.box.ymax - view_.box.ymin) / view_.height;
    for (const Vertex& vertex : vertices) {
      const double x =
          view_.box.xmin + std::ldexp(static_cast<double>(vertex.x), -options_.subpixel_bits) * pixel_x;
      const double y =
          view_.box.ymin + std::ldexp(static_cast<double>(vertex.y), -options_.subpixel_bits) * pixel_y;
      for (std::size_t other = 0; other < s.size(); ++other) {
        if (other == own) continue;
        const auto from = [&](double at, double corner, double site) { return (corner - site) + at; };
        const double dx = s.x[other] - s.x[own], dy = s.y[other] - s.y[own];
        const double twice = (from(x, view_.corner.x, s.x[own]) + from(x, view_.corner.x, s.x[other])) * dx +
                             (from(y, view_.corner.y, s.y[own]) + from(y, view_.corner.y, s.y[other])) * dy +
                             (s.weight.empty() ? 0 : s.weight[other] - s.weight[own]);
        // Most places are on their own side of the bisector, and need no length.
        if (twice <= 0) continue;
        farthest_beyond_ = std::max(farthest_beyond_, 0.5 * twice / std::hypot(dx * pixel_x, dy * pixel_y));
      }
    }
  }

  void fill(Vertex a, Vertex b, Vertex c, std::uint32_t id, std::uint32_t color) {
    const auto cross = [](Vertex from, Vertex to, Vertex p) {
      return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
    };
    const auto area = cross(a, b, c);
    if (area == 0) return;
    if (area < 0) std::swap(b, c);
    const std::int64_t pixel = std::int64_t{1} << options_.subpixel_bits;
    const auto range = [&](std::int64_t low, std::int64_t high, int pixels) {
      const auto bounded = [&](std::int64_t at) { return std::clamp<std::int64_t>(at, 0, pixels); };
      return std::pair{bounded(low / pixel - 1), bounded(high / pixel + 2)};
    };
    const auto [left, right] = range(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), view_.width);
    const auto [bottom, top] = range(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), view_.height);
    for (auto row = bottom; row < top; ++row) {
      for (auto column = left; column < right; ++column) {
        const Vertex center{column * pixel + pixel / 2, row * pixel + pixel / 2};
        if (cross(a, b, center) < 0 || cross(b, c, center) < 0 || cross(c, a, center) < 0) continue;
        const auto at = static_cast<std::size_t>(row * view_.width + column);
        ids_[at] = id;
        rgba_[at] = color;
      }
    }
  }

  SloppyOptions options_;
  std::unique_ptr<Backend> cpu_;
  BackendInfo info_;
  const SiteSet* sites_ = nullptr;
  std::span<const std::uint8_t> palette_index_;
  View view_{};
  std::vector<std::uint32_t> ids_, rgba_;
  double farthest_beyond_ = 0;
  std::uint64_t unsecured_ = 0;
};

}  // namespace

std::unique_ptr<SloppyDevice> makeSloppyDevice(const SloppyOptions& options) {
  return std::make_unique<Device>(options);
}

BisectorLoss lossOfBisectors(const Sites& sites, Sloppiness::Way way, std::uint64_t seed) {
  SiteSet set;
  set.domain = {0, 0, 1, 1};
  set.x = sites.x;
  set.y = sites.y;
  sloppiness() = {way, Random{seed}};
  glsl::Even clip;
  clip.sites = &set;
  clip.beginLines(1.0f);
  glsl::Even::Viewpoint from;
  from.self = 0;
  from.origin_offset = from.outset = {0.0f, 0.0f};
  BisectorLoss loss;
  constexpr double unit = 0x1p-24;
  for (std::size_t other = 1; other < set.x.size(); ++other) {
    const auto b = clip.bisectorWith(from, static_cast<int>(other));
    const double dx = set.x[other] - set.x[0], dy = set.y[other] - set.y[0], distance = std::hypot(dx, dy);
    const double nx = b.n.x.value(), ny = b.n.y.value(), h = b.h.value();
    loss.length = std::max(loss.length, std::abs(std::hypot(nx, ny) - 1) / unit);
    loss.direction = std::max(loss.direction, std::abs(nx * dy - ny * dx) / distance / unit);
    loss.distance = std::max(loss.distance, std::abs(h - distance / 2) / (distance / 2) / unit);
  }
  return loss;
}

}  // namespace vorpipe::test
