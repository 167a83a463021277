/// The sites of a run, prepared once, and the results so far about them. Cells and pictures share it.
#pragma once

#include <memory>
#include <optional>

#include "cells/judge.h"
#include "cells/machine.h"
#include "sites/site_set.h"

namespace vorpipe::core {

struct SiteRun {
  SiteRun(Prepared from, const Machine& machine)
      : prepared(std::move(from)), mesh(prepared.set, machine.threads), judge(machine.exact, mesh) {}
  SiteRun(const SiteRun&) = delete;
  SiteRun& operator=(const SiteRun&) = delete;

  Prepared prepared;
  SiteMesh mesh;
  Judge judge;
  /// The cells of all sites, by index in the set, once all are found and agree.
  std::optional<NeighborRows> cells{};
};

/// Prepares sites for a machine. Errors: those of prepare, which name the sites of `callers` if given.
inline Result<std::unique_ptr<SiteRun>> beginRun(const Machine& machine, const Sites& sites,
                                                 const Box& domain, const CallersSites* callers = nullptr) {
  auto prepared = prepare(sites, domain, machine.threads, callers);
  if (!prepared) return tl::unexpected(prepared.error());
  return std::make_unique<SiteRun>(std::move(*prepared), machine);
}

}  // namespace vorpipe::core
