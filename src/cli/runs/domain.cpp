#include "cli/runs/domain.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/domain/outline_file.h"
#include "io/files/error.h"

namespace vorpipe::cli {
namespace {

bool isOutlined(const DomainChoice& domain) { return domain.hull || !domain.file.empty(); }

/// What contradicts itself, whatever is in the files.
Result<void> checkDomainOptions(const InputOptions& options, const Input& input) {
  const DomainChoice& domain = options.domain;
  if (options.margin && (domain.box || !domain.file.empty())) {
    return inputError("--margin: --domain names the domain, which has none; give one of them");
  }
  if (options.margin && input.seed && !domain.hull) {
    return inputError("--margin: generators fill the domain 0,0,1,1; name another by --domain");
  }
  if (options.repair && domain.file.empty()) {
    return inputError("--repair: is for the polygons of --domain FILE");
  }
  if (input.periodic != Periodic::none) {
    if (options.project)
      return inputError("--periodic: the Earth does not repeat itself; leave --project out");
    if (isOutlined(domain)) {
      return inputError("--periodic: a domain with an outline does not repeat itself");
    }
    if (!input.seed && !domain.box) {
      return inputError(
          "--periodic: name the period by --domain XMIN,YMIN,XMAX,YMAX; a file of sites does not say it");
    }
  }
  if (options.project && input.seed) {
    return inputError(fmt::format("--project: is for files in degrees, not for {}", options.sites));
  }
  if (options.project && input.system.kind == CoordinateKind::plane) {
    return inputError(fmt::format("--project: {} says that its coordinates are those of a plane, not degrees",
                                  options.sites));
  }
  return {};
}

/// Without the subject's name, which the option's stands for.
tl::unexpected<Error> unprefixed(std::string_view option, Error error) {
  const std::string name = fmt::format("{}: ", nameOf(error.subject));
  if (error.subject != Subject::none && error.message.starts_with(name)) error.message.erase(0, name.size());
  return named(option, std::move(error));
}

/// An outline of --domain that `mend(repair)` dissolves and repairs, which is noted.
template <class Mend>
Result<Outline> mendedBy(const Mend& mend, const InputOptions& options, Input& input) {
  auto result = mend(options.repair);
  if (!result) {
    if (!options.repair && !options.domain.file.empty() && mend(true)) {
      result.error().message += "; --repair mends it";
    }
    return unprefixed("--domain", std::move(result.error()));
  }
  if (!result->changes.empty() && !options.domain.file.empty()) {
    input.notes.push_back(fmt::format("--domain: {}: {}", options.domain.file, result->changes));
  }
  return std::move(result->outline);
}

/// The outline of --domain FILE, as it stands there; empty where it names none.
Result<Outline> readDomainFile(const InputOptions& options) {
  if (options.domain.file.empty()) return Outline{};
  auto outline = readOutline(options.domain.file);
  return outline ? outline : named("--domain", std::move(outline.error()));
}

/// The domain that the sites themselves have.
Result<void> takeDomainOfSites(const InputOptions& options, Input& input) {
  const Margin margin = options.margin.value_or(Margin{options.domain.hull ? 0 : Margin{}.value});
  if (options.domain.hull) {
    const Box box = domainOf(input.sites, Margin{0, false});
    const double longer = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
    auto hull = hullOf(input.sites, margin.relative ? margin.value * longer : margin.value);
    if (!hull) return unprefixed("--domain", std::move(hull.error()));
    input.outline = std::move(*hull);
    input.domain = boxOf(input.outline.points);
    return {};
  }
  input.domain = domainOf(input.sites, margin);
  const auto [xmin, ymin, xmax, ymax] = input.domain;
  if (!std::isfinite(xmax - xmin) || !std::isfinite(ymax - ymin)) {
    return inputError("--domain: the sites reach too far for a default, name what to draw");
  }
  if (options.margin && !(xmin < xmax && ymin < ymax)) {
    return inputError(
        "--margin: the sites lie on a line, so that their box has no area; it takes more than 0");
  }
  return {};
}

/// The projection that --project asks for, around the center that it names, or amid the domain or the sites.
Result<Projection> projectionFor(const InputOptions& options, const Outline& degrees, const Sites& sites) {
  if (options.project->center) return Projection::around(*options.project->center);
  return degrees.empty() ? projectionAmid(sites) : projectionAmid(degrees);
}

/// Refuses a plane that does not hold the domain, and notes where it can be trusted little.
Result<void> checkReach(const InputOptions& options, Input& input) {
  constexpr double far = 30, percent = 100;
  const Point center = input.projection->center();
  const auto reach = input.outline.empty() ? reachOf(input.domain) : reachOf(input.outline);
  if (!reach) {
    return inputError(
        fmt::format("--project: {}, which is {}, {}; name {} by {}", reach.error().message, center.x,
                    center.y, options.project->center ? "one that is nearer" : "a smaller part of the Earth",
                    options.project->center ? "--project LON,LAT" : "--domain"));
  }
  if (*reach > far) {
    input.notes.push_back(
        fmt::format("--project: the domain reaches {:.0f} degrees from the center {}, {}: distances there "
                    "are wrong by up to "
                    "{:.0f} %, and neighbors may be others",
                    *reach, center.x, center.y, distortionAt(*reach) * percent));
  }
  return {};
}

/// The outline in degrees that --domain names; empty where it names none.
Result<Outline> domainInDegrees(const InputOptions& options) {
  if (!options.domain.box) return readDomainFile(options);
  auto outline = outlineOfDegrees(*options.domain.box);
  if (!outline) return unprefixed("--domain", std::move(outline.error()));
  return outline;
}

/// Takes sites and domain to the plane.
Result<void> project(const InputOptions& options, Input& input) {
  const auto degrees = domainInDegrees(options);
  if (!degrees) return tl::unexpected(degrees.error());
  const auto projection = projectionFor(options, *degrees, input.sites);
  if (!projection) return unprefixed("--project", projection.error());
  auto sites = toPlane(*projection, input.sites);
  if (!sites) return unprefixed("--project", std::move(sites.error()));
  input.projection = *projection;
  input.sites = turned(*projection, std::move(input.sites));
  input.longitudes = std::exchange(input.sites.x, std::move(sites->x));
  input.latitudes = std::exchange(input.sites.y, std::move(sites->y));
  if (input.system.kind != CoordinateKind::degrees) input.system = wgs84();
  input.degrees = std::exchange(input.system, {CoordinateKind::plane, {}, 0, {}, projection->center()});
  if (!input.sites.weight.empty()) input.notes.emplace_back("--project: weights are square kilometers");
  if (degrees->empty()) return takeDomainOfSites(options, input);
  auto whole =
      mendedBy([&](bool repair) { return mendedToPlane(*projection, *degrees, repair); }, options, input);
  if (!whole) return tl::unexpected(std::move(whole.error()));
  input.outline = std::move(*whole);
  input.domain = boxOf(input.outline.points);
  return {};
}

}  // namespace

Result<void> takeDomain(const InputOptions& options, Input& input) {
  if (auto checked = checkDomainOptions(options, input); !checked) return checked;
  if (options.project) {
    if (auto taken = project(options, input); !taken) return taken;
    return checkReach(options, input);
  }
  const auto outline = readDomainFile(options);
  if (!outline) return tl::unexpected(outline.error());
  if (!outline->empty()) {
    auto whole = mendedBy([&](bool repair) { return mended(*outline, repair); }, options, input);
    if (!whole) return tl::unexpected(std::move(whole.error()));
    input.outline = std::move(*whole);
    input.domain = boxOf(input.outline.points);
    if (input.seed) input.sites = spreadOver(input.domain, std::move(input.sites));
    return {};
  }
  if (options.domain.box) {
    input.domain = *options.domain.box;
    return {};
  }
  // Generators fill the unit square.
  return input.seed && !options.domain.hull ? Result<void>{} : takeDomainOfSites(options, input);
}

void backToDegrees(Input& input, Diagram& diagram, int threads) {
  if (!input.projection) return;
  input.sites.x = std::move(input.longitudes);
  input.sites.y = std::move(input.latitudes);
  toDegrees(*input.projection, input.sites, diagram, threads);
  input.system = input.degrees;
}

}  // namespace vorpipe::cli
