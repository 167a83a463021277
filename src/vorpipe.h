/// vorpipe: Voronoi (Thiessen, Dirichlet) and power (Laguerre, radical) diagrams of sites in the plane and
/// in space.
///
/// The public interface: plain data and functions. Nothing here prints, exits or throws on bad
/// input; a function that can fail returns Result. Coordinates are the caller's own units.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "vorpipe/cell.h"
#include "vorpipe/cells.h"
#include "vorpipe/color.h"
#include "vorpipe/devices.h"
#include "vorpipe/forecast.h"
#include "vorpipe/globe.h"
#include "vorpipe/kept_sites.h"
#include "vorpipe/legend.h"
#include "vorpipe/locate.h"
#include "vorpipe/maps.h"
#include "vorpipe/moving.h"
#include "vorpipe/outline.h"
#include "vorpipe/photograph.h"
#include "vorpipe/picture.h"
#include "vorpipe/projection.h"
#include "vorpipe/relax.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"
#include "vorpipe/space.h"
#include "vorpipe/topology.h"
#include "vorpipe/transport.h"
#include "vorpipe/view.h"
#include "vorpipe/wall.h"

namespace vorpipe {

/// One backend, ready to work. Not thread-safe.
///
/// If its device refuses memory, the session works in smaller parts, which changes no cell. If the device
/// fails and the session was opened as `auto` or `vulkan`, the next backend takes over, for this run and
/// later ones; Report::notes records it.
class Session {
 public:
  /// Opens the backend that options name; an error says which one is missing and what would help.
  static Result<Session> open(const BackendOptions& options);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// Draws the diagram of at least one finite site. Errors: no sites, a number that is not finite, a domain
  /// or size out of range (input); the device failed (device); progress asked to stop (cancelled).
  Result<Rendering> render(const Sites& sites, const RenderOptions& options);

  /// Computes the cells of at least one finite site. Errors: those of render.
  Result<Diagram> cells(const Sites& sites, const CellsOptions& options);

  /// Computes the cells of at least one finite site in space, on the CPU whatever the backend. Errors: those
  /// of checkInput; two sites are too near to each other, but not equal (input); memory ran out (device);
  /// progress asked to stop (cancelled).
  Result<Diagram3> cells(std::span<const Point3> sites, const Cells3Options& options);

  /// Measures how the device rounds, by computing and drawing on it. Error (device): it failed.
  Result<Arithmetic> arithmetic();

  /// backend, device and driver in use; usable is true.
  [[nodiscard]] const DeviceInfo& device() const;
  /// Why `auto` or `vulkan` chose this backend, or why it took over; empty if the caller named it.
  [[nodiscard]] const std::string& choice() const;
  [[nodiscard]] int threads() const;  ///< CPU threads; 0: all

 private:
  friend class CellsInTiles;
  friend class KeptSites;
  friend class MovingCells;
  Session();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
