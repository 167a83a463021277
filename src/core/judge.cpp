#include "core/judge.h"

#include <fmt/format.h>

#include <numeric>

#include "core/gather.h"
#include "core/pace.h"

namespace vorpipe {
namespace {

bool isOpen(CellStatus status) { return !isDone(status); }

}  // namespace

Result<Neighborhoods> Judge::find(std::span<const std::uint32_t> which, Effort effort, int threads,
                                  const Progress& progress, std::uint64_t& exact) {
  if (!ready_ && !which.empty()) {
    if (auto uploaded = backend_.upload(sites_, {}); !uploaded) return tl::unexpected(uploaded.error());
    ready_ = true;
  }
  Gathering gathering(which.size(), threads);
  std::vector<std::uint32_t> entries(which.size());
  std::iota(entries.begin(), entries.end(), 0u);
  auto found = findSome(which, entries, effort, progress, gathering);
  if (found && effort == Effort::in_double && !found->empty()) {
    exact += found->size();
    found = findSome(which, *found, Effort::exact, progress, gathering);
  }
  if (!found) return tl::unexpected(found.error());
  if (!found->empty()) {
    return tl::unexpected(Error{
        ErrorCode::device, fmt::format("{} did not decide the cell of site {}",
                                       backend_.info().device.backend, sites_.id[which[found->front()]])});
  }
  return gathering.finish();
}

Result<std::vector<std::uint32_t>> Judge::findSome(std::span<const std::uint32_t> which,
                                                   std::span<const std::uint32_t> entries, Effort effort,
                                                   const Progress& progress, Gathering& gathering) {
  std::vector<std::uint32_t> open;
  std::vector<std::uint32_t> some;
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    const auto part = entries.subspan(begin, count);
    some.clear();
    for (const auto e : part) some.push_back(which[e]);
    Neighborhoods found;
    if (auto done = backend_.cells(some, effort, found); !done) return done;
    const auto left = withStatus(part, found.status, isOpen);
    open.insert(open.end(), left.begin(), left.end());
    gathering.add(part, std::move(found));
    return {};
  };
  const auto* stage = effort == Effort::exact ? "exact cells" : "cells in double";
  if (auto done = inSteps(progress, stage, entries.size(), backend_.info().max_entries, work); !done) {
    return tl::unexpected(done.error());
  }
  return open;
}

}  // namespace vorpipe
