// The tables of S. Templeton, An Algorithm for Computing 2-Dimensional Voronoi Diagrams with the OpenGL
// Graphics Pipeline, Middlebury College, May 2022.
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/try.h"
#include "bench/tables.h"

namespace vorpipe::bench {
namespace {

constexpr std::uint64_t million = 1'000'000;
constexpr int usual_side = 500;
constexpr SearchOptions lists{Search::flann, 30};

/// Table 3.2: white noise, an Intel Iris Plus, neighbors on 8 threads, in seconds. Tables 3.3 to 3.5 are
/// pictures, whose figures are not in its text.
struct TheirRow {
  std::uint64_t sites;
  double device, neighbors;
};
constexpr std::array<TheirRow, 5> their_rows = {{{100, 0.00175, 8.14e-5},
                                                 {1'000, 0.00911, 3.53e-4},
                                                 {10'000, 0.0846, 0.00339},
                                                 {100'000, 0.636, 0.0430},
                                                 {million, 5.91, 0.719}}};

struct Pair {
  std::string backend;
  std::uint64_t wanted;
  const Outcome* lists;
  const Outcome* grid;
};

/// What the thesis times as its GPU part: sites and lists sent, cells clipped and drawn.
Samples devicePart(const Outcome& outcome) {
  return sumOf(outcome, {Stage::upload, Stage::clip, Stage::draw});
}

/// And as its calculation of nearest neighbors, on the host.
Samples neighborPart(const Outcome& outcome) { return sumOf(outcome, {Stage::order, Stage::search}); }

Cell device(const Outcome& outcome) {
  return figure(outcome, outcome.measured() ? devicePart(outcome) : Samples{});
}

Cell neighbors(const Outcome& outcome) {
  return outcome.measured() ? Cell(neighborPart(outcome)) : Cell(Missing{});
}

std::vector<Pair> planPattern(Lab& lab, const char* pattern, const std::vector<std::uint64_t>& sizes) {
  std::vector<Pair> pairs;
  for (const auto& backend : lab.settings().backends) {
    for (const auto size : sizes) {
      const Job job{backend, fmt::format("{}:{}", pattern, size), usual_side};
      Job by_lists = job;
      by_lists.search = lists;
      pairs.push_back({backend, size, &lab.plan(by_lists), &lab.plan(job)});
    }
  }
  return pairs;
}

Table patternTable(const std::vector<Pair>& pairs, const char* pattern, const char* title) {
  Table table{fmt::format("thesis_{}", pattern),
              fmt::format("{}; seconds, pictures of {} x {}", title, usual_side, usual_side),
              {{"backend", "backend"},
               {"sites", "sites"},
               {"flann_neighbors", "flann:30, neighbors"},
               {"flann_device", "flann:30, clip and draw"},
               {"flann_whole", "flann:30, whole"},
               {"grid_order", "grid, sort"},
               {"grid_device", "grid, search, clip and draw"},
               {"grid_whole", "grid, whole"},
               {"thesis_neighbors", "thesis, neighbors"},
               {"thesis_device", "thesis, GPU"},
               {"speed", "speed of grid, thesis = 1"}}};
  for (const auto& [backend, wanted, by_lists, by_grid] : pairs) {
    std::vector<Cell> row = {backend,
                             by_grid->sites,
                             neighbors(*by_lists),
                             device(*by_lists),
                             figure(*by_lists, by_lists->seconds),
                             neighbors(*by_grid),
                             device(*by_grid),
                             figure(*by_grid, by_grid->seconds)};
    const auto* const theirs = std::ranges::find(their_rows, wanted, &TheirRow::sites);
    if (table.name == "thesis_random" && theirs != their_rows.end()) {
      row.insert(row.end(), {theirs->neighbors, theirs->device});
      row.push_back(by_grid->measured()
                        ? Cell((theirs->neighbors + theirs->device) / median(by_grid->seconds))
                        : Cell(Missing{}));
    } else {
      row.insert(row.end(), 3, Missing{});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A backend's pictures in several sizes, by one search; side 0 draws nothing.
using Resolutions = std::vector<std::vector<const Outcome*>>;

Resolutions planResolutions(Lab& lab, std::uint64_t sites) {
  auto sides = upTo<int>({500, 1000, 2000, largest_picture}, lab.settings().max_side);
  sides.push_back(0);
  Resolutions rows;
  for (const auto& backend : lab.settings().backends) {
    for (const SearchOptions& search : {lists, SearchOptions{}}) {
      auto& row = rows.emplace_back();
      for (const int side : sides)
        row.push_back(&lab.plan({backend, fmt::format("random:{}", sites), side, search}));
    }
  }
  return rows;
}

Table resolutionTable(const Resolutions& rows, std::uint64_t sites) {
  Table table{
      "thesis_resolution",
      fmt::format("Table 3.4 of the thesis: resolutions, random:{}; seconds of the device's part", sites),
      {{"backend", "backend"}, {"search", "search"}}};
  for (const Outcome* outcome : rows.front()) {
    const int side = outcome->job.side;
    table.columns.push_back(side > 0 ? Column{fmt::format("side_{}", side), fmt::format("{0} x {0}", side)}
                                     : Column{"not_drawn", "not drawn"});
  }
  for (const auto& row : rows) {
    const Job& job = row.front()->job;
    std::vector<Cell> cells = {job.backend,
                               std::string(job.search.method == Search::flann ? "flann:30" : "grid")};
    for (const Outcome* outcome : row) cells.push_back(device(*outcome));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

struct Regular {
  std::string pattern;
  const Outcome* regular;
  const Outcome* random;
};

std::vector<Regular> planRegular(Lab& lab, const std::vector<std::uint64_t>& sizes) {
  std::vector<Regular> rows;
  for (const auto& backend : lab.settings().backends) {
    for (const auto& [name, pattern] :
         {std::pair("hex", Pattern::hex), std::pair("square", Pattern::square)}) {
      for (const auto size : sizes) {
        // As many random sites as the lattice has.
        const std::uint64_t count = generate(pattern, size, 1).size();
        rows.push_back({name, &lab.plan({backend, fmt::format("{}:{}", name, size), usual_side, lists}),
                        &lab.plan({backend, fmt::format("random:{}", count), usual_side, lists})});
      }
    }
  }
  return rows;
}

Table regularTable(const std::vector<Regular>& rows) {
  Table table{
      "thesis_regular",
      "Table 3.5 of the thesis: lattices and as many random sites; seconds of the device's part, flann:30",
      {{"backend", "backend"},
       {"pattern", "lattice"},
       {"sites", "sites"},
       {"regular", "lattice"},
       {"random", "random"},
       {"ratio", "random, lattice = 1"}}};
  for (const auto& [pattern, regular, random] : rows) {
    const bool both = regular->measured() && random->measured();
    table.rows.push_back(
        {regular->job.backend, pattern, regular->sites, device(*regular), device(*random),
         both ? Cell(median(devicePart(*random)) / median(devicePart(*regular))) : Cell(Missing{})});
  }
  table.notes = {
      "The thesis says in words: lattices of about a million sites take less than 2 s, random sites 6 s."};
  return table;
}

Plot plotOf(const std::vector<Pair>& pairs, bool of_device) {
  Plot plot{of_device ? "Random sites, 500 x 500: clip and draw" : "Random sites: FLANN's 30 neighbors",
            "sites",
            "seconds",
            {}};
  for (const auto& pair : pairs) {
    if (!pair.lists->measured()) continue;
    if (plot.curves.empty() || plot.curves.back().name != pair.backend)
      plot.curves.push_back({pair.backend, {}});
    plot.curves.back().points.emplace_back(
        static_cast<double>(pair.lists->sites),
        median(of_device ? devicePart(*pair.lists) : neighborPart(*pair.lists)));
  }
  Curve theirs{"thesis, Iris Plus", {}, true};
  for (const auto& row : their_rows) {
    theirs.points.emplace_back(static_cast<double>(row.sites), of_device ? row.device : row.neighbors);
  }
  plot.curves.push_back(std::move(theirs));
  return plot;
}

}  // namespace

Result<Findings> thesis(Lab& lab) {
  const std::uint64_t most = lab.settings().max_sites;
  const std::vector<std::uint64_t> wanted = {100, 1'000, 10'000, 100'000, million, 4 * million};
  const auto sizes = upTo(wanted, most);
  auto regular_sizes = sizes;
  std::erase(regular_sizes, wanted.back());
  const std::uint64_t for_resolution = std::min(most, million);
  const auto random = planPattern(lab, "random", sizes), square = planPattern(lab, "square", sizes),
             hex = planPattern(lab, "hex", sizes);
  const auto resolutions = planResolutions(lab, for_resolution);
  const auto regular = planRegular(lab, regular_sizes);
  VORPIPE_TRY(lab.measure("thesis"));

  Findings findings;
  findings.tables = {patternTable(random, "random", "Tables 3.2 and 3.3 (a) of the thesis: random sites"),
                     patternTable(square, "square", "Table 3.3 (b) of the thesis: square lattice"),
                     patternTable(hex, "hex", "Table 3.3 (c) of the thesis: hexagonal lattice"),
                     resolutionTable(resolutions, for_resolution), regularTable(regular)};
  auto& notes = findings.tables.front().notes;
  notes = noteIfCut("--max-sites", lab.settings().max_sites, wanted.back());
  Table& by_resolution = findings.tables[findings.tables.size() - 2];
  by_resolution.notes =
      noteIfCut("--max-side", static_cast<std::uint64_t>(lab.settings().max_side), largest_picture);
  by_resolution.notes.emplace_back(
      "Not drawn: the neighbors of each cell are handed back instead, which the thesis has no way to do.");
  notes.emplace_back(
      "Thesis: Templeton 2022, table 3.2, Intel Iris Plus with 8 threads. Its tables 3.3 to 3.5 are "
      "pictures, and their figures not in its text.");
  notes.emplace_back(
      "`flann:30` is the thesis's way: the 30 nearest neighbors on the host, then the device; cells that 30 "
      "do not certify are redone, which the thesis leaves wrong. `grid` searches on the device while it "
      "clips. Whole: from sites in memory to pixels in memory, with what else a run does; the thesis's two "
      "parts are compared with that. `cpu` finds the cells of pixels only when they are read: in the whole, "
      "not in clip and draw.");
  findings.plots = {plotOf(random, true), plotOf(random, false)};
  return findings;
}

}  // namespace vorpipe::bench
