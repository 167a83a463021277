/// A few sites anywhere: the shared cell function, the judge and whole runs against brute force in rational
/// numbers.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "backend/cpu/exact_tier.h"
#include "backend/cpu/grid_cells.h"
#include "byte_stream.h"
#include "cells/device_ladder.h"
#include "session.h"
#include "sites/site_set.h"
#include "target.h"
#include "unit/fixtures/brute_force.h"

namespace vorpipe::fuzz {
namespace {

constexpr std::size_t most_sites = 9;
/// Squares of lengths, as parts of the squared distance of two sites: shorter edges are ties; a length may be
/// unsure by a twentieth of that.
constexpr double tie = 1e-12, surely_longer = 1.3e-12;

struct Input {
  Sites sites;
  Box domain{0, 0, 1, 1};
};

Input inputIn(std::string_view bytes) {
  ByteStream stream(bytes);
  Input input;
  const bool weighted = stream.flag();
  if (stream.flag()) {
    input.domain.xmin = stream.number();
    input.domain.ymin = stream.number();
    input.domain.xmax = stream.number();
    input.domain.ymax = stream.number();
  }
  while (!stream.atEnd() && input.sites.size() < most_sites) {
    input.sites.x.push_back(stream.number());
    input.sites.y.push_back(stream.number());
    if (weighted) input.sites.weight.push_back(stream.number());
  }
  return input;
}

struct Entry {
  CellStatus status;
  std::set<std::int32_t> neighbors;
};

Entry entryOf(const CellNeighbors& cells, std::size_t k) {
  const auto begin = cells.neighbor.begin();
  return {cells.status[k],
          {begin + static_cast<std::ptrdiff_t>(cells.offsets[k]),
           begin + static_cast<std::ptrdiff_t>(cells.offsets[k + 1])}};
}

/// Whether the edge of a cell to a neighbor lies in one of these walls but for what 100 bits round off: then
/// the wall may stand for it, and core has the cells on both sides agree.
bool liesInWall(const SiteSet& set, std::uint32_t site, std::int32_t neighbor,
                const std::set<std::int32_t>& found) {
  constexpr double hair = 0x1p-90;
  std::vector<std::int32_t> others(set.size());
  std::iota(others.begin(), others.end(), 0);
  others.erase(others.begin() + site);
  const RationalCell cell = cellByBruteForce(set, site, others);
  const auto edge = std::ranges::find(cell.neighbor, neighbor) - cell.neighbor.begin();
  const auto& begin = cell.corner[static_cast<std::size_t>(edge)];
  const auto& end = cell.corner[static_cast<std::size_t>(edge + 1) % cell.corner.size()];
  const auto isAt = [&](double wall, const Rational& from, const Rational& to) {
    return abs(from - Rational(wall)) < hair && abs(to - Rational(wall)) < hair;
  };
  return (found.contains(-1) && isAt(set.domain.xmin, begin.x, end.x)) ||
         (found.contains(-2) && isAt(set.domain.xmax, begin.x, end.x)) ||
         (found.contains(-3) && isAt(set.domain.ymin, begin.y, end.y)) ||
         (found.contains(-4) && isAt(set.domain.ymax, begin.y, end.y));
}

/// A cell that double or exact arithmetic decided, beside its edges by brute force.
void requireRight(const SiteSet& set, std::uint32_t site, const Entry& found) {
  if (found.status == CellStatus::open) return;
  const auto edges = edgesByBruteForce(set, site);
  const auto counting = std::ranges::count_if(edges, [](const auto& edge) { return edge.second > tie; });
  // One whose edges are all ties may be either: core leaves it out.
  if (edges.empty()) return require(found.status == CellStatus::empty, "a cell without edges is empty");
  if (found.status == CellStatus::empty)
    return require(counting < 3, "a cell with three edges or more is not empty");
  for (const auto& [neighbor, ratio] : edges)
    require(!(ratio > surely_longer) || found.neighbors.contains(neighbor) ||
                liesInWall(set, site, neighbor, found.neighbors),
            "a cell has each of its neighbors");
  for (const std::int32_t neighbor : found.neighbors)
    require(edges.contains(neighbor), "a cell has no neighbor but its own");
}

/// Whether float tells sites apart well: then the shared function, in float, has every edge that is not
/// short.
bool isEasy(const SiteSet& set) {
  constexpr double apart = 1.0 / 256, farthest = 4, heaviest = 1;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (!(std::abs(set.x[i] - set.domain.xmin) < farthest && std::abs(set.y[i] - set.domain.ymin) < farthest))
      return false;
    if (!set.weight.empty() && !(std::abs(set.weight[i]) < heaviest)) return false;
    for (std::size_t j = 0; j < i; ++j)
      if (std::hypot(set.x[i] - set.x[j], set.y[i] - set.y[j]) < apart) return false;
  }
  return std::min(set.domain.xmax - set.domain.xmin, set.domain.ymax - set.domain.ymin) > apart;
}

double areaOf(const RationalCell& cell) {
  Rational twice = 0;
  for (std::size_t k = 0; k < cell.corner.size(); ++k) {
    const auto& p = cell.corner[k];
    const auto& q = cell.corner[(k + 1) % cell.corner.size()];
    twice += p.x * q.y - p.y * q.x;
  }
  return static_cast<double>(twice) / 2;
}

/// What a device proposes. It is no promise: core compares it with the cells around. But the neighbors of
/// easy cells leave what all sites together do.
void requireProposed(const SiteSet& set, std::uint32_t site, const Entry& found) {
  constexpr double little = 1e-4;
  if (found.status != CellStatus::certified) return;
  for (const std::int32_t neighbor : found.neighbors) {
    require(neighbor >= -4 && neighbor < static_cast<std::int32_t>(set.size()),
            "neighbors are sites or walls");
    require(neighbor != static_cast<std::int32_t>(site), "a site is not its own neighbor");
  }
  if (!isEasy(set)) return;
  std::vector<std::int32_t> others;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (i != site) others.push_back(static_cast<std::int32_t>(i));
  const std::vector<std::int32_t> proposed(found.neighbors.begin(), found.neighbors.end());
  const double right = areaOf(cellByBruteForce(set, site, others));
  require(areaOf(cellByBruteForce(set, site, proposed)) - right < little,
          "a proposed cell is no larger than it is");
}

}  // namespace

