/// The backend that certifies what another did not: in double, then exactly.
#pragma once

#include "backend/backend.h"
#include "core/gather.h"

namespace vorpipe {

/// Gives the sites to the judge when it is first asked: most runs on even data never ask.
class Judge {
 public:
  /// `backend` takes in_double and exact, and nobody else gives it sites; both outlive this.
  Judge(Backend& backend, const SiteSet& sites) : backend_(backend), sites_(sites) {}

  /// The cells of `which`, found with `effort`, in_double or exact: each comes out certified or empty.
  /// `exact` is increased by the number of cells that double did not decide.
  /// Errors: those of the backend; progress said stop.
  Result<Neighborhoods> find(std::span<const std::uint32_t> which, Effort effort, int threads,
                             const Progress& progress, std::uint64_t& exact);

 private:
  /// Adds the cells of which[e] for e in `entries`; returns the entries that are still open.
  Result<std::vector<std::uint32_t>> findSome(std::span<const std::uint32_t> which,
                                              std::span<const std::uint32_t> entries, Effort effort,
                                              const Progress& progress, Gathering& gathering);

  Backend& backend_;
  const SiteSet& sites_;
  bool ready_ = false;
};

}  // namespace vorpipe
