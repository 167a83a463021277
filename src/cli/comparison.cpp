#include "cli/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/try.h"
#include "cli/stats.h"
#include "io/base/extension.h"
#include "io/base/field_text.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t differentStatuses(const Rendering& a, const Rendering& b) {
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < a.status.size(); ++i) {
    if (a.status[i] != b.status[i] || a.owner[i] != b.owner[i]) ++different;
  }
  return different;
}

std::string pairName(const Comparison& comparison, const PairDiff& pair) {
  return fmt::format("{} / {}", comparison.nameOf(pair.a), comparison.nameOf(pair.b));
}

Json runJson(const BackendRun& run, bool times) {
  const Report &picture = run.rendering.report, &cells = run.cells.report;
  Json json = {{"name", run.name},
               {"backend", picture.backend},
               {"device", picture.device},
               {"driver", picture.driver},
               {"status", {{"ok", cells.ok}, {"empty", cells.empty}, {"duplicate", cells.duplicate}}},
               {"resolved", resolvedJson(picture)},
               {"cells_resolved", resolvedJson(cells)}};
  if (times) json.update({{"render_ms", run.render_ms}, {"cells_ms", run.cells_ms}});
  return json;
}

Json siteJson(const CellDifference& site) {
  return {{"site", site.site}, {"status", site.status}, {"neighbors", site.neighbors},
          {"area", site.area}, {"area_a", site.area_a}, {"area_b", site.area_b}};
}

Json cellsJson(const Comparison& comparison, const PairDiff& pair) {
  if (!pair.cells) return nullptr;
  const CellsDiff& diff = *pair.cells;
  Json first = Json::array();
  for (const CellDifference& site : diff.first) first.push_back(siteJson(site));
  return {{"agree", diff.agree()},
          {"equal", diff.equal},
          {"different_statuses", diff.statuses},
          {"different_neighbors", diff.neighbors},
          {"different_areas", diff.areas},
          {"worst_area",
           {{"site", diff.worst_site},
            {"area_a", comparison.runs[pair.a].cells.area[diff.worst_site]},
            {"area_b", comparison.runs[pair.b].cells.area[diff.worst_site]},
            {"of_allowed", diff.worst_area}}},
          {"first", std::move(first)}};
}

std::string cellsText(const CellsDiff& diff) {
  const CellDifference& first = diff.first.front();
  const std::string what = first.status      ? "its status or owner"
                           : first.neighbors ? "its neighbors"
                                             : fmt::format("its area, {} and {}", first.area_a, first.area_b);
  return fmt::format("cells differ (status of {}, neighbors of {}, area of {} sites), first site {} in {}",
                     diff.statuses, diff.neighbors, diff.areas, first.site, what);
}

