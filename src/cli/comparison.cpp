#include "cli/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/difference_text.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t differentStatuses(const std::vector<Status>& a, const std::vector<Status>& b) {
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) ++different;
  return different;
}

std::string pairName(const Comparison& comparison, const PairDiff& pair) {
  return fmt::format("{} / {}", comparison.runs[pair.a].name, comparison.runs[pair.b].name);
}

Json runJson(const BackendRun& run) {
  const Report& report = run.rendering.report;
  return {{"name", run.name},
          {"backend", report.backend},
          {"device", report.device},
          {"driver", report.driver},
          {"status", {{"ok", report.ok}, {"empty", report.empty}, {"duplicate", report.duplicate}}},
          {"resolved", {{"retried", report.retried}, {"double", report.in_double}, {"exact", report.exact}}},
          {"render_ms", run.render_ms}};
}

}  // namespace

Result<std::vector<PairDiff>> comparePairs(const std::vector<BackendRun>& runs, const Input& input) {
  std::vector<PairDiff> pairs;
  for (std::size_t a = 0; a < runs.size(); ++a) {
    for (std::size_t b = a + 1; b < runs.size(); ++b) {
      const Rendering &left = runs[a].rendering, &right = runs[b].rendering;
      auto diff = diffIds(left.image.ids, right.image.ids, left.image.width, left.image.height, input.sites,
                          input.domain);
      if (!diff) return tl::unexpected(std::move(diff.error()));
      pairs.push_back({a, b, std::move(*diff), differentStatuses(left.status, right.status)});
    }
  }
  return pairs;
}

std::string comparisonTable(const Comparison& comparison) {
  std::size_t column = 4;
  for (const BackendRun& run : comparison.runs) column = std::max(column, run.name.size());
  for (const PairDiff& pair : comparison.pairs) column = std::max(column, pairName(comparison, pair).size());
  std::string text = fmt::format("{:<{}}  {:>9}  {}\n", "backend", column, "seconds", "device");
  for (const BackendRun& run : comparison.runs) {
    text += fmt::format("{:<{}}  {:>9.3f}  {}\n", run.name, column, run.render_ms / 1000,
                        run.rendering.report.device);
  }
  text += fmt::format("{:<{}}  {:>12}  {:>9}  {:>9}  {:>9}  {:>9}\n", "pair", column, "pixels equal", "ties",
                      "allowed", "wrong", "statuses");
  for (const PairDiff& pair : comparison.pairs) {
    const IdDiff& diff = pair.diff;
    text += fmt::format("{:<{}}  {:>12}  {:>9}  {:>9}  {:>9}  {:>9}\n", pairName(comparison, pair), column,
                        diff.equal, diff.ties, diff.ties_allowed, diff.wrong, pair.statuses);
  }
  return text;
}

std::string comparisonJson(const Comparison& comparison, const Input& input) {
  const Image& image = comparison.runs.front().rendering.image;
  const Box& domain = input.domain;
  Json json;
  json["version"] = version();
  json["command"] = "compare";
  json["sites"] = input.sites.size();
  json["seed"] = input.seed ? Json(*input.seed) : Json(nullptr);
  json["domain"] = {domain.xmin, domain.ymin, domain.xmax, domain.ymax};
  json["size"] = {image.width, image.height};
  json["tie_distance_px"] = tie_distance;
  json["backends"] = Json::array();
  for (const BackendRun& run : comparison.runs) json["backends"].push_back(runJson(run));
  json["pairs"] = Json::array();
  for (const PairDiff& pair : comparison.pairs) {
    Json entry = {{"a", comparison.runs[pair.a].name},
                  {"b", comparison.runs[pair.b].name},
                  {"agree", pair.diff.agree()}};
    entry.update(diffJson(pair.diff));
    entry["different_statuses"] = pair.statuses;
    json["pairs"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Picture comparisonMontage(const Comparison& comparison) {
  const Image& image = comparison.runs.front().rendering.image;
  const auto columns = static_cast<int>(std::max(comparison.runs.size(), comparison.pairs.size()));
  Picture montage{columns * image.width, 2 * image.height, {}};
  montage.rgba.resize(static_cast<std::size_t>(montage.width) * static_cast<std::size_t>(montage.height),
                      0xFFFFFFFFu);
  int column = 0;
  for (const BackendRun& run : comparison.runs) {
    paste(montage, Picture{image.width, image.height, run.rendering.image.rgba}, 0, column);
    column += image.width;
  }
  column = 0;
  for (const PairDiff& pair : comparison.pairs) {
    Picture marked = grayOfIds(comparison.runs[pair.a].rendering.image.ids, image.width, image.height);
    markDifferences(marked, pair.diff.pixels);
    paste(montage, marked, image.height, column);
    column += image.width;
  }
  return montage;
}

}  // namespace vorpipe::cli
