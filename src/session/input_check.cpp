#include "session/input_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <new>

#include "base/refusal.h"
#include "base/try.h"
#include "cells/flann_search.h"
#include "domain/cell_mass.h"
#include "domain/degrees.h"
#include "domain/rings.h"
#include "globe/direction.h"
#include "sites/images.h"
#include "sites/site_set.h"
#include "sites/weights.h"

namespace vorpipe::core {

namespace {

Result<void> checkSearch(const SearchOptions& search) {
  constexpr auto fewest = FlannSearch::fewest_neighbors, most = FlannSearch::most_neighbors;
  if (search.neighbors >= fewest && search.neighbors <= most) return {};
  return tl::unexpected(refusalOf(
      Subject::search, fmt::format("{} neighbors: must be {} to {}", search.neighbors, fewest, most)));
}

Result<void> checkArea(const Box& domain) {
  // A cell may have 1e-7 of the least area: it still has all digits.
  constexpr double least = 1e-301, most = 1e301;
  // Corners closer than this merge: the cell of a flatter domain has no area.
  constexpr double flattest = 1e-12;
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  const bool is_box = width > 0 && height > 0;
  if (!is_box) return {};
  const double area = width * height;
  if (!(area >= least && area <= most)) {
    return tl::unexpected(refusal(
        Subject::domain,
        fmt::format("the domain is {} wide and {} high: areas need one whose own lies between {:.0e} and "
                    "{:.0e}, such as sides of 1e-150 to 1e150; scale the sites",
                    width, height, least, most)));
  }
  if (std::min(width, height) < flattest * std::max(width, height)) {
    return tl::unexpected(
        refusal(Subject::domain, fmt::format("the domain is {} wide and {} high: one side must be at least "
                                             "{:.0e} of the other",
                                             width, height, flattest)));
  }
  return {};
}

/// Ensures that masses, their sum and their moments are doubles with all digits.
Result<void> checkMass(const Density& density, const Box& domain) {
  // Moments are those of up to 2^60 pixels; a cell may have 1e-7 of the least mass.
  constexpr double least_dense = 1e-280, most_dense = 1e280, least_mass = 1e-301, most_mass = 1e301;
  const double area = (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin);
  const bool is_box = area > 0;
  if (density.values.empty() || !is_box) return {};
  const double largest = *std::ranges::max_element(density.values), mass = largest * area;
  const bool has_digits = largest >= least_dense && mass >= least_mass;
  if (largest == 0 || (has_digits && largest <= most_dense && mass <= most_mass)) return {};
  return tl::unexpected(refusalOf(
      Subject::density, fmt::format("its largest value is {}: masses need {:.0e} to {:.0e}, and {:.0e} to "
                                    "{:.0e} times the domain's area; scale it",
                                    largest, least_dense, most_dense, least_mass, most_mass)));
}

/// Whether sites can have cells on the globe: places, whose weights are those of caps below a quarter turn.
Result<void> checkGlobe(const Sites& sites, const CellsOptions& options) {
  VORPIPE_TRY(checkPlaces(sites));
  const double most = std::pow(quarter_turn * degree * earthRadius(), 2);
  for (std::size_t i = 0; i < sites.weight.size(); ++i) {
    if (std::isfinite(sites.weight[i]) && std::abs(sites.weight[i]) < most) continue;
    return tl::unexpected(refusalOf(
        Subject::weights,
        fmt::format("site {}: weight {}; on the globe it is the square of a radius below a quarter of the "
                    "Earth, {:.0f} km",
                    i, sites.weight[i], std::sqrt(most))));
  }
  if (options.search.method == Search::flann) {
    return tl::unexpected(
        refusalOf(Subject::search, "FLANN finds neighbors in a plane, not on the globe; take the grid"));
  }
  if (!options.density.values.empty()) {
    return tl::unexpected(refusalOf(Subject::density, "is for a plane, not for the globe"));
  }
  return {};
}

}  // namespace

Result<void> checkOptions(const Sites& sites, const CellsOptions& options) {
  VORPIPE_TRY(checkSearch(options.search));
  if (options.globe) return checkGlobe(sites, options);
  if (options.search.method == Search::flann && hasWeights(sites)) {
    return tl::unexpected(refusalOf(Subject::search,
                                    "of sites with weights, those beyond the nearest that FLANN finds may "
                                    "cut a cell as well; take the grid"));
  }
  if (!options.density.values.empty()) {
    VORPIPE_TRY(checkDensity(options.density));
    if (options.density.box && options.periodic != Periodic::none) {
      return tl::unexpected(
          refusalOf(Subject::density,
                    "has a place of its own, and a domain that repeats itself has one in each period"));
    }
  }
  VORPIPE_TRY(checkOutline(options.outline, options.periodic));
  VORPIPE_TRY(checkArea(options.domain));
  return checkMass(options.density, options.domain);
}

}  // namespace vorpipe::core

namespace vorpipe {

Result<void> checkInput(const Sites& sites, const CellsOptions& options, int threads) {
  try {
    VORPIPE_TRY(core::checkOptions(sites, options));
    if (options.globe) return {};
    if (options.periodic == Periodic::none) return core::checkSites(sites, options.domain, threads);
    const auto placed = core::placeSites(sites, options.domain, options.periodic, threads);
    return placed ? Result<void>{} : tl::unexpected(placed.error());
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "there is not enough memory to look at the sites"});
  }
}

}  // namespace vorpipe
