#include <new>

#include "backend/registry.h"
#include "core/diagram.h"
#include "core/render.h"
#include "vorpipe.h"

namespace vorpipe {

namespace {

Error outOfMemory() {
  return {ErrorCode::device, "out of memory; fewer sites or a smaller picture would fit"};
}

}  // namespace

struct Session::State {
  OpenedBackend opened;
  std::unique_ptr<Backend> judge;
  int threads;
};

Session::Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Result<Session> Session::open(const BackendOptions& options) {
  auto opened = openBackend(options);
  if (!opened) return tl::unexpected(opened.error());
  Session session;
  session.state_ =
      std::make_unique<State>(State{std::move(*opened), openJudge(options.threads), options.threads});
  return session;
}

Result<Rendering> Session::render(const Sites& sites, const RenderOptions& options) {
  try {
    return renderOn(*state_->opened.backend, *state_->judge, state_->threads, sites, options);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

Result<Diagram> Session::cells(const Sites& sites, const CellsOptions& options) {
  try {
    return cellsOn(*state_->opened.backend, *state_->judge, state_->threads, sites, options);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

const DeviceInfo& Session::device() const { return state_->opened.backend->info().device; }
const std::string& Session::choice() const { return state_->opened.choice; }

}  // namespace vorpipe
