/// What a session holds; for those that work with a session again and again.
#pragma once

#include <memory>

#include "core/judge/machine.h"
#include "core/session/device_in_use.h"
#include "vorpipe.h"

namespace vorpipe {

struct Session::State {
  core::DeviceInUse device;
  std::unique_ptr<ExactTier> exact;
  int threads;

  [[nodiscard]] core::Machine with(Backend& backend) const { return {backend, *exact, threads}; }
};

namespace core {

inline Error outOfMemory() {
  return {ErrorCode::device, "out of memory; fewer sites or a smaller picture would fit"};
}

}  // namespace core

}  // namespace vorpipe
