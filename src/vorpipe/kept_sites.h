/// Sites that are drawn in one view after another.
#pragma once

#include <memory>

#include "vorpipe/cells.h"
#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

class Session;

/// Keeps with a session what drawing the same sites again would find again: their order, their cells, what is
/// uploaded. The session outlives this, and does nothing else between two calls that would be slower for it.
class KeptSites {
 public:
  KeptSites(Session& session, Sites sites);
  KeptSites(KeptSites&&) noexcept;
  KeptSites& operator=(KeptSites&&) noexcept;
  ~KeptSites();

  [[nodiscard]] const Sites& sites() const;

  /// What Session::render draws, pixel by pixel. Where nothing but view, size, colors and marks differ from
  /// the call before, only those are found anew. Errors: those of Session::render.
  Result<Rendering> render(const RenderOptions& options);

  /// Areas, centroids and neighbors, found once for the same domain, outline, period and search; good until
  /// the next call. Errors: those of Session::cells.
  Result<const Diagram*> measures(const CellsOptions& options);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
