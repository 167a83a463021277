/// The backend "cpu", of which a test changes some calls.
#pragma once

#include <memory>

#include "backend/cpu/cpu.h"
#include "backend/forwarding_backend.h"

namespace vorpipe::test {

struct OwnedCpu {
  explicit OwnedCpu(int threads) {
    BackendOptions options;
    options.threads = threads;
    cpu = makeCpuBackend(options);
  }
  std::unique_ptr<Backend> cpu;
};

class ChangedCpu : private OwnedCpu, public ForwardingBackend {
 public:
  explicit ChangedCpu(int threads) : OwnedCpu(threads), ForwardingBackend(*cpu) {}
};

}  // namespace vorpipe::test
