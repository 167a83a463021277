/// Definitions of the opaque types of vorpipe_c.h.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "c/vorpipe_c.h"
#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "io/cells/cells_mesh.h"
#include "io/sites/site_domain.h"
#include "io/sites/site_source.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

struct vorpipe_devices {
  std::vector<vorpipe::DeviceInfo> infos;
};

struct vorpipe_session {
  vorpipe::Session session;
  int threads;
  std::atomic<bool> is_busy{false};  ///< during a run; SessionUse sets it
};

namespace vorpipe::c {

/// An input in the form that runs need: sites and domain, in a plane if they are to be projected.
struct PlacedInput {
  PlacedSites domain;                  ///< without the sites, and their places in degrees
  std::shared_ptr<const Sites> sites;  ///< of the run
  std::shared_ptr<const Sites> given;  ///< as in the diagram: in degrees, if they are projected
};

/// The positions of a diagram before conversion to degrees.
struct PlanePositions {
  std::vector<Point> vertices, centroid, mass_centroid;
};

/// The border lines of the cells of a free surface.
struct Borders {
  std::vector<std::uint64_t> offsets;
  std::vector<std::array<double, 5>> parts;  ///< from, to, angle
  std::vector<std::int64_t> neighbors;
};

}  // namespace vorpipe::c

/// Diagrams and pictures share sites and attributes, which a change of the input replaces.
struct vorpipe_input {
  std::shared_ptr<const vorpipe::Sites> sites;
  std::shared_ptr<const std::vector<vorpipe::Attribute>> attributes;
  vorpipe::CoordinateSystem system{};
  std::string name;  ///< for messages about the sites
  vorpipe::SitesFrom from = vorpipe::SitesFrom::caller;
  std::optional<vorpipe::Generator> generator{};  ///< of sites that fill a box that is set
  std::uint64_t skipped = 0;
  vorpipe::DomainSettings domain{};
  vorpipe::Periodic periodic = vorpipe::Periodic::none;
  vorpipe::Surface surface = vorpipe::Surface::none;
  vorpipe::Density density{};
  std::string density_name{};                      ///< name of its file; empty: the caller's own density
  vorpipe::CoordinateSystem density_system{};      ///< of its place
  std::shared_ptr<const std::vector<double>> z{};  ///< of sites in space; null: in the plane
  std::optional<vorpipe::Box3> box3{};             ///< of these
  std::array<bool, 3> periodic3{};                 ///< of the box
  std::optional<vorpipe::Lattice> lattice{};       ///< instead of a box
  /// For moved sites: the domain found before, until another one is set.
  std::shared_ptr<const vorpipe::c::PlacedInput> kept;
  mutable std::shared_ptr<const vorpipe::c::PlacedInput> placed;  ///< found when it is first needed
  /// The placed input that the density was last checked with; none: not yet checked.
  mutable std::shared_ptr<const vorpipe::c::PlacedInput> density_looked_at;
  mutable std::deque<std::string> notes;  ///< its elements never move
};

namespace vorpipe::c {

/// Cells in space, with what they were made from.
struct SpaceCells {
  Sites3 sites;
  std::vector<double> weights;
  Cells3Options options;  ///< without progress and weights
  Diagram3 diagram;

  [[nodiscard]] Cells3Options whole() const {
    Cells3Options all = options;
    all.weights = weights;
    return all;
  }
};

}  // namespace vorpipe::c

/// Of the plane, unless it has cells in space.
struct vorpipe_diagram {
  std::shared_ptr<const vorpipe::c::PlacedInput> input;
  std::shared_ptr<const std::vector<vorpipe::Attribute>> attributes;
  vorpipe::CellsOptions options;  ///< of the run; without progress
  vorpipe::Diagram diagram;
  std::optional<vorpipe::c::PlanePositions> plane;  ///< of sites that are projected
  bool has_air;                                     ///< whether discs have cut the cells
  mutable std::once_flag topology_once;
  mutable std::optional<vorpipe::Result<vorpipe::Topology>> topology;  ///< found on first request
  mutable std::once_flag borders_once;
  mutable vorpipe::c::Borders borders;  ///< likewise
  mutable std::once_flag mesh_once{};
  mutable std::optional<vorpipe::Result<vorpipe::CellTriangles>> mesh{};  ///< likewise
  mutable std::vector<std::array<float, 2>> mesh_vertices{};              ///< likewise
  std::optional<vorpipe::c::SpaceCells> space{};

