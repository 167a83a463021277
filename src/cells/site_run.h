/// The machine and the sites of a run.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "backend/exact_tier.h"
#include "base/try.h"
#include "cells/exact_search.h"
#include "sites/site_set.h"

namespace vorpipe::core {

/// What a run computes with; all of it outlives the run.
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

/// The sites of a run, and the results so far about them. Cells and pictures share it.
struct SiteRun {
  SiteRun(Prepared from, const Machine& machine)
      : prepared(std::move(from)), mesh(prepared.set, machine.threads), exact_search(machine.exact, mesh) {}
  SiteRun(const SiteRun&) = delete;
  SiteRun& operator=(const SiteRun&) = delete;

  Prepared prepared;
  SiteMesh mesh;
  ExactSearch exact_search;
  /// The cells of all sites, by index in the set, once all are found and agree.
  std::optional<NeighborRows> cells{};
};

/// Prepares sites for a machine. Errors: those of prepare, which name the sites of `callers` if given.
inline Result<std::unique_ptr<SiteRun>> beginRun(const Machine& machine, const Sites& sites,
                                                 const Box& domain, const CallersSites* callers = nullptr) {
  VORPIPE_VAR(prepared, prepare(sites, domain, machine.threads, callers));
  return std::make_unique<SiteRun>(std::move(prepared), machine);
}

}  // namespace vorpipe::core
