/// Finds the domain of sites and the plane that it is in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// Request to project sites in degrees to a plane around a center: the given one, else one in the middle of
/// the domain or the sites.
struct ProjectChoice {
  std::optional<Point> center{};  ///< degrees
};

/// A part of an outline that is a domain by itself.
struct OutlinePart {
  std::string name{};  ///< for messages
  Outline outline{};
};

/// Settings for a domain, with at most one of outline, box and hull. Without any: the box of the sites.
struct DomainSettings {
  Outline outline{};               ///< in the unit of the sites; dissolved where polygons touch or overlap
  std::string outline_name{};      ///< the outline's file, for notes; empty: none
  std::optional<Box> box{};        ///< in the unit of the sites
  bool hull = false;               ///< the convex hull of the sites
  std::optional<Margin> margin{};  ///< around the sites' box or hull; none: 5 %, and 0 around a hull
  bool repair = false;             ///< repairs rings of the outline that cross themselves
  std::optional<ProjectChoice> project{};
  CoordinateSystem outline_system{};      ///< of the outline
  std::optional<CoordinateSystem> crs{};  ///< of sites and of an outline that name none
  /// Parts of the outline that are domains by themselves, and may overlap; none: it is one domain.
  std::vector<OutlinePart> parts{};
  bool keeps_whole = false;  ///< with parts, the outline is the domain still
  bool of_corners = false;   ///< the sites are only a few, with the same box as all
  bool globe = false;        ///< sites are in degrees, and the domain is the whole Earth
};

/// The caller's words for things that messages name.
struct DomainWords {
  std::string sites = "the sites", domain = "domain", box = "a box", margin = "margin", repair = "repair",
              project = "project", project_amid = "a projection", project_around = "a center",
              globe = "globe", periodic = "periodic", density = "density", density_box = "a density box",
              crs = "crs",
              beyond = "it is 0 elsewhere",  ///< what is where a density has no pixels
      transform = "ogr2ogr -t_srs {}";       ///< what takes a file to the system {}
};

/// Source of sites.
enum class SitesFrom : std::uint8_t {
  caller,    ///< a program's arrays
  file,      ///< a map of something
  generator  ///< a pattern that fills the box, or the unit square
};

/// Sites and the domain of their cells; with a projection, both are in its plane.
struct PlacedSites {
  Sites sites{};
  SitesFrom from = SitesFrom::caller;
  Box domain{0, 0, 1, 1};
  Outline outline{};  ///< the domain is its box
  /// In place of an outline, or with DomainSettings::keeps_whole beside it, its parts in the settings' order:
  /// domains by themselves, in whose box cells are.
  std::vector<Outline> parts{};
  Periodic periodic = Periodic::none;
  CoordinateSystem system{};  ///< of the sites as given here
  std::optional<Projection> projection{};
  bool globe = false;  ///< sites are in degrees, and their cells are those on the sphere
  std::vector<double> longitudes{}, latitudes{};  ///< of the sites, in degrees
  CoordinateSystem degrees{};                     ///< system of those degrees
  std::vector<std::string> notes{};               ///< what was reinterpreted or changed, a line each
};

/// Finds the domain of sites, at least one, whose `sites`, `from`, `periodic` and `system` are set; projects
/// both to a plane if requested. Adds notes: what was repaired, how far the plane can be trusted, that
/// coordinates look like degrees, that no site lies in the domain. Errors (input), each after the word for
/// what is wrong: settings that contradict each other, sites and an outline in different systems, an invalid
/// domain.
Result<void> findDomain(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words = {});

/// Whether `system` is degrees. If it is unknown: whether all sites lie within +-180 and +-90, and their x
/// reach below -90 and above 90.
bool looksLikeDegrees(const Sites& sites, const CoordinateSystem& system);

/// Returns advice if a box from `west` to `east` may be meant across the antimeridian, in words that continue
/// a refusal; else nothing.
std::string hintAcrossAntimeridian(double west, double east);

/// Withdraws that `system` is degrees if a site exceeds 360 or 90 of them. Returns a note that continues the
/// name of the sites; empty if nothing changed.
std::string_view settleDegrees(const Sites& sites, CoordinateSystem& system);

/// Removes the sites that are not `kept`, with their attributes; the domain stays.
void keepSites(PlacedSites& placed, std::vector<Attribute>& attributes, const std::vector<bool>& kept);

/// Returns the box of sites, at least one, which may lie on a line.
Box boxOf(const std::vector<double>& x, const std::vector<double>& y);

/// A box as in options: XMIN,YMIN,XMAX,YMAX.
std::string boxText(const Box& box);

/// Returns the default fit of the domain in a picture of another aspect. Files with sites and outlines keep
/// their aspect; patterns, and arrays of a program that asks for these pixels, fill it.
Fit usualFit(const PlacedSites& placed);

/// Converts sites of a plane to degrees. A site that has not moved from `before`, a run's sites in that
/// plane, keeps its numbers in `degrees`, the positions of `before`.
Sites sitesInDegrees(const Projection& projection, const Sites& before, const Sites& degrees, Sites sites);
/// The same for sites of a placed input; without a projection sites stay as they are.
Sites sitesInDegrees(const PlacedSites& placed, Sites sites);

/// Converts a diagram and its sites from the plane back to degrees; its measures stay in kilometers. Without
/// a projection nothing changes.
void backToDegrees(PlacedSites& placed, Diagram& diagram, int threads = 0);

}  // namespace vorpipe
