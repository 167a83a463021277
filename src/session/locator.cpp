#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "backend/registry/registry.h"
#include "base/inside.h"
#include "base/parallel.h"
#include "base/try.h"
#include "domain/degrees.h"
#include "domain/edge_tree.h"
#include "globe/globe_places.h"
#include "sites/bin_sort.h"
#include "sites/images.h"
#include "sites/site_set.h"
#include "vorpipe.h"

namespace vorpipe {

using namespace core;

namespace {

constexpr std::size_t locator_grain = 1 << 12;
/// Number of places that are sorted at a time.
constexpr std::size_t most_at_once = std::size_t{1} << 20;

/// Returns the number of blocks along one side of the grid, for a few places per block.
std::uint32_t sideFor(std::size_t places) {
  constexpr double places_per_block = 4, most = 512;
  return static_cast<std::uint32_t>(
      std::clamp(std::sqrt(static_cast<double>(places) / places_per_block), 1.0, most));
}

/// Also accepts NaN.
std::uint32_t blockAlong(double place, double low, double high, std::uint32_t side) {
  const double along = (place - low) / (high - low) * side;
  if (!(along > 0)) return 0;
  return along < side ? static_cast<std::uint32_t>(along) : side - 1;
}

/// Returns the indices of places, grouped by the blocks of a grid over a box. A place beyond the box belongs
/// to the nearest block at the border.
std::vector<std::uint32_t> orderByBlocks(std::span<const Point> places, const Box& box) {
  const std::uint32_t side = sideFor(places.size());
  std::vector<std::uint32_t> block(places.size());
  std::vector<std::uint32_t> next(std::size_t{side} * side + 1);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Point p = places[k];
    block[k] = blockAlong(p.y, box.ymin, box.ymax, side) * side + blockAlong(p.x, box.xmin, box.xmax, side);
    ++next[block[k] + std::size_t{1}];
  }
  for (std::size_t b = 1; b < next.size(); ++b) next[b] += next[b - 1];
  std::vector<std::uint32_t> order(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) order[next[block[k]]++] = static_cast<std::uint32_t>(k);
  return order;
}

/// A valid outline with an index for point queries.
struct OutlineSearch {
  explicit OutlineSearch(Rings from) : rings(std::move(from)), index(rings) {}

  Rings rings;
  OutlineIndex index;
};

/// The periodic domain, and its images of sites.
struct Repeated {
  std::array<PeriodicAxis, 2> axis;
  SiteImages images;
};

/// Moves a scaled coordinate into the domain; returns whether it has a place there.
bool putInside(const PeriodicAxis& axis, double& coordinate) {
  constexpr double most_periods = 0x1p50;
  if (!axis.periodic) return axis.contains(coordinate);
  const auto placed = axis.put(coordinate);
  coordinate = placed.place;
  return std::abs(placed.periods) <= most_periods;
}

}  // namespace

struct Locator::State {
  Box domain{};
  int threads = 0;
  PowerOfTwo scale{0};  ///< from the caller's units
  SiteSet sites;
  PowerOfTwo set_scale{0};  ///< from the units of `repeated`, or from the caller's
  std::optional<Repeated> repeated;
  std::unique_ptr<OutlineSearch> outline;
  std::unique_ptr<PlaceSearch> search;
  std::unique_ptr<GlobePlaces> globe;  ///< set on the globe, instead of all else

  Result<void> takeSites(const Sites& callers, const CellsOptions& options);
  Result<void> prepareSet(const Sites& from, const Box& box, const CallersSites* callers);
  [[nodiscard]] std::uint32_t at(Point place) const;
};

Result<void> Locator::State::prepareSet(const Sites& from, const Box& box, const CallersSites* callers) {
  VORPIPE_VAR(prepared, prepare(from, box, threads, callers));
  sites = std::move(prepared.set);
  set_scale = PowerOfTwo(prepared.exponent);
  return {};
}

Result<void> Locator::State::takeSites(const Sites& callers, const CellsOptions& options) {
  if (options.periodic == Periodic::none) return prepareSet(callers, options.domain, nullptr);
  VORPIPE_VAR(placed, placeSites(callers, options.domain, options.periodic, threads));
  // The images that a picture of the domain needs suffice for places in it.
  ImagedSites imaged = withImages(placed, bandForPlaces(placed, threads));
  const CallersSites named{callers, [&](std::uint32_t i) { return imaged.siteOf(i); }, placed.domain()};
  VORPIPE_TRY(prepareSet(imaged.sites, imaged.box, &named));
  repeated = Repeated{placed.axis, std::move(static_cast<SiteImages&>(imaged))};
  return {};
}

std::uint32_t Locator::State::at(Point place) const {
  if (globe) return globe->at(place);
  Point p = place;
  if (repeated) {
    p = {scale(p.x), scale(p.y)};
    if (!putInside(repeated->axis[0], p.x) || !putInside(repeated->axis[1], p.y)) return no_site;
  } else if (!isInside(domain, p.x, p.y)) {
    return no_site;
  }
  p = {set_scale(p.x), set_scale(p.y)};
  if (outline && !outline->index.contains(p) && !outline->index.isOnEdge(p)) return no_site;
  const std::uint32_t nearest = search->nearest(p);
  if (nearest == no_site) return no_site;
  const std::uint32_t id = sites.id[nearest];
  return repeated ? repeated->images.siteOf(id) : id;
}

Locator::Locator() = default;
Locator::Locator(Locator&&) noexcept = default;
Locator& Locator::operator=(Locator&&) noexcept = default;
Locator::~Locator() = default;

Result<Locator> Locator::make(const Sites& sites, const CellsOptions& options, int threads) {
  try {
    if (!options.globe) {
      VORPIPE_TRY(checkOutline(options.outline, options.periodic));
    }
    Locator locator;
    locator.state_ = std::make_unique<State>();
    State& state = *locator.state_;
    state.domain = options.domain;
    state.threads = threads;
    if (options.globe) {
      VORPIPE_TRY(checkPlaces(sites));
      state.domain = {-whole_turn / 2, -quarter_turn, whole_turn / 2, quarter_turn};
      VORPIPE_VAR(places, GlobePlaces::make(sites, options.outline));
      state.globe = std::make_unique<GlobePlaces>(std::move(places));
      return locator;
    }
    VORPIPE_TRY(state.takeSites(sites, options));
    const int exponent = scaleExponent(options.domain);
    state.scale = PowerOfTwo(exponent);
    if (!options.outline.empty()) {
      VORPIPE_VAR(rings, ringsOf(options.outline, exponent));
      state.outline = std::make_unique<OutlineSearch>(std::move(rings));
    }
    state.search = openPlaceSearch(state.sites, threads);
    return locator;
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "out of memory; fewer sites would fit"});
  }
}

std::uint32_t Locator::at(Point place) const { return state_->at(place); }

void Locator::at(std::span<const Point> places, std::span<std::uint32_t> sites) const {
  assert(places.size() == sites.size());
  // In arbitrary order each search would miss the cache, which takes ten times as long.
  for (std::size_t first = 0; first < places.size(); first += most_at_once) {
    const auto some = places.subspan(first, std::min(most_at_once, places.size() - first));
    const auto order = orderByBlocks(some, state_->domain);
    parallelEach(some.size(), locator_grain, state_->threads,
                 [&](std::size_t k) { sites[first + order[k]] = state_->at(some[order[k]]); });
  }
}

}  // namespace vorpipe
