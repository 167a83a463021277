/// Sites that are drawn in several views, one after another.
#pragma once

#include <memory>

#include "vorpipe/cells.h"
#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

class Session;

/// Keeps data that drawing the same sites again would recompute: their order, their cells, their uploads. The
/// session outlives this object. Other work that the session does between two calls makes the next one
/// slower.
class KeptSites {
 public:
  KeptSites(Session& session, Sites sites);
  KeptSites(KeptSites&&) noexcept;
  KeptSites& operator=(KeptSites&&) noexcept;
  ~KeptSites();

  [[nodiscard]] const Sites& sites() const;

  /// Draws the same pixels as Session::render. If only view, size, colors and marks differ from the previous
  /// call, only those are recomputed. Errors: those of Session::render.
  Result<Rendering> render(const RenderOptions& options);

  /// Areas, centroids and neighbors, computed once per domain, outline, period and search; valid until the
  /// next call. Errors: those of Session::cells.
  Result<const Diagram*> measures(const CellsOptions& options);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
