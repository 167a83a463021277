#include <optional>
#include <utility>

#include "vorpipe.h"

namespace vorpipe {

struct KeptSites::State {
  Session* session;
  Sites sites;
  std::optional<Diagram> measures{};
};

KeptSites::KeptSites(Session& session, Sites sites)
    : state_(std::make_unique<State>(State{&session, std::move(sites)})) {}
KeptSites::KeptSites(KeptSites&&) noexcept = default;
KeptSites& KeptSites::operator=(KeptSites&&) noexcept = default;
KeptSites::~KeptSites() = default;

const Sites& KeptSites::sites() const { return state_->sites; }

Result<Rendering> KeptSites::render(const RenderOptions& options) {
  return state_->session->render(state_->sites, options);
}

Result<const Diagram*> KeptSites::measures(const CellsOptions& options) {
  CellsOptions wanted = options;
  wanted.detail = Detail::measures;
  auto cells = state_->session->cells(state_->sites, wanted);
  if (!cells) return tl::unexpected(cells.error());
  state_->measures = std::move(*cells);
  return &*state_->measures;
}

}  // namespace vorpipe
