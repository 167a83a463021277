/// vorpipe: Voronoi diagrams of sites in the plane, on any GPU or without one.
///
/// The public interface: plain data and functions. Nothing here prints, exits or throws on bad
/// input; a function that can fail returns Result. Coordinates are the caller's own units.
#pragma once

#include <memory>
#include <string>

#include "vorpipe/cell.h"
#include "vorpipe/cells.h"
#include "vorpipe/devices.h"
#include "vorpipe/forecast.h"
#include "vorpipe/kept_sites.h"
#include "vorpipe/legend.h"
#include "vorpipe/locate.h"
#include "vorpipe/maps.h"
#include "vorpipe/moving.h"
#include "vorpipe/outline.h"
#include "vorpipe/picture.h"
#include "vorpipe/projection.h"
#include "vorpipe/relax.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"
#include "vorpipe/topology.h"
#include "vorpipe/transport.h"
#include "vorpipe/view.h"
#include "vorpipe/wall.h"

namespace vorpipe {

/// One backend, ready to work. Not thread-safe.
///
/// Where its device refuses memory it is given less at a time, which changes no cell. Where it fails, and the
/// name it was opened by was `auto` or `vulkan`, the next backend takes over, for this run and later ones;
/// Report::notes says so.
class Session {
 public:
  /// Opens the backend that options name; an error says which is missing and what would help.
  static Result<Session> open(const BackendOptions& options);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// Draws the diagram of at least one finite site. Errors: no sites, a number that is not finite,
  /// a domain or size out of range (input); the device failed (device); progress said stop.
  Result<Rendering> render(const Sites& sites, const RenderOptions& options);

  /// Computes the cells of at least one finite site. Errors: as render's.
  Result<Diagram> cells(const Sites& sites, const CellsOptions& options);

  /// Measures how the device rounds, by computing and drawing on it. Error (device): it failed.
  Result<Arithmetic> arithmetic();

  /// backend, device and driver in use; usable is true.
  [[nodiscard]] const DeviceInfo& device() const;
  /// Why `auto` or `vulkan` took this backend, or why it took over; empty where the caller named it.
  [[nodiscard]] const std::string& choice() const;
  [[nodiscard]] int threads() const;  ///< of the processor; 0 for all

 private:
  friend class CellsInTiles;
  friend class KeptSites;
  friend class MovingCells;
  Session();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
