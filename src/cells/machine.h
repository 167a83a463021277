/// What a run computes with.
#pragma once

#include <utility>

#include "backend/exact_tier.h"

namespace vorpipe::core {

/// All of it outlives the run.
struct Machine {
  Backend& backend;  ///< of the device that the caller chose
  ExactTier& exact;  ///< used by this run alone while it lasts
  int threads;       ///< processor threads; 0 for all
  /// How often anything was uploaded to the device, by any run; null where that is not counted.
  const std::uint64_t* uploads = nullptr;
};

/// Adds to a report the device that did the work, the pipelines it needed, and the messages of the validation
/// layers.
inline void nameDevice(Backend& backend, Report& report) {
  const auto& device = backend.info().device;
  report.backend = device.backend;
  report.device = device.name;
  report.driver = device.driver;
  for (auto& made : backend.pipelinesMade()) report.pipelines.push_back(std::move(made));
  for (auto& message : backend.validationMessages()) report.validation_messages.push_back(std::move(message));
}

}  // namespace vorpipe::core
