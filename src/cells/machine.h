/// What a run computes with.
#pragma once

#include <utility>

#include "backend/exact_tier.h"

namespace vorpipe::core {

/// All of it outlives the run.
struct Machine {
  Backend& backend;  ///< of the device that the caller chose
  ExactTier& exact;  ///< of this run alone, while it lasts
  int threads;       ///< of the processor; 0 for all
  /// How often anything was uploaded to the device, by any run; null where that is not counted.
  const std::uint64_t* uploads = nullptr;
};

/// Says in a report which device did the work, which pipelines it needed, and what the validation layers
/// said.
inline void nameDevice(Backend& backend, Report& report) {
  const auto& device = backend.info().device;
  report.backend = device.backend;
  report.device = device.name;
  report.driver = device.driver;
  for (auto& made : backend.pipelinesMade()) report.pipelines.push_back(std::move(made));
  for (auto& message : backend.validationMessages()) report.validation_messages.push_back(std::move(message));
}

}  // namespace vorpipe::core
