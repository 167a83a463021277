#include "io/sites/density_place.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"

namespace vorpipe {
namespace {

double areaOf(const Box& box) {
  return std::max(0.0, box.xmax - box.xmin) * std::max(0.0, box.ymax - box.ymin);
}

/// Notes pixels that are not square by more than rounding to whole pixels may cause.
void noteStretched(const Density& density, const std::string& about, bool is_file, PlacedSites& placed,
                   const DomainWords& words) {
  constexpr double slight = 0.02;
  const std::string_view file = is_file ? ", or a world file beside it," : "";
  const auto [xmin, ymin, xmax, ymax] = placed.domain;
  const double ratio = (xmax - xmin) / density.width / ((ymax - ymin) / density.height);
  if (std::abs(ratio - 1) <= slight || !std::isfinite(ratio)) return;
  placed.notes.push_back(fmt::format(
      "{}its {} x {} pixels are stretched over the domain, and come out {:.3g} times as {}; {}{} says where "
      "they lie",
      about, density.width, density.height, std::max(ratio, 1 / ratio),
      ratio > 1 ? "wide as high" : "high as wide", words.density_box, file));
}

/// Returns the fraction of a box that another covers; NaN if the box has no area.
double coveredPart(const Box& box, const Box& by) {
  const Box common{std::max(box.xmin, by.xmin), std::max(box.ymin, by.ymin), std::min(box.xmax, by.xmax),
                   std::min(box.ymax, by.ymax)};
  return areaOf(common) / areaOf(box);
}

/// Notes the part of the domain that the pixels leave empty; refuses pixels that lie elsewhere.
Result<void> checkCovered(const Density& density, const std::string& about, PlacedSites& placed,
                          const DomainWords& words) {
  constexpr double percent = 100, rounding = 1e-9;
  const Box& box = *density.box;
  constexpr double turn = 360;
  // On the globe longitudes are of any turn; a box that is not on it is refused later.
  const Box domain =
      placed.globe ? Box{box.xmin, placed.domain.ymin, box.xmin + turn, placed.domain.ymax} : placed.domain;
  if (placed.globe && (box.xmax > domain.xmax || box.ymin < domain.ymin || box.ymax > domain.ymax)) return {};
  const double covered = coveredPart(domain, box);
  if (!(covered < 1 - rounding)) return {};
  if (covered == 0) {
    return inputError(fmt::format("{}its pixels lie in {}, and nothing of the domain {} does", about,
                                  boxText(box), boxText(domain)));
  }
  placed.notes.push_back(fmt::format("{}its pixels lie in {} and cover {:.3g} % of the domain {}; {}", about,
                                     boxText(box), covered * percent, boxText(domain), words.beyond));
  return {};
}

/// Whether a box of unknown system may be in degrees and not in the plane that its sites were projected to.
bool mayBeDegrees(const Box& box, const PlacedSites& placed) {
  constexpr double least = 0.01;
  const Box around = boxOf(placed.longitudes, placed.latitudes);
  return coveredPart(placed.domain, box) < least && coveredPart(around, box) > least;
}

/// Refuses a place in another system than that of the sites.
Result<void> checkSystem(const DensityFile& given, const std::string& about, PlacedSites& placed,
                         const DomainWords& words) {
  if (placed.projection) {
    const bool unknown = given.system.kind == CoordinateKind::unknown;
    const bool degrees =
        unknown ? mayBeDegrees(*given.density.box, placed) : given.system.kind == CoordinateKind::degrees;
    if (!degrees) return {};
    const auto [longitude, latitude] = placed.projection->center();
    return inputError(fmt::format(
        "{}its place {} is in degrees, and {} makes a plane: take it there, as gdalwarp "
        "-t_srs '+proj=laea +lon_0={} +lat_0={} +units=km' does, or name its box in "
        "kilometers by {}",
        about, boxText(*given.density.box), words.project, longitude, latitude, words.density_box));
  }
  const std::string both = fmt::format("{}its place is in {}, {} in {}", about, nameOf(given.system),
                                       words.sites, nameOf(placed.system));
  switch (compared(given.system, placed.system)) {
    case SystemsAre::one:
    case SystemsAre::near:
      return {};
    case SystemsAre::unclear:
      placed.notes.push_back(both + "; nothing here says whether that is the same, and it is taken so");
      return {};
    case SystemsAre::different:
      break;
  }
  return inputError(both + "; take one to the system of the other");
}

}  // namespace

Result<void> placeDensity(const DensityFile& given, const std::string& name, PlacedSites& placed,
                          const DomainWords& words) {
  const Density& density = given.density;
  if (density.width == 0) return {};
  const std::string about =
      name.empty() ? fmt::format("{}: ", words.density) : fmt::format("{}: {}: ", words.density, name);
  if (!density.box) {
    noteStretched(density, about, !name.empty(), placed, words);
    return {};
  }
  VORPIPE_TRY(checkSystem(given, about, placed, words));
  return checkCovered(density, about, placed, words);
}

}  // namespace vorpipe
