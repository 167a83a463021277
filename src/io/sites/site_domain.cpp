#include "io/sites/site_domain.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/sites/site_systems.h"

namespace vorpipe {
namespace {

/// The settings, the sites, and the caller's words.
struct Request {
  const DomainSettings& settings;
  PlacedSites& placed;
  const DomainWords& words;

  void note(std::string text) const { placed.notes.push_back(std::move(text)); }
};

/// Checks the margin, whatever the sites are.
Result<void> checkMargin(const Request& request) {
  const auto& [settings, placed, words] = request;
  if (!settings.margin) return {};
  if (!(settings.margin->value >= 0) || !std::isfinite(settings.margin->value)) {
    return inputError(
        fmt::format("{}: {} is not a number of 0 or more", words.margin, settings.margin->value));
  }
  if (settings.box || !settings.outline.empty()) {
    return inputError(
        fmt::format("{}: {} names the domain, which has none; give one of them", words.margin, words.domain));
  }
  if (placed.from == SitesFrom::generator && !settings.hull) {
    return inputError(fmt::format("{}: generators fill the domain 0,0,1,1; name another by {}", words.margin,
                                  words.domain));
  }
  return {};
}

/// Refuses settings that a periodic domain cannot have.
Result<void> checkPeriod(const Request& request) {
  const auto& [settings, placed, words] = request;
  if (placed.periodic == Periodic::none) return {};
  if (settings.project) {
    return inputError(
        fmt::format("{}: the Earth does not repeat itself; leave {} out", words.periodic, words.project));
  }
  if (settings.hull || !settings.outline.empty()) {
    return inputError(fmt::format("{}: a domain with an outline does not repeat itself", words.periodic));
  }
  if (placed.from != SitesFrom::generator && !settings.box) {
    return inputError(
        fmt::format("{}: name the period by {}; a file of sites does not say it", words.periodic, words.box));
  }
  return {};
}

/// Refuses settings that contradict each other, whatever the sites are.
Result<void> checkSettings(const Request& request) {
  const auto& [settings, placed, words] = request;
  VORPIPE_TRY(settleSystems(settings, placed, words));
  VORPIPE_TRY(checkMargin(request));
  if (settings.repair && settings.outline.empty()) {
    return inputError(fmt::format("{}: is for the polygons of {}", words.repair, words.domain));
  }
  VORPIPE_TRY(checkPeriod(request));
  if (settings.project && placed.from == SitesFrom::generator) {
    return inputError(fmt::format("{}: is for files in degrees, not for {}", words.project, words.sites));
  }
  const bool plane_sites = placed.system.kind == CoordinateKind::plane;
  if (settings.project && (plane_sites || settings.outline_system.kind == CoordinateKind::plane)) {
    return inputError(fmt::format("{}: {} says that its coordinates are those of a plane, not degrees",
                                  words.project, plane_sites ? words.sites : nameOfOutline(settings)));
  }
  return {};
}

/// Returns the error with the caller's word in place of the subject's name.
tl::unexpected<Error> renamed(std::string_view word, Error error) {
  const std::string name = fmt::format("{}: ", nameOf(error.subject));
  if (error.subject != Subject::none && error.message.starts_with(name)) error.message.erase(0, name.size());
  if (error.code == ErrorCode::input) error.message.insert(0, fmt::format("{}: ", word));
  return tl::unexpected(std::move(error));
}

/// Returns the outline or a part of it as `mend(outline, repair)` dissolves and repairs it; notes what
/// changed. `name` is that of its file or its part, for messages.
template <class Mend>
Result<Outline> mendedBy(const Mend& mend, const Request& request, const Outline& given,
                         const std::string& name) {
  const auto& [settings, placed, words] = request;
  const std::string before = name.empty() ? words.domain : fmt::format("{}: {}", words.domain, name);
  auto result = mend(given, settings.repair);
  if (!result) {
    // A ring of a thousand points may have a million self-crossings, and nobody requested the attempt.
    constexpr std::size_t few_points = 200;
    const std::size_t points = settings.repair || settings.outline.empty() ? 0 : given.points.size();
    if (points > few_points || (points > 0 && mend(given, true))) {
      result.error().message +=
          fmt::format("; {} {} it", words.repair, points > few_points ? "may mend" : "mends");
    }
    return renamed(before, std::move(result.error()));
  }
  if (!result->changes.empty() && !settings.outline.empty()) {
    request.note(fmt::format("{}: {}", before, result->changes));
  }
  return std::move(result->outline);
}

/// Makes the outline the domain.
void takeOutline(PlacedSites& placed, Outline outline) {
  placed.outline = std::move(outline);
  placed.domain = boxOf(placed.outline.points);
}

/// Makes the outline the domain, or each of its parts a domain, mended. `all` is the outline, or the box in
/// degrees.
template <class Mend>
Result<void> takeOutlines(const Mend& mend, const Request& request, const Outline& all) {
  const auto& [settings, placed, words] = request;
  const std::string& file = settings.outline.empty() ? std::string() : settings.outline_name;
  if (settings.parts.empty()) {
    VORPIPE_VAR(whole, mendedBy(mend, request, all, file));
    takeOutline(placed, std::move(whole));
    return {};
  }
  std::vector<Point> points;
  for (const OutlinePart& part : settings.parts) {
    const std::string name = fmt::format("{}{}{}", file, file.empty() ? "" : ": ", part.name);
    VORPIPE_VAR(outline, mendedBy(mend, request, part.outline, name));
    points.insert(points.end(), outline.points.begin(), outline.points.end());
    placed.parts.push_back(std::move(outline));
  }
  placed.domain = boxOf(points);
  if (!settings.keeps_whole) return {};
  VORPIPE_VAR(whole, mendedBy(mend, request, all, file));
  takeOutline(placed, std::move(whole));
  return {};
}

tl::unexpected<Error> tooFarApart(const Request& request) {
  return inputError(
      fmt::format("{}: the sites reach too far for a default, name what to draw", request.words.domain));
}

/// Whether the sites appear to be in degrees.
bool areInDegrees(const PlacedSites& placed) {
  return placed.from != SitesFrom::generator && looksLikeDegrees(placed.sites, placed.system);
}

/// Clips a margin around sites in degrees at the poles: `ymin` and `ymax` are its extent.
void endAtPoles(const Request& request, std::string_view what, double& ymin, double& ymax) {
  constexpr double pole = 90;
  if ((ymin >= -pole && ymax <= pole) || !areInDegrees(request.placed)) return;
  request.note(fmt::format("{}: with its margin the {} of the sites would reach latitude {}: it ends at {}",
                           request.words.domain, what, ymin < -pole ? ymin : ymax,
                           ymin < -pole ? -pole : pole));
  ymin = std::max(ymin, -pole);
  ymax = std::min(ymax, pole);
}

/// Clips a convex ring to two parallels, which leave some of it.
std::vector<Point> between(double ymin, double ymax, std::vector<Point> ring) {
  for (const auto& [side, up] : {std::pair(ymin, 1.0), std::pair(-ymax, -1.0)}) {
    std::vector<Point> kept;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[k + 1 < ring.size() ? k + 1 : 0];
      const double above_a = a.y * up - side, above_b = b.y * up - side;
      if (above_a >= 0) kept.push_back(a);
      if ((above_a < 0 && above_b > 0) || (above_a > 0 && above_b < 0)) {
        kept.push_back({a.x + (b.x - a.x) * (above_a / (above_a - above_b)), side * up});
      }
    }
    ring = std::move(kept);
  }
  return ring;
}

Result<void> takeHull(const Request& request, const Margin& margin) {
  const Sites& sites = request.placed.sites;
  const Box box = domainOf(sites, Margin{0, false});
  const double longer = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
  if (!std::isfinite(longer)) return tooFarApart(request);
  auto hull = hullOf(sites, margin.relative ? margin.value * longer : margin.value);
  if (!hull) return renamed(request.words.domain, std::move(hull.error()));
  auto [xmin, ymin, xmax, ymax] = boxOf(hull->points);
  const double lowest = ymin, highest = ymax;
  endAtPoles(request, "hull", ymin, ymax);
  if (ymin > lowest || ymax < highest) {
    hull->points = between(ymin, ymax, std::move(hull->points));
    hull->ring_offsets = {0, hull->points.size()};
  }
  takeOutline(request.placed, std::move(*hull));
  return {};
}

/// Takes the domain of the sites themselves.
Result<void> takeDomainOfSites(const Request& request) {
  const auto& [settings, placed, words] = request;
  const Margin margin = settings.margin.value_or(Margin{settings.hull ? 0 : Margin{}.value});
  if (settings.hull) return takeHull(request, margin);
  placed.domain = domainOf(placed.sites, margin);
  endAtPoles(request, "box", placed.domain.ymin, placed.domain.ymax);
  const auto [xmin, ymin, xmax, ymax] = placed.domain;
  if (!std::isfinite(xmax - xmin) || !std::isfinite(ymax - ymin)) return tooFarApart(request);
  if (settings.margin && !(xmin < xmax && ymin < ymax)) {
    return inputError(fmt::format(
        "{}: the sites lie on a line, so that their box has no area; it takes more than 0", words.margin));
  }
  return {};
}

/// Returns the projection around the given center, or the middle of the domain or the sites.
Result<Projection> projectionFor(const Request& request, const Outline& degrees) {
  if (const auto& center = request.settings.project->center) return Projection::around(*center);
  return degrees.empty() ? projectionAmid(request.placed.sites) : projectionAmid(degrees);
}

/// Refuses a plane that does not hold the domain; notes where it is less reliable.
Result<void> checkReach(const Request& request) {
  constexpr double far = 30, percent = 100;
  const auto& [settings, placed, words] = request;
  const Point center = placed.projection->center();
  const auto reach = placed.outline.empty() ? reachOf(placed.domain) : reachOf(placed.outline);
  if (!reach) {
    return inputError(fmt::format(
        "{}: {}; the center is {}, {}: name {} by {}", words.project, reach.error().message, center.x,
        center.y, settings.project->center ? "one that is nearer" : "a smaller part of the Earth",
        settings.project->center ? words.project_around : words.domain));
  }
  if (*reach > far) {
    request.note(
        fmt::format("{}: the domain reaches {:.0f} degrees from the center {}, {}: distances there "
                    "are wrong by up to {:.0f} %, and neighbors may be others",
                    words.project, *reach, center.x, center.y, distortionAt(*reach) * percent));
  }
  return {};
}

/// Returns the requested outline in degrees; empty if there is none.
Result<Outline> outlineInDegrees(const Request& request) {
  if (!request.settings.box) return request.settings.outline;
  auto outline = outlineOfDegrees(*request.settings.box);
  return outline ? outline : renamed(request.words.domain, std::move(outline.error()));
}

/// Projects the sites to the plane, and keeps their degrees.
Result<void> projectSites(const Request& request, const Projection& projection) {
  const auto& [settings, placed, words] = request;
  auto sites = toPlane(projection, placed.sites);
  if (!sites) return renamed(words.project, std::move(sites.error()));
  placed.projection = projection;
  placed.sites = turned(projection, std::move(placed.sites));
  placed.longitudes = std::exchange(placed.sites.x, std::move(sites->x));
  placed.latitudes = std::exchange(placed.sites.y, std::move(sites->y));
  placed.system = degreesOf(hasName(placed.system) ? placed.system : settings.outline_system);
  placed.degrees = std::exchange(placed.system, {CoordinateKind::plane, {}, 0, {}, projection.center()});
  placed.degrees.from_plane_around = projection.center();
  if (!placed.sites.weight.empty()) {
    request.note(fmt::format("{}: weights are square kilometers", words.project));
  }
  return {};
}

/// Projects sites and domain to the plane.
Result<void> project(const Request& request) {
  VORPIPE_LET(degrees, outlineInDegrees(request));
  const auto projection = projectionFor(request, degrees);
  if (!projection) return renamed(request.words.project, projection.error());
  VORPIPE_TRY(projectSites(request, *projection));
  if (degrees.empty()) return takeDomainOfSites(request);
  const auto mend = [&](const Outline& outline, bool repair) {
    return mendedToPlane(*projection, outline, repair);
  };
  return takeOutlines(mend, request, degrees);
}

/// Adds a note if cells will be computed in a plane of degrees.
void noteDegrees(const Request& request) {
  const auto& [settings, placed, words] = request;
  if (settings.project || !areInDegrees(placed)) return;
  request.note(
      fmt::format("{}: coordinates look like degrees of longitude and latitude; cells are those of the plane "
                  "of degrees; {} makes a local plane where areas and distances are right",
                  words.sites, words.project_amid));
}

/// Adds a note if no site lies in the given domain: such sites take part, but that is seldom intended.
void noteNowhere(const Request& request) {
  const auto& [settings, placed, words] = request;
  if (placed.from == SitesFrom::generator || (settings.outline.empty() && !settings.box)) return;
  const auto repeats = [&, periodic = placed.periodic](Periodic axis) {
    return periodic == axis || periodic == Periodic::xy;
  };
  const bool any_x = repeats(Periodic::x), any_y = repeats(Periodic::y);
  const auto [xmin, ymin, xmax, ymax] = placed.domain;
  const Sites& sites = placed.sites;
  bool found = false;
  for (std::size_t i = 0; i < sites.size() && !found; ++i) {
    found = (any_x || (sites.x[i] >= xmin && sites.x[i] <= xmax)) &&
            (any_y || (sites.y[i] >= ymin && sites.y[i] <= ymax));
  }
  if (found) return;
  const Box all = placed.projection ? boxOf(placed.longitudes, placed.latitudes) : boxOf(sites.x, sites.y);
  const bool meets = all.xmin <= xmax && all.xmax >= xmin && all.ymin <= ymax && all.ymax >= ymin;
  if (settings.of_corners && meets) return;
  const Box named = settings.box ? *settings.box : boxOf(settings.outline.points);
  request.note(fmt::format("{}: no site lies in the box {}; those of {} lie in {}", words.domain,
                           boxText(named), words.sites, boxText(all)));
}

/// Takes the whole Earth, or an outline on it, as the domain. Patterns are spread evenly over it.
Result<void> takeGlobe(const Request& request) {
  const auto& [settings, placed, words] = request;
  if (settings.hull || settings.margin || settings.project || placed.periodic != Periodic::none) {
    return inputError(fmt::format("{}: is without {}, {}, {} and the sites' hull", words.globe, words.margin,
                                  words.project, words.periodic));
  }
  const auto isPlane = [](const CoordinateSystem& system) { return system.kind == CoordinateKind::plane; };
  if (isPlane(placed.system) || isPlane(settings.outline_system)) {
    return inputError(fmt::format("{}: {} says that its coordinates are those of a plane, not degrees",
                                  words.globe, isPlane(placed.system) ? words.sites : words.domain));
  }
  VORPIPE_LET(degrees, outlineInDegrees(request));
  if (!degrees.empty()) {
    VORPIPE_TRY(takeOutlines(mendedOnGlobe, request, degrees));
  }
  placed.globe = true;
  placed.system = degreesOf(hasName(placed.system) ? placed.system : settings.outline_system);
  placed.system.on_globe = true;
  placed.domain = {-180, -90, 180, 90};
  if (placed.from == SitesFrom::generator) placed.sites = spreadOverGlobe(std::move(placed.sites));
  return {};
}

/// Finds the domain; contradictory settings were refused before.
Result<void> foundDomain(const Request& request) {
  const auto& [settings, placed, words] = request;
  if (settings.globe) return takeGlobe(request);
  if (settings.project) {
    VORPIPE_TRY(project(request));
    return checkReach(request);
  }
  noteDegrees(request);
  if (!settings.outline.empty()) {
    const auto mend = [](const Outline& outline, bool repair) { return mended(outline, repair); };
    VORPIPE_TRY(takeOutlines(mend, request, settings.outline));
    if (placed.from == SitesFrom::generator)
      placed.sites = spreadOver(placed.domain, std::move(placed.sites));
    return {};
  }
  if (settings.box) {
    placed.domain = *settings.box;
    const auto [xmin, ymin, xmax, ymax] = *settings.box;
    if (const auto hint = hintAcrossAntimeridian(xmin, xmax); !hint.empty())
      return inputError(fmt::format("{}: xmin {} is not below xmax {}{}", words.domain, xmin, xmax, hint));
    return {};
  }
  // Generators fill the unit square.
  return placed.from == SitesFrom::generator && !settings.hull ? Result<void>{} : takeDomainOfSites(request);
}

}  // namespace

Result<void> findDomain(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words) {
  const Request request{settings, placed, words};
  VORPIPE_TRY(checkSettings(request));
  return foundDomain(request).map([&] { noteNowhere(request); });
}

std::string boxText(const Box& box) {
  return fmt::format("{},{},{},{}", box.xmin, box.ymin, box.xmax, box.ymax);
}

Fit usualFit(const PlacedSites& placed) {
  return placed.from == SitesFrom::file || !placed.outline.empty() ? Fit::letterbox : Fit::stretch;
}

}  // namespace vorpipe