void fuzzJudge(std::string_view bytes) {
  const Input input = inputIn(bytes);
  const auto prepared = core::prepare(input.sites, input.domain, 1);
  if (!prepared) return require(prepared.error().code == ErrorCode::input, "bad sites are an input error");
  const SiteSet& set = prepared->set;
  std::vector<std::uint32_t> all(set.size());
  std::iota(all.begin(), all.end(), 0u);
  const auto tier = makeExactTier(1);
  tier->take(set);
  for (const Precision precision : {Precision::in_double, Precision::exact}) {
    CellNeighbors cells;
    tier->cells(all, precision, cells);
    for (const std::uint32_t site : all) {
      const Entry found = entryOf(cells, site);
      require(precision == Precision::in_double || found.status != CellStatus::open,
              "exactly each is decided");
      requireRight(set, site, found);
    }
  }
  // Devices are asked for no others: far from the domain float is too coarse, or has no squares.
  const std::vector<std::uint32_t> asked = core::sortOut(set, 1).inside;
  for (const Capacity capacity : {Capacity::small, Capacity::large}) {
    CellNeighbors cells;
    cpu::findOnGrid(set, asked, capacity, 1, cells);
    for (std::size_t k = 0; k < asked.size(); ++k) requireProposed(set, asked[k], entryOf(cells, k));
  }
}

void fuzzCells(std::string_view bytes) {
  Input input = inputIn(bytes);
  CellsOptions options{};
  options.domain = input.domain;
  options.search.method = Search::grid;
  options.periodic = static_cast<Periodic>(bytes.size() % 8 < 4 ? bytes.size() % 4 : 0);
  const auto diagram = session().cells(input.sites, options);
  if (!diagram) return require(diagram.error().code == ErrorCode::input, diagram.error().message);
  const auto broken = check(input.sites, options, *diagram, 1);
  require(broken.has_value(), "cells can be checked");
  require(broken->empty(), broken->empty() ? "" : broken->front());
}

}  // namespace vorpipe::fuzz
