#include "session/box_moments.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/diagram_writer.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t box_moments_grain = 1 << 14;

void countStatus(Status status, Report& report) {
  ++(status == Status::ok ? report.ok : status == Status::empty ? report.empty : report.duplicate);
}

/// Fills the moments except the spread, which is there already. The centroid of a site without a cell is the
/// site, equal to the caller's to the last bit.
void takeMoments(const Sites& sites, std::span<const CellRecord> records, int threads, CellMoments& moments) {
  const auto count = records.size();
  moments.status.resize(count);
  moments.area.resize(count);
  moments.mass.resize(count);
  moments.centroid.resize(count);
  parallelEach(count, box_moments_grain, threads, [&](std::size_t i) {
    const CellRecord& record = records[i];
    const bool is_cell = record.status == Status::ok;
    moments.status[i] = record.status;
    moments.area[i] = moments.mass[i] = record.area;
    moments.centroid[i] = is_cell ? record.centroid : Point{sites.x[i], sites.y[i]};
    if (!is_cell) moments.spread[i] = 0;
  });
}

}  // namespace

Result<Report> findMoments(const Machine& machine, const Sites& sites, const CellsOptions& options,
                           AtEmpty at_empty, FoundBox& found, CellMoments& moments) {
  Report report;
  Times& times = report.time_ms;
  const Stopwatch order_watch;
  found = {};
  VORPIPE_VAR(run, beginRun(machine, sites, options.domain));
  found.run = std::move(run);
  times.order = 1e3 * order_watch.seconds();
  const Stopwatch watch;
  moments.spread.resize(sites.size());
  VORPIPE_VAR(cells, agreeOnCells(machine, *found.run, sites, options, at_empty, moments.spread, report));
  found.cells = std::move(cells);
  nameDevice(machine.backend, report);
  if (!found.cells) return report;
  takeMoments(sites, found.cells->records, machine.threads, moments);
  for (const Status status : moments.status) countStatus(status, report);
  if (!found.run->prepared.set.weight.empty()) report.hidden = report.empty;
  times.cells = 1e3 * watch.seconds() - std::max(times.upload, 0.0) - std::max(times.search, 0.0);
  return report;
}

CellsThatMeet neighborsOf(const FoundBox& found, int threads) {
  Diagram diagram;
  takeRecords(found.cells->records, Detail::measures, threads, diagram);
  const SiteSet& set = found.run->prepared.set;
  const EdgeIndex index(found.cells->rows, threads);
  const ProposedCells cells{set, found.cells->rows, index, threads};
  writeEdges(cells, found.cells->tied, Detail::measures, Unscale(found.run->prepared.exponent), diagram);
  return {std::move(diagram.cell_offsets), std::move(diagram.neighbors), {}};
}

}  // namespace vorpipe::core
