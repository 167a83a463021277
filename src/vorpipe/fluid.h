/// A fluid without friction whose parcels are cells that keep their areas.
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

/// How velocities are made those of an incompressible fluid.
enum class FluidScheme : std::uint8_t {
  /// Springs pull each site to the centroid of its cell, which has its area always (Gallouet and Merigot
  /// 2018); steps are velocity Verlet's, which keep energy, and ask for one set of cells each.
  springs,
  /// Velocities that change no area, by a pressure; of each step the middle is a reflection about them
  /// (Zehnder, Narain and Thomaszewski 2018), which keeps energy where projections alone lose it. Of second
  /// order, and for domains that are full.
  projection,
};

struct FluidOptions {
  Box domain;
  Periodic periodic = Periodic::none;
  Surface surface = Surface::none;
  Point gravity{0, 0};
  FluidScheme scheme = FluidScheme::springs;
  double step = 0;  ///< of time; 0: each as long as the sites' speeds and the springs allow
  /// A time: springs swing in 2 pi of it. 0: 2 spacings, the roots of the mean volume, over the largest first
  /// speed, or over half of that with which what is highest reaches the lowest corner of the domain; with a
  /// free surface 3 spacings. By projection no step that is chosen is longer than half of it.
  double epsilon = 0;
  double until = std::numeric_limits<double>::infinity();  ///< time at which it ends, with a shorter step
  double tolerance = 1e-6;       ///< no area differs from its volume by more than this part of it
  std::uint64_t diagrams = 100;  ///< most of each set of areas
  SearchOptions search;
  Progress progress;  ///< may be empty
};

/// All that a later step depends on, by site. A fluid that continues from it gives the same bytes.
struct FluidState {
  Sites sites;  ///< with weights; without, they are found
  std::vector<Point> velocity;
  std::vector<double> volume;    ///< area of the cell; empty: equal shares of the domain
  std::vector<double> density;   ///< mass per volume; empty: 1
  std::vector<double> pressure;  ///< of the last step; empty before the first
  std::vector<double> trend;     ///< of weights, per time; empty before the first step
  /// The order in which the sites stood in memory, which rounding depends on; empty: a new one is chosen.
  std::vector<std::uint32_t> order;
  /// Sum of mass times the ways by which periods have put sites back against gravity: what they fell there is
  /// potential energy that is gone.
  Point carried{0, 0};
  double epsilon =
      0;  ///< of springs, as it was chosen at first, where the options leave it open; 0: it is not
  double time = 0;
  std::uint64_t step = 0;
};

/// The result of a step.
struct FluidStep {
  std::uint64_t step = 0;
  double time = 0, length = 0;                    ///< length: of the step
  double kinetic = 0, potential = 0, spring = 0;  ///< energies; spring: 0 but for that scheme
  Point momentum{0, 0};
  double worst = 0;     ///< largest |area - volume| / volume
  double farthest = 0;  ///< largest distance of a site to its centroid, in spacings
  double fastest = 0;   ///< largest speed
  std::uint64_t diagrams = 0, linear_iterations = 0;
  std::uint64_t halvings = 0;  ///< steps were halved so often, since areas could not be found
  double seconds = 0;          ///< since the fluid began
  [[nodiscard]] double energy() const { return kinetic + potential + spring; }
};

/// Why a fluid ended.
enum class FluidEnd : std::uint8_t {
  none,  ///< it has not
  time,
  areas,  ///< they could not be found even for short steps
  cancelled,
};

/// A fluid, step by step. The session outlives it.
class Fluid {
 public:
  /// Finds the cells. Errors (input): those of transport(); numbers of velocities, volumes or densities that
  /// are not that of sites, or not finite; a scheme that does not go with the surface; areas that could not
  /// be found.
  static Result<Fluid> begin(Session& session, FluidState state, FluidOptions options);
  Fluid(Fluid&&) noexcept;
  Fluid& operator=(Fluid&&) noexcept;
  ~Fluid();

  /// Whether a step was made; if not, end() says why, and the state is that of the last one. Errors: those of
  /// Session::cells.
  Result<bool> step();

  /// Lets it go on until that time, whatever it ended by: where a step was cancelled, or its areas were not
  /// found, the next one begins where that did. Errors: those of Session::cells; the time is NaN, or areas
  /// could not be found again (input).
  Result<void> goOn(double until);

  [[nodiscard]] const FluidOptions& options() const;  ///< epsilon is the one that was chosen
  [[nodiscard]] const FluidState& state() const;      ///< in input order
  [[nodiscard]] const FluidStep& last() const;        ///< of the state
  [[nodiscard]] FluidEnd end() const;
  /// Of the last diagram. Its notes tell of the fluid, too: sites beyond walls, steps that springs do not
  /// stand, springs that do not go with its speeds, energy out of nothing.
  [[nodiscard]] const Report& report() const;
  /// Whether there is more than twice the energy that there was to move with, at the beginning or when it was
  /// pushed last: steps are too long.
  [[nodiscard]] bool hasExploded() const;

  /// Adds to velocities, one for each site: what stirs. Errors (input): another number of them; one that is
  /// not finite.
  Result<void> push(const std::vector<Point>& velocities);

 private:
  Fluid();
  struct State;
  std::unique_ptr<State> state_;
};

/// Flows to begin with.
enum class FluidCase : std::uint8_t {
  taylor_green,     ///< a vortex that fills the unit square, and never changes
  gresho,           ///< a vortex with a rim in a box, which never changes either
  shear,            ///< two layers that slide along each other and roll up, periodic
  rayleigh_taylor,  ///< a heavy fluid above a light one
  dam_break,        ///< a column of water, twice as high as wide, in a box four times as wide, as it falls
};

std::vector<std::string> fluidCaseNames();
std::optional<FluidCase> fluidCaseOf(std::string_view name);

struct FluidSetup {
  FluidState state;
  FluidOptions options;
};

/// About `parcels` of them, at least 4.
FluidSetup fluidCase(FluidCase which, std::uint64_t parcels);

/// Where the flow never changes, its velocity; else nothing.
std::optional<Point> steadyVelocity(FluidCase which, Point at);

}  // namespace vorpipe
