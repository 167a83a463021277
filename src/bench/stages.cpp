#include <fmt/core.h>

#include <algorithm>

#include "base/try.h"
#include "bench/tables.h"

namespace vorpipe::bench {
namespace {

constexpr int usual_side = 1000;

struct Kind {
  std::string what;
  int side;
  SearchOptions search;
  Detail detail;
};

using Outcomes = std::vector<std::pair<std::string, const Outcome*>>;  ///< with the kind's name

std::vector<Column> columnsOf(const std::string& unit) {
  std::vector<Column> columns = {{"backend", "backend"}, {"job", "job"}};
  for (const char* name : stage_names) columns.push_back({name, fmt::format("{}{}", name, unit)});
  return columns;
}

Samples milliseconds(Samples seconds) {
  for (double& sample : seconds) sample *= 1e3;
  return seconds;
}

Table hostTable(const Outcomes& outcomes, const std::string& title) {
  Table table{"stages_host", title, columnsOf(", ms")};
  table.columns.push_back({"whole", "whole, ms"});
  table.columns.push_back({"cpu", "CPU, ms"});
  for (const auto& [kind, outcome] : outcomes) {
    std::vector<Cell> row = {outcome->job.backend, kind};
    for (std::size_t stage = 0; stage < stage_count; ++stage) {
      const Samples& samples = outcome->stages[stage];
      const bool some = std::ranges::any_of(samples, [](double seconds) { return seconds > 0; });
      row.push_back(some ? Cell(milliseconds(samples)) : Cell(Missing{}));
    }
    row.push_back(figure(*outcome, milliseconds(outcome->seconds)));
    row.push_back(outcome->measured() ? Cell(milliseconds(outcome->cpu_seconds)) : Cell(Missing{}));
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      "order: check, scale, sort into bins. search: FLANN; the walk over the grid is part of clip or draw. "
      "clip: cells found on the device, and their neighbors handed back. draw: clipped and drawn in one. "
      "download: pixels read back; `cpu` finds them only then. resolve: what the device left to the judge. "
      "rest: on the host, cells that take an exact mesh; cells made to agree, measured and put in order; "
      "lists packed; pictures put together."};
  return table;
}

Table bytesTable(const Outcomes& outcomes) {
  Table table{"stages_bytes",
              "Stages: megabytes to and from the backend",
              {{"backend", "backend"},
               {"job", "job"},
               {"upload_sent", "upload, to"},
               {"clip_sent", "clip, to"},
               {"clip_received", "clip, from"},
               {"draw_sent", "draw, to"},
               {"draw_received", "draw, from"},
               {"download_received", "download, from"}}};
  for (const auto& [kind, outcome] : outcomes) {
    std::vector<Cell> row = {outcome->job.backend, kind};
    // Not by reference: clang lets no lambda refer to a name of a structured binding.
    const auto add = [&row, outcome = outcome](Stage stage, std::uint64_t StageWork::*bytes) {
      const StageWork& work = outcome->last[static_cast<std::size_t>(stage)];
      const bool used = outcome->measured() && work.calls > 0;
      row.push_back(used ? Cell(1e-6 * static_cast<double>(work.*bytes)) : Cell(Missing{outcome->failed}));
    };
    add(Stage::upload, &StageWork::sent);
    add(Stage::clip, &StageWork::sent);
    add(Stage::clip, &StageWork::received);
    add(Stage::draw, &StageWork::sent);
    add(Stage::draw, &StageWork::received);
    add(Stage::download, &StageWork::received);
    table.rows.push_back(std::move(row));
  }
  table.notes = {"What core hands over and gets back. `cpu` works where it lies, and moves none of it."};
  return table;
}

Table deviceTable(const Outcomes& outcomes) {
  Table table{"stages_device",
              "Stages: the device's own clock",
              {{"backend", "backend"},
               {"job", "job"},
               {"upload", "upload, ms"},
               {"clip", "clip, ms"},
               {"draw", "draw, ms"},
               {"download", "download, ms"}}};
  for (const auto& [kind, outcome] : outcomes) {
    std::vector<Cell> row = {outcome->job.backend, kind};
    for (const Stage stage : {Stage::upload, Stage::clip, Stage::draw, Stage::download}) {
      Samples samples = milliseconds(outcome->device[static_cast<std::size_t>(stage)]);
      if (samples.empty() && outcome->failed.empty()) {
        row.emplace_back(Missing{stage == Stage::upload ? "no clock: the host's above" : ""});
      } else if (outcome->measured() && median(samples) == 0) {
        row.emplace_back(Missing{});
      } else {
        row.push_back(figure(*outcome, std::move(samples)));
      }
    }
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      "By timestamps around each submission, of hardware devices through Vulkan. A software device does its "
      "work while the host waits, so that the host's clock has all of it; its timestamps have not."};
  return table;
}

}  // namespace

Result<Findings> stages(Lab& lab) {
  constexpr std::uint64_t wanted = 1'000'000;
  const std::uint64_t count = std::min<std::uint64_t>(wanted, lab.settings().max_sites);
  const int side = std::min(usual_side, lab.settings().max_side);
  const std::vector<Kind> kinds = {{"cells: measures", 0, {}, Detail::measures},
                                   {"cells: everything", 0, {}, Detail::everything},
                                   {fmt::format("picture {0} x {0}", side), side, {}, Detail::measures},
                                   {"picture, flann:30", side, {Search::flann, 30}, Detail::measures}};
  Outcomes outcomes;
  for (const Kind& kind : kinds) {
    for (const auto& backend : lab.settings().backends) {
      Job job{backend, fmt::format("random:{}", count), kind.side, kind.search};
      job.detail = kind.detail;
      outcomes.emplace_back(kind.what, &lab.plan(job));
    }
  }
  VORPIPE_TRY(lab.measure("stages"));
  Findings findings;
  findings.tables = {hostTable(outcomes, fmt::format("Stages of a run, random:{}", count)),
                     bytesTable(outcomes), deviceTable(outcomes)};
  for (auto& note : noteIfCut("--max-sites", lab.settings().max_sites, wanted))
    findings.tables.front().notes.push_back(std::move(note));
  return findings;
}

}  // namespace vorpipe::bench