std::string pairText(const PairDiff& pair) {
  std::vector<std::string> parts;
  if (!pair.pixels.agree()) parts.push_back(disagreementText(pair.pixels));
  if (pair.cells && !pair.cells->agree()) parts.push_back(cellsText(*pair.cells));
  if (parts.empty()) parts.push_back(fmt::format("{} statuses in the pictures", pair.statuses));
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// Adds a run's counters and times; a stage that no run had stays negative.
void addRun(const Report& run, Report& sum) {
  sum.retried += run.retried;
  sum.in_double += run.in_double;
  sum.exact += run.exact;
  sum.pixels += run.pixels;
  sum.pipelines.insert(sum.pipelines.end(), run.pipelines.begin(), run.pipelines.end());
  for (const auto stage :
       {&Times::order, &Times::upload, &Times::search, &Times::cells, &Times::draw, &Times::download}) {
    const double ms = run.time_ms.*stage;
    double& to = sum.time_ms.*stage;
    if (ms >= 0) to = std::max(to, 0.0) + ms;
  }
}

/// Returns the ids of a picture in the colors of `drawn`: each pixel has that of a pixel of `drawn`, the same
/// or one beside, that has its color, or no_site.
std::vector<std::uint32_t> idsOfColors(const Image& picture, const Image& drawn) {
  std::vector<std::uint32_t> ids(picture.rgba.size(), no_site);
  const auto at = [&](int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(drawn.width) +
           static_cast<std::size_t>(column);
  };
  for (int row = 0; row < drawn.height; ++row) {
    for (int column = 0; column < drawn.width; ++column) {
      const std::size_t here = at(row, column);
      const auto take = [&](std::size_t from) {
        const bool same = drawn.rgba[from] == picture.rgba[here];
        if (same) ids[here] = drawn.ids[from];
        return same;
      };
      // Beside a pixel of the border are those of the opposite one: periodic domains go on there.
      bool found = take(here);
      for (int r = row + drawn.height - 1; r <= row + drawn.height + 1 && !found; ++r) {
        for (int c = column + drawn.width - 1; c <= column + drawn.width + 1 && !found; ++c) {
          found = take(at(r % drawn.height, c % drawn.width));
        }
      }
    }
  }
  return ids;
}

Result<PairDiff> compareWith(const Reference& reference, const Comparison& comparison, std::size_t run,
                             const Input& input, const RenderOptions& options) {
  const Image& drawn = comparison.runs[run].rendering.image;
  const bool colors = reference.image.ids.empty();
  const std::vector<std::uint32_t> found =
      colors ? idsOfColors(reference.image, drawn) : std::vector<std::uint32_t>{};
  const std::span<const std::uint32_t> ids = colors ? found : reference.image.ids;
  VORPIPE_VAR(pixels, diffIds(drawn.ids, ids, input.sites, options));
  Result<PairDiff> pair{tl::in_place};
  pair->a = run;
  pair->b = comparison.runs.size();
  pair->pixels = std::move(pixels);
  return pair;
}

Json referenceJson(const std::optional<Reference>& reference) {
  if (!reference) return nullptr;
  return {{"file", reference->path}, {"kind", reference->image.ids.empty() ? "picture" : "ids"}};
}

/// Adds a name to a list unless it is there already.
void addName(const std::string& name, std::string& list) {
  if (list.empty()) {
    list = name;
  } else if (list.find(name) == std::string::npos) {
    list += ", " + name;
  }
}

}  // namespace

Report reportOf(const Comparison& comparison) {
  const Report& first = comparison.runs.front().cells.report;
  Report sum;
  sum.ok = first.ok;
  sum.empty = first.empty;
  sum.duplicate = first.duplicate;
  sum.hidden = first.hidden;
  for (const BackendRun& run : comparison.runs) {
    addRun(run.rendering.report, sum);
    addRun(run.cells.report, sum);
    sum.backend += (sum.backend.empty() ? "" : ", ") + run.name;
    addName(run.cells.report.device, sum.device);
    addName(run.cells.report.driver, sum.driver);
  }
  return sum;
}

std::string choiceOf(std::span<const BackendRun> runs) {
  std::vector<std::string> choices;
  for (const BackendRun& run : runs)
    if (!run.choice.empty()) choices.push_back(run.choice);
  return fmt::to_string(fmt::join(choices, "; "));
}

Result<Reference> readReference(const std::string& path) {
  VORPIPE_VAR(image, lowerExtension(path) == ".npy" ? readNpyIds(path) : readPng(path));
  return Reference{path, std::move(image)};
}

Result<void> comparePairs(Comparison& comparison, const Input& input, const RenderOptions& options) {
  const auto& runs = comparison.runs;
  for (std::size_t a = 0; a < runs.size(); ++a) {
    for (std::size_t b = a + 1; b < runs.size(); ++b) {
      const Rendering &left = runs[a].rendering, &right = runs[b].rendering;
      VORPIPE_VAR(pixels, diffIds(left.image.ids, right.image.ids, input.sites, options));
      VORPIPE_VAR(cells, diffCells(runs[a].cells, runs[b].cells));
      comparison.pairs.push_back({a, b, std::move(pixels), differentStatuses(left, right), std::move(cells)});
    }
  }
  if (!comparison.reference) return {};
  for (std::size_t run = 0; run < runs.size(); ++run) {
    VORPIPE_VAR(pair, compareWith(*comparison.reference, comparison, run, input, options));
    comparison.pairs.push_back(std::move(pair));
  }
  return {};
}

