/// A fluid whose parcels are cells of constant area.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe/moving.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"

namespace vorpipe {

class Session;

/// How velocities are made incompressible.
enum class FluidScheme : std::uint8_t {
  /// Springs pull each site to the centroid of its cell, whose area is constant (Gallouet and Merigot 2018).
  /// Steps are velocity Verlet steps, which conserve energy and need one set of cells each.
  springs,
  /// A pressure makes velocities preserve areas. The middle of each step is a reflection about such
  /// velocities (Zehnder, Narain and Thomaszewski 2018), which conserves energy where projections alone lose
  /// it. Second order; only for domains that the fluid fills.
  projection,
  automatic,  ///< projection where the fluid fills the domain, springs where it has a free surface
};

/// What a viscous fluid does at walls, which never let it through.
enum class FluidWalls : std::uint8_t {
  slip,    ///< it slides along them without friction
  no_slip  ///< it sticks to them; only for domains that the fluid fills
};

/// Ready-made flows.
enum class FluidCase : std::uint8_t {
  taylor_green,     ///< a vortex that fills the unit square, steady without viscosity
  gresho,           ///< a steady vortex with a rim, in a box
  shear,            ///< two layers that slide along each other and roll up, periodic
  rayleigh_taylor,  ///< a heavy fluid above a light one
  dam_break,        ///< a falling column of water, twice as high as wide, in a box four times as wide
  shear_wave,       ///< a sine of velocities across the unit square, periodic, steady without viscosity
  channel,          ///< a viscous fluid that gravity pulls along a channel, periodic, with walls it sticks to
};

struct FluidOptions {
  Box domain;
  Outline outline;  ///< walls of any shape, as in CellsOptions; not with a period or a free surface
  Periodic periodic = Periodic::none;
  Surface surface = Surface::none;
  Point gravity{0, 0};
  FluidScheme scheme = FluidScheme::automatic;
  double viscosity = 0;  ///< kinematic: area per time
  FluidWalls walls = FluidWalls::slip;
  /// With FluidScheme::projection: per time, the part of its way to the centroid of its cell that a site
  /// moves besides. Parcels keep their velocities. 0: sites move as the fluid does, and may leave their
  /// cells.
  double centering = 0;
  /// The flow that this is, with the sites and velocities that it begins with. Then the error of velocities
  /// is known where exactVelocity() is.
  std::optional<FluidCase> known;
  double step = 0;  ///< time step; 0: each as long as the sites' speeds and the springs allow
  /// A time: springs oscillate with a period of 2 pi times this. 0: 2 spacings (3 with a free surface) over a
  /// speed; a spacing is the root of the mean volume. The speed is the largest initial speed, or half the
  /// speed of a fall from the highest site to the lowest corner of the domain. With FluidScheme::projection
  /// no automatic step is longer than half of this time.
  double epsilon = 0;
  double until =
      std::numeric_limits<double>::infinity();  ///< end time; the last step is shortened to meet it
  double tolerance = 1e-6;       ///< largest difference of an area from its volume, relative to the volume
  std::uint64_t diagrams = 100;  ///< maximum for each solution of the areas
  SearchOptions search;
  Progress progress;  ///< may be empty
};

/// The scheme of these options: springs or projection.
FluidScheme schemeOf(const FluidOptions& options);

/// Everything that a later step depends on, by site. A fluid that continues from it gives the same bytes.
struct FluidState {
  Sites sites;  ///< with weights; if it has none, they are computed
  std::vector<Point> velocity;
  std::vector<double> volume;    ///< area of the cell; empty: equal shares of the domain
  std::vector<double> density;   ///< mass per volume; empty: 1
  std::vector<double> pressure;  ///< of the last step; empty before the first
  std::vector<double> trend;     ///< of weights, per time; empty before the first step
  /// The order of the sites in memory, which rounding depends on; empty: a new one is chosen.
  std::vector<std::uint32_t> order;
  /// Sum of mass times displacement, over all shifts by a period that moved sites back against gravity. The
  /// potential energy of those falls is no longer in the sites.
  Point carried{0, 0};
  double epsilon =
      0;  ///< of springs: as chosen at the beginning if the options leave it open; 0: not yet chosen
  double time = 0;
  std::uint64_t step = 0;
};

/// The result of a step.
struct FluidStep {
  std::uint64_t step = 0;
  double time = 0, length = 0;                    ///< length: of the step
  double kinetic = 0, potential = 0, spring = 0;  ///< energies; spring: 0 except with that scheme
  Point momentum{0, 0};
  double worst = 0;     ///< largest |area - volume| / volume
  double farthest = 0;  ///< largest distance from a site to its centroid, in spacings
  double fastest = 0;   ///< largest speed
  /// Root mean square of the difference from exactVelocity(), over that of the latter; none if it is unknown.
  std::optional<double> velocity_error;
  std::uint64_t diagrams = 0, linear_iterations = 0;
  std::uint64_t halvings = 0;  ///< number of times that a step was halved because areas were not found
  double seconds = 0;          ///< since the fluid began
  [[nodiscard]] double energy() const { return kinetic + potential + spring; }
};

/// Why a fluid ended.
enum class FluidEnd : std::uint8_t {
  none,  ///< it has not
  time,
  areas,  ///< areas could not be found even for short steps
  cancelled,
};

/// A fluid, step by step. The session outlives it.
class Fluid {
 public:
  /// Finds the cells. Errors (input): those of transport(); sites outside of the outline; velocities, volumes
  /// or densities that are not finite or not as many as the sites; a scheme that does not support the
  /// surface; areas that could not be found.
  static Result<Fluid> begin(Session& session, FluidState state, FluidOptions options);
  Fluid(Fluid&&) noexcept;
  Fluid& operator=(Fluid&&) noexcept;
  ~Fluid();

