/// The internal state of a session.
#pragma once

#include <memory>

#include "backend/registry/registry.h"
#include "cells/site_run.h"
#include "session/device_in_use.h"
#include "vorpipe.h"

namespace vorpipe {

struct Session::State {
  core::DeviceInUse device;
  std::unique_ptr<ExactTier> exact;
  int threads;

  [[nodiscard]] core::Machine with(Backend& backend) const { return with(backend, *exact); }
  /// With the caller's own exact tier.
  [[nodiscard]] core::Machine with(Backend& backend, ExactTier& tier) const {
    return {backend, tier, threads, &device.uploads()};
  }
};

/// Returns the error for a run that ended with std::bad_alloc.
Error outOfMemory();

}  // namespace vorpipe