std::string comparisonTable(const Comparison& comparison) {
  std::size_t column = std::string_view("backend").size();
  const std::size_t members = comparison.runs.size() + (comparison.reference ? 1 : 0);
  for (std::size_t i = 0; i < members; ++i) column = std::max(column, comparison.nameOf(i).size());
  for (const PairDiff& pair : comparison.pairs) column = std::max(column, pairName(comparison, pair).size());
  std::string text =
      fmt::format("{:<{}}  {:>10}  {:>10}  {}\n", "backend", column, "picture s", "cells s", "device");
  for (const BackendRun& run : comparison.runs) {
    text += fmt::format("{:<{}}  {:>10.3f}  {:>10.3f}  {}\n", run.name, column, run.render_ms / 1000,
                        run.cells_ms / 1000, run.rendering.report.device);
  }
  if (comparison.reference) {
    text +=
        fmt::format("{:<{}}  {:>10}  {:>10}  the reference\n", comparison.reference->path, column, "-", "-");
  }
  constexpr auto row = "{:<{}}  {:>10}  {:>10}  {:>10}  {:>10}  {:>10}\n";
  text +=
      fmt::format(fmt::runtime(row), "pixels", column, "equal", "on edges", "at most", "wrong", "statuses");
  for (const PairDiff& pair : comparison.pairs) {
    const IdDiff& diff = pair.pixels;
    text += fmt::format(fmt::runtime(row), pairName(comparison, pair), column, diff.equal, diff.ties,
                        diff.ties_allowed, diff.wrong, pair.cells ? std::to_string(pair.statuses) : "-");
  }
  text +=
      "(on edges: a pixel whose center lies on an edge may go to either cell; so many did, and at most so "
      "many could)\n";
  if (comparison.runs.size() < 2) return text;
  text += fmt::format(fmt::runtime(row), "cells", column, "equal", "statuses", "neighbors", "areas",
                      "worst area");
  for (const PairDiff& pair : comparison.pairs) {
    if (!pair.cells) continue;
    const CellsDiff& diff = *pair.cells;
    text += fmt::format(fmt::runtime(row), pairName(comparison, pair), column, diff.equal, diff.statuses,
                        diff.neighbors, diff.areas, fmt::format("{:.2g}", diff.worst_area));
  }
  return text + "(worst area: the largest difference, as a part of what is allowed)\n";
}

std::string disagreementText(const Comparison& comparison) {
  const auto& pairs = comparison.pairs;
  const auto bad = std::ranges::find_if_not(pairs, &PairDiff::agree);
  if (bad == pairs.end()) return {};
  const auto all = std::ranges::count_if(pairs, [](const PairDiff& pair) { return !pair.agree(); });
  const std::string more = all > 1 ? fmt::format(" (the first of {} pairs that differ)", all) : "";
  return fmt::format("{} and {} differ: {}{}", comparison.nameOf(bad->a), comparison.nameOf(bad->b),
                     pairText(*bad), more);
}

std::string comparisonJson(const Comparison& comparison, const Input& input, bool times) {
  const Image& image = comparison.runs.front().rendering.image;
  const Box& domain = input.domain;
  Json json;
  json["version"] = version();
  json["command"] = "compare";
  json["sites"] = input.sites.size();
  json["seed"] = input.seed ? Json(*input.seed) : Json(nullptr);
  json["domain"] = {domain.xmin, domain.ymin, domain.xmax, domain.ymax};
  addShape(json, input);
  json["size"] = {image.width, image.height};
  json["tie_distance_px"] = tie_distance;
  json["area_slack"] = {{"of_cell", area_slack_of_cell}, {"of_mean_cell", area_slack_of_mean}};
  json["backends"] = Json::array();
  for (const BackendRun& run : comparison.runs) json["backends"].push_back(runJson(run, times));
  json["reference"] = referenceJson(comparison.reference);
  json["pairs"] = Json::array();
  for (const PairDiff& pair : comparison.pairs) {
    Json entry = {
        {"a", comparison.nameOf(pair.a)}, {"b", comparison.nameOf(pair.b)}, {"agree", pair.agree()}};
    entry.update(diffJson(pair.pixels));
    entry["different_statuses"] = pair.cells ? Json(pair.statuses) : Json(nullptr);
    entry["cells"] = cellsJson(comparison, pair);
    json["pairs"].push_back(std::move(entry));
  }
  return jsonText(json, 2);
}

}  // namespace vorpipe::cli
