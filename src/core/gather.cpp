#include "core/gather.h"

#include <algorithm>

#include "core/row_start.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = std::size_t{1} << 15;

}  // namespace

/// Part 0 has the one entry that stands for every cell which was never added.
Gathering::Gathering(std::size_t cells, int threads) : places_(cells, Place{0, 0}), threads_(threads) {
  parts_.push_back({{CellStatus::missing}, {0, 0}, {}});
}

void Gathering::add(std::span<const std::uint32_t> which, Neighborhoods found) {
  const auto part = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back(std::move(found));
  parallelFor(which.size(), grain, threads_, [&](std::size_t begin, std::size_t end) {
    for (auto e = begin; e < end; ++e) places_[which[e]] = {part, static_cast<std::uint32_t>(e)};
  });
}

/// copy(row, out) writes a row to its place.
template <class Copy>
Neighborhoods Gathering::finishWith(const Copy& copy) const {
  const auto cells = places_.size();
  Neighborhoods all;
  all.status.resize(cells);
  all.first.resize(cells + 1);
  std::vector<std::uint64_t> block_first((cells + grain - 1) / grain + 1);
  parallelFor(cells, grain, threads_, [&](std::size_t begin, std::size_t end) {
    std::uint64_t count = 0;
    for (auto i = begin; i < end; ++i) {
      const auto& part = parts_[places_[i].part];
      const auto e = places_[i].entry;
      all.first[i] = count;
      all.status[i] = part.status[e];
      count += part.first[e + 1] - part.first[e];
    }
    block_first[begin / grain + 1] = count;
  });
  for (std::size_t block = 1; block < block_first.size(); ++block)
    block_first[block] += block_first[block - 1];
  all.first[cells] = block_first.back();
  all.neighbor.resize(block_first.back());
  parallelFor(cells, grain, threads_, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      const auto& place = places_[i];
      all.first[i] += block_first[begin / grain];
      copy(edgesOf(parts_[place.part], place.entry), all.neighbor.data() + all.first[i]);
    }
  });
  return all;
}

Neighborhoods Gathering::finish() const {
  return finishWith(
      [](std::span<const std::int32_t> row, std::int32_t* out) { std::copy(row.begin(), row.end(), out); });
}

Neighborhoods Gathering::finishFromFirst(const SiteSet& sites) const {
  return finishWith(
      [&](std::span<const std::int32_t> row, std::int32_t* out) { copyFromFirst(sites, row, out); });
}

}  // namespace vorpipe
