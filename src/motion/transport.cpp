#include <cmath>
#include <utility>

#include "base/block_sums.h"
#include "base/refusal.h"
#include "base/try.h"
#include "motion/density_levels.h"
#include "motion/memory_order.h"
#include "motion/movable.h"
#include "motion/start_weights.h"
#include "motion/targets.h"
#include "vorpipe.h"
#include "vorpipe/masses.h"

namespace vorpipe {

using namespace moving;

namespace {

CellsOptions cellsOptions(const TransportOptions& options) {
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.outline = options.outline;
  cells.periodic = options.periodic;
  cells.density = options.density;
  cells.search = options.search;
  cells.progress = options.progress;
  return cells;
}

double costOf(const Sites& sites, const CellMoments& cells, int threads) {
  return carefulSum(sites.size(), threads, [&](std::size_t i) {
    const double dx = cells.centroid[i].x - sites.x[i], dy = cells.centroid[i].y - sites.y[i];
    return cells.spread[i] + cells.mass[i] * (dx * dx + dy * dy);
  });
}

template <class Value>
std::vector<Value> back(const std::vector<std::uint32_t>& order, const std::vector<Value>& values) {
  std::vector<Value> to(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) to[order[k]] = values[k];
  return to;
}

CellMoments back(const std::vector<std::uint32_t>& order, const CellMoments& cells) {
  return {back(order, cells.status), back(order, cells.area), back(order, cells.mass),
          back(order, cells.centroid), back(order, cells.spread)};
}

}  // namespace

Result<Transported> transport(Session& session, Sites sites, const TransportOptions& options,
                              const TransportWatcher& watcher) {
  const CellsOptions cells = cellsOptions(options);
  VORPIPE_TRY(checkTolerance(options.tolerance));
  VORPIPE_TRY(checkMovable(sites, cells, session.threads()));
  auto places = options.periodic == Periodic::none
                    ? Result<Sites>(std::move(sites))
                    : wrapped(sites, options.domain, options.periodic, session.threads());
  if (!places) return tl::unexpected(std::move(places.error()));
  VORPIPE_TRY(checkPlaces(*places, options.domain, options.periodic));
  const auto whole = massOfDomain(session, options);
  if (!whole) return tl::unexpected(whole.error());
  const auto targets = targetsOf(options, places->size(), *whole);
  if (!targets) return tl::unexpected(targets.error());
  const auto order = memoryOrder(*places, options.domain);
  std::vector<double> ordered(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) ordered[k] = (*targets)[order[k]];
  Sites at = inOrder(*places, order);
  if (options.surface == Surface::none && !at.weight.empty()) centerWeights(at.weight, session.threads());
  auto reached = reachWeights(session, cells, options.surface, ordered, at,
                              {options.tolerance, options.diagrams}, watcher);
  if (!reached) return tl::unexpected(std::move(reached.error()));
  Transported done;
  done.end = reached->end;
  done.trace = std::move(reached->trace);
  done.report = reached->cells.cells().report();
  if (reached->cells.areMeasured()) {
    const CellMoments& moments = reached->cells.cells().moments();
    done.cost = costOf(at, moments, session.threads());
    done.cells = back(order, moments);
  }
  // Along periodic axes places are rounded; sites keep the caller's places.
  done.sites = std::move(options.periodic == Periodic::none ? *places : sites);
  done.sites.weight = back(order, at.weight);
  return done;
}

}  // namespace vorpipe
