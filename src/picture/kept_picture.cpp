#include "picture/kept_picture.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/inside.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "domain/edge_tree.h"
#include "picture/palette.h"
#include "sites/bin_sort.h"
#include "sites/images.h"
#include "sites/weights.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t kept_picture_grain = 1 << 12;

/// Whether all sites lie in the domain and inside the outline. Then each position has a cell that the outline
/// does not remove entirely.
bool areInside(const Sites& sites, const Box& domain, const Rings& rings, int exponent, int threads) {
  const OutlineIndex index(rings);
  const PowerOfTwo scale(exponent);
  std::atomic<bool> all = true;
  parallelFor(sites.size(), kept_picture_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end && all; ++i) {
      const double x = sites.x[i], y = sites.y[i];
      if (!isInside(domain, x, y) || !index.contains({scale(x), scale(y)})) all = false;
    }
  });
  return all;
}

/// Prepares sites only.
Result<FoundCells> prepareSites(const Machine& machine, const Sites& sites, const RenderOptions& options) {
  const Stopwatch watch;
  FoundCells found;
  VORPIPE_VAR(scene, sceneOf(sites, options, machine.threads));
  found.scene = std::move(scene);
  const CallersSites callers{sites, [&](std::uint32_t i) { return found.scene.siteOf(i); },
                             found.scene.picture};
  VORPIPE_VAR(run, beginRun(machine, found.scene.sitesOr(sites), found.scene.clip, &callers));
  found.run = std::move(run);
  found.diagram.report.time_ms.order = 1e3 * watch.seconds();
  return found;
}

/// Returns which sites of a set have no cell, according to `cells`. A device cannot distinguish a very small
/// cell of a weighted site from an empty one.
std::vector<std::uint8_t> hiddenSites(const SiteSet& set, const Scene& scene, const Diagram& cells) {
  if (set.weight.empty()) return {};
  std::vector<std::uint8_t> hidden(set.size());
  std::transform(set.id.begin(), set.id.end(), hidden.begin(), [&](std::uint32_t id) {
    return cells.status[scene.siteOf(id)] == Status::empty ? std::uint8_t{1} : std::uint8_t{0};
  });
  return hidden;
}

/// Drops hidden sites: one without a cell may have an image at the end of the band that seems to have one.
void dropHidden(const std::vector<std::uint8_t>& hidden, NeighborRows& cells) {
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    if (hidden[i] != 0) cells.drop(i, CellStatus::empty);
  }
}

bool areSame(const KeptPicture::Colors& colors, const RenderOptions& options) {
  const bool same_range = colors.range.has_value() == options.color_range.has_value() &&
                          (!colors.range || (colors.range->low == options.color_range->low &&
                                             colors.range->high == options.color_range->high));
  return colors.by == options.color && colors.scale == options.color_scale && same_range &&
         colors.legend == options.legend && colors.values == options.values &&
         colors.own_colors == options.colors.size();
}

}  // namespace

Result<bool> needsCells(const Sites& sites, const RenderOptions& options, int threads) {
  if (colorsNeedCells(options.color) || hasWeights(sites)) return true;
  if (options.outline.empty()) return false;
  const int exponent = scaleExponent(options.domain);
  VORPIPE_LET(rings, ringsOf(options.outline, exponent));
  return !areInside(sites, options.domain, rings, exponent, threads);
}

Result<KeptPicture> findPicture(const Machine& machine, const Sites& sites, const RenderOptions& options,
                                bool with_cells) {
  VORPIPE_VAR(rings, ringsOf(options.outline, scaleExponent(options.domain)));
  CellsOptions cells = cellsOptions(options);
  cells.detail = marksDetail(options);
  VORPIPE_VAR(found, with_cells ? findCells(machine, sites, cells, ImagesFor::pictures)
                                : prepareSites(machine, sites, options));
  KeptPicture kept{std::move(rings), std::move(found), {}};
  kept.before.held.uploads = machine.uploads;
  SiteRun& run = *kept.found.run;
  if (run.cells) {
    SiteSet& set = run.prepared.set;
    set.hidden = hiddenSites(set, kept.found.scene, kept.found.diagram);
    kept.before.known = std::exchange(run.cells, std::nullopt);
    dropHidden(set.hidden, *kept.before.known);
  }
  return kept;
}

Result<void> colorPicture(const Sites& sites, const RenderOptions& options, int threads, KeptPicture& kept) {
  if (kept.colors && areSame(*kept.colors, options)) return {};
  VORPIPE_VAR(found, paletteIndices(sites, kept.found.diagram, options, threads));
  const SiteSet& set = kept.found.run->prepared.set;
  std::vector<std::uint8_t> indices(set.size());
  std::ranges::transform(set.id, indices.begin(),
                         [&](std::uint32_t id) { return found.index[kept.found.scene.siteOf(id)]; });
  const bool same = kept.colors && kept.colors->index == indices;
  if (!same) kept.before.held.after.reset();
  kept.colors =
      KeptPicture::Colors{options.color,  options.color_scale,   options.color_range, options.legend,
                          options.values, options.colors.size(), std::move(indices),  std::move(found.key)};
  return {};
}

}  // namespace vorpipe::core