  /// Makes a step. Returns whether it did; if not, end() gives the reason, and the state is that of the last
  /// step. Errors: those of Session::cells.
  Result<bool> step();

  /// Lets the fluid continue until that time, whatever ended it. If a step was cancelled, or its areas were
  /// not found, the next step begins from the same state. Errors: those of Session::cells; the time is NaN,
  /// or areas could again not be found (input).
  Result<void> goOn(double until);

  [[nodiscard]] const FluidOptions& options() const;  ///< with the chosen epsilon
  [[nodiscard]] const FluidState& state() const;      ///< in input order
  [[nodiscard]] const FluidStep& last() const;        ///< the step that led to the state
  [[nodiscard]] FluidEnd end() const;
  /// Of the last diagram. Its notes cover the fluid, too: sites beyond walls, steps too long for the springs,
  /// springs unsuited to its speeds, and energy gained from nothing.
  [[nodiscard]] const Report& report() const;
  /// Whether the energy is more than twice the energy available for motion at the beginning, or at the last
  /// push: steps are too long.
  [[nodiscard]] bool hasExploded() const;

  /// Adds to the velocities, one vector for each site, as when stirring. Errors (input): a different number
  /// of them; one that is not finite.
  Result<void> push(const std::vector<Point>& velocities);

 private:
  Fluid();
  struct State;
  std::unique_ptr<State> state_;
};

std::vector<std::string> fluidCaseNames();
std::optional<FluidCase> fluidCaseOf(std::string_view name);

struct FluidSetup {
  FluidState state;
  FluidOptions options;
};

/// The number of parcels with which a case shows what it is for.
std::uint64_t usualParcels(FluidCase which);

/// Sets up a flow with about `parcels` parcels, at least 4.
FluidSetup fluidCase(FluidCase which, std::uint64_t parcels);
/// The same inside of an outline, which lies in the case's domain: those parcels of the case, in greater
/// number, whose sites lie inside. Errors (input): those of checkInput for an outline; the case has a period
/// or a free surface; the outline reaches beyond the case's domain.
Result<FluidSetup> fluidCase(FluidCase which, std::uint64_t parcels, Outline outline);

/// Whether the exact velocity of the known flow is known under these options: their viscosity, walls, gravity
/// and domain must be those of the solution.
bool hasExactVelocity(const FluidOptions& options);

/// The exact velocity at a place and time of a flow for which there is one.
Point exactVelocity(const FluidOptions& options, Point at, double time);

}  // namespace vorpipe
