/// The domain of sites, and the plane that it is in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// That sites in degrees are taken to a plane around a center: the one that is named, or else one amid the
/// domain or the sites.
struct ProjectChoice {
  std::optional<Point> center{};  ///< degrees
};

/// What a domain is asked for with; of outline, box and hull at most one. Nothing: the box of the sites.
struct DomainSettings {
  Outline outline{};               ///< in the unit of the sites; dissolved where polygons touch or overlap
  std::string outline_name{};      ///< the file that it is of, for notes; empty: none
  std::optional<Box> box{};        ///< in the unit of the sites
  bool hull = false;               ///< the convex hull of the sites
  std::optional<Margin> margin{};  ///< around the sites' box or hull; none: 5 %, and 0 around a hull
  bool repair = false;             ///< mends rings of the outline that cross themselves
  std::optional<ProjectChoice> project{};
  CoordinateSystem outline_system{};  ///< that the outline is in
  bool of_corners = false;            ///< the sites are some that have the same box as all
};

/// The caller's own words for what messages name.
struct DomainWords {
  std::string sites = "the sites", domain = "domain", box = "a box", margin = "margin", repair = "repair",
              project = "project", project_amid = "a projection", project_around = "a center",
              periodic = "periodic", density = "density", density_box = "a density box";
};

/// Where sites come from.
enum class SitesFrom : std::uint8_t {
  caller,    ///< a program's arrays
  file,      ///< a map of something
  generator  ///< a pattern that fills the box, or the unit square
};

/// Sites with the domain that they have cells in; with a projection both are in its plane.
struct PlacedSites {
  Sites sites{};
  SitesFrom from = SitesFrom::caller;
  Box domain{0, 0, 1, 1};
  Outline outline{};  ///< the domain is its box
  Periodic periodic = Periodic::none;
  CoordinateSystem system{};  ///< of the sites as they stand here
  std::optional<Projection> projection{};
  std::vector<double> longitudes{}, latitudes{};  ///< where the sites are in degrees
  CoordinateSystem degrees{};                     ///< which degrees
  std::vector<std::string> notes{};               ///< what was reinterpreted or changed, a line each
};

/// Finds the domain of sites, at least one, whose `sites`, `from`, `periodic` and `system` are set;
/// takes both to a plane if that is asked for. Notes are added: what was mended, how far the plane can be
/// trusted, that coordinates look like degrees, that no site lies in the domain. Errors (input), each after
/// the word for what is wrong: settings that contradict each other, sites and an outline in different
/// systems, a domain that is none.
Result<void> findDomain(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words = {});

/// Leaves out the sites that are not kept, with their attributes; the domain stays.
void keepSites(PlacedSites& placed, std::vector<Attribute>& attributes, const std::vector<bool>& kept);

/// A box as in options: XMIN,YMIN,XMAX,YMAX.
std::string boxText(const Box& box);

/// What becomes of the domain in a picture of another aspect where nothing says so: files with sites and
/// outlines keep theirs; patterns, and arrays of a program that asks for these pixels, fill it.
Fit usualFit(const PlacedSites& placed);

/// Sites of a plane in degrees. One that stands where it was in `before`, a run's sites in that plane, keeps
/// the numbers of `degrees`, which are where those were.
Sites sitesInDegrees(const Projection& projection, const Sites& before, const Sites& degrees, Sites sites);
/// The same for those of an input that was placed; without a projection sites stay as they are.
Sites sitesInDegrees(const PlacedSites& placed, Sites sites);

/// Takes a diagram, and the sites that it is of, from the plane back to degrees; its measures stay in
/// kilometers. Without a projection nothing changes.
void backToDegrees(PlacedSites& placed, Diagram& diagram, int threads = 0);

}  // namespace vorpipe
