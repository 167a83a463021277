#include <new>

#include "backend/registry/registry.h"
#include "base/try.h"
#include "domain/cell_mass.h"
#include "domain/cells_run.h"
#include "globe/globe_cells.h"
#include "picture/picture.h"
#include "session/arithmetic.h"
#include "session/input_check.h"
#include "session/session_state.h"
#include "vorpipe.h"

namespace vorpipe {

using namespace core;

Error outOfMemory() {
  return {ErrorCode::device, "out of memory; fewer sites or a smaller picture would fit"};
}

namespace {

/// Finds cells, and their mass if there is a density.
Result<Diagram> cellsAndMass(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  VORPIPE_TRY(checkOptions(sites, options));
  if (options.globe) return globeCellsOn(machine, sites, options);
  if (options.density.values.empty()) return cellsOn(machine, sites, options);
  VORPIPE_VAR(found, findCells(machine, sites, options, ImagesFor::pictures));
  VORPIPE_TRY(measureMass(options, sites, machine.threads, found));
  return std::move(found.diagram);
}

}  // namespace

Session::Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Result<Session> Session::open(const BackendOptions& options) {
  VORPIPE_VAR(device, DeviceInUse::open(options));
  Session session;
  session.state_ =
      std::make_unique<State>(State{std::move(device), openExactTier(options.threads), options.threads});
  return session;
}

Result<Rendering> Session::render(const Sites& sites, const RenderOptions& options) {
  try {
    VORPIPE_TRY(checkOptions(sites, cellsOptions(options)));
    return state_->device.run<Rendering>(
        [&](Backend& backend) { return renderOn(state_->with(backend), sites, options); });
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

Result<Diagram> Session::cells(const Sites& sites, const CellsOptions& options) {
  try {
    return state_->device.run<Diagram>(
        [&](Backend& backend) { return cellsAndMass(state_->with(backend), sites, options); });
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

Result<Arithmetic> Session::arithmetic() {
  try {
    return state_->device.run<Arithmetic>([](Backend& backend) { return measureArithmetic(backend); });
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

const DeviceInfo& Session::device() const { return state_->device.info(); }
const std::string& Session::choice() const { return state_->device.choice(); }
int Session::threads() const { return state_->threads; }

}  // namespace vorpipe
