#include "io/sites/site_systems.h"

#include <fmt/core.h>

#include <cstdint>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"

namespace vorpipe {
namespace {

/// Adds a note if two systems may be others than one; `both` names them. Returns whether they differ.
bool differ(const CoordinateSystem& a, const CoordinateSystem& b, const std::string& both,
            PlacedSites& placed) {
  switch (compared(a, b)) {
    case SystemsAre::one:
      return false;
    case SystemsAre::near:
      placed.notes.push_back(both + ", which is the same to some two meters");
      return false;
    case SystemsAre::unclear:
      placed.notes.push_back(both + "; nothing here says whether that is the same, and it is taken so");
      return false;
    case SystemsAre::different:
      break;
  }
  return true;
}

/// Whether sites may be in a system: those of files have no degrees beyond 360 and 90.
bool mayBeIn(CoordinateSystem system, const PlacedSites& placed) {
  return placed.from == SitesFrom::generator || settleDegrees(placed.sites, system).empty();
}

/// Takes the system that the settings name.
Result<void> takeNamed(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words) {
  if (!settings.crs) return {};
  const CoordinateSystem& named = *settings.crs;
  constexpr std::int64_t least = 1024, most = 32767;
  if (named.organization == "EPSG" && (named.code < least || named.code > most)) {
    placed.notes.push_back(
        fmt::format("{}: {} is no code of EPSG, which are {} to {}", words.crs, nameOf(named), least, most));
  }
  const auto agrees = [&](const CoordinateSystem& theirs, const std::string& name) -> Result<void> {
    const std::string both =
        fmt::format("{}: {} is named, and {} is in {}", words.crs, nameOf(named), name, nameOf(theirs));
    if (differ(named, theirs, both, placed)) return inputError(both);
    return {};
  };
  VORPIPE_TRY(agrees(placed.system, words.sites));
  if (!settings.outline.empty()) VORPIPE_TRY(agrees(settings.outline_system, nameOfOutline(settings)));
  if (hasName(placed.system)) return {};
  if (!mayBeIn(named, placed)) {
    return inputError(fmt::format("{}: {} is of degrees, and coordinates of {} are none", words.crs,
                                  nameOf(named), words.sites));
  }
  placed.system = named;
  return {};
}

std::string transformTo(const std::string& system, const DomainWords& words) {
  return fmt::format(fmt::runtime(words.transform), system);
}

/// Refuses sites and an outline in different systems.
Result<void> compareSystems(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words) {
  const CoordinateSystem &its = settings.outline_system, &of_sites = placed.system;
  const std::string both = fmt::format("{}: {} is in {}, {} in {}", words.domain, nameOfOutline(settings),
                                       nameOf(its), words.sites, nameOf(of_sites));
  if (!differ(its, of_sites, both, placed)) return {};
  if (settings.project) {
    return inputError(fmt::format("{}; {} takes both in degrees, as {} makes them", both, words.project,
                                  transformTo("EPSG:4326", words)));
  }
  return inputError(fmt::format("{}; take one to the system of the other, as {} does", both,
                                transformTo(hasName(of_sites) ? nameOf(of_sites) : "EPSG:4326", words)));
}

/// Gives sites without a system that of the outline, unless they are to be projected: projectSites() does it
/// then. Adds a note for files whose kind of coordinates was unknown. There is none for patterns and arrays,
/// which never name a system, nor where only the datum of degrees becomes known.
void adoptSystem(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words) {
  const CoordinateSystem& its = settings.outline_system;
  const auto kind = placed.system.kind;
  const bool other = kind != CoordinateKind::unknown && kind != its.kind;
  if (settings.project || !hasName(its) || hasName(placed.system) || other || !mayBeIn(its, placed)) return;
  placed.system = its;
  if (placed.from != SitesFrom::file || kind == CoordinateKind::degrees) return;
  placed.notes.push_back(fmt::format("{}: names no coordinate system, and is taken to be in {}, as {} is",
                                     words.sites, nameOf(its), nameOfOutline(settings)));
}

}  // namespace

std::string nameOfOutline(const DomainSettings& settings) {
  return settings.outline_name.empty() ? "the outline" : settings.outline_name;
}

Result<void> settleSystems(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words) {
  VORPIPE_TRY(takeNamed(settings, placed, words));
  if (settings.outline.empty()) return {};
  if (placed.from != SitesFrom::generator) VORPIPE_TRY(compareSystems(settings, placed, words));
  adoptSystem(settings, placed, words);
  return {};
}

}  // namespace vorpipe