  /// What the run did.
  [[nodiscard]] const vorpipe::Report& report() const {
    return space ? space->diagram.report : diagram.report;
  }
};

struct vorpipe_locator {
  vorpipe::Locator locator;
  std::shared_ptr<const vorpipe::Sites> discs;    ///< beyond these is air; none if cells fill the domain
  std::optional<vorpipe::Projection> projection;  ///< of places in degrees
};

struct vorpipe_relaxation {
  vorpipe_session* session;
  std::shared_ptr<const vorpipe::c::PlacedInput> placed;  ///< as the sites were given
  vorpipe_input input;                                    ///< everything else that was given
  vorpipe::Relaxation relaxation;
  mutable std::vector<vorpipe::Point> shown{};  ///< the sites, as of the last request
  mutable std::vector<std::array<double, 5>> trace{};
  mutable std::vector<std::uint8_t> taken{};
};

struct vorpipe_transported {
  std::shared_ptr<const vorpipe::c::PlacedInput> placed;
  vorpipe_input input;
  vorpipe::Surface surface;
  vorpipe::Transported found;
  std::vector<vorpipe::Point> centroids{};  ///< in the caller's coordinates
  std::vector<std::array<double, 9>> trace{};
};

struct vorpipe_fluid {
  vorpipe_session* session;
  std::shared_ptr<const vorpipe::c::PlacedInput> placed;
  vorpipe_input input;
  vorpipe::Fluid fluid;
  mutable std::vector<vorpipe::Point> places{};  ///< of the sites, as of the last request
};

struct vorpipe_picture {
  std::shared_ptr<const vorpipe::c::PlacedInput> input;  ///< none if it was read from a file
  vorpipe::RenderOptions options;                        ///< of the run; without progress
  vorpipe::Rendering rendering;
  bool has_air = false;  ///< whether discs have cut the cells
};

namespace vorpipe::c {

/// Finds the domain of an input, unless that was done since its last change, and notes what was repaired or
/// reinterpreted. Errors: those of findDomain (input).
Result<std::shared_ptr<const PlacedInput>> placedInput(const vorpipe_input& input);

/// Call this after changing something that the domain depends on: the domain is found anew, even if it was
/// kept.
void findAnew(vorpipe_input& input);

/// Converts a diagram of this input back to degrees, if its sites were projected, and returns its previous
/// positions.
std::optional<PlanePositions> takeToDegrees(const PlacedInput& input, Diagram& diagram, int threads);

/// Converts sites in the plane of an input to the caller's coordinates: to degrees if it is projected.
Sites shownSites(const PlacedInput& input, Sites sites);

/// Copies a placed input with other sites. The domain does not change, even if it was derived from the sites,
/// until findAnew().
std::unique_ptr<vorpipe_input> inputOf(const vorpipe_input& input, const PlacedInput& placed,
                                       const Sites& sites);

/// The coordinate system of all positions of a diagram.
const CoordinateSystem& systemOf(const PlacedInput& input);

/// Returns the cells of sites with that surface. With a free surface they have the detail `polygons`, and
/// `options` is changed to it. Errors: those of Session::cells and freeCells.
Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites, CellsOptions& options);

/// Computes the cells of an input with z.
Result<SpaceCells> cellsInSpace(vorpipe_session& session, const vorpipe_input& input,
                                const vorpipe_cells_options* given);

/// Error (input): the cells are in space; `what` is of the plane.
Result<void> refuseSpace(const vorpipe_diagram& diagram, std::string_view what);

/// Returns the array of a field. Error (input): cells in space have no such field.
Result<vorpipe_array> arrayInSpace(const SpaceCells& cells, vorpipe_diagram_field field);

/// Writes cells in space in the format of an extension. Errors: those of spaceFormatOf and writeSpaceCells.
Result<void> writeInSpace(ByteSink& to, const vorpipe_diagram& diagram, const std::string& path);

/// Returns the topology, found once by the first thread that requests it; the diagram keeps it. Errors: those
/// of topologyOf.
const Result<Topology>& sharedPartsOf(const vorpipe_diagram& diagram);

}  // namespace vorpipe::c
