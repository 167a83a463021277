#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/try.h"
#include "cli/cells_command.h"
#include "cli/options/error_line.h"
#include "cli/progress.h"
#include "cli/space_input.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/forecast_files.h"
#include "io/cells/space_file.h"
#include "io/sites/space_source.h"

namespace vorpipe::cli {
namespace {

/// An option that the command has, and why cells in space do not take it.
struct Refused {
  bool given;
  std::string_view option, why;
};

/// Rejects options that are of the plane.
Result<void> refuseOptionsOfPlane(const CellsCommand& command) {
  const InputOptions& input = command.input;
  const CellsTargets& targets = command.targets;
  const std::string& backend = command.backend.name;
  constexpr std::string_view box = "the domain in space is a box";
  const Refused options[] = {
      {input.domain.box.has_value(), "--domain",
       "in space it has six numbers: XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX"},
      {input.domain.hull || !input.domain.file.empty(), "--domain",
       "the domain in space is a box: XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX"},
      {!input.domain_layer.empty(), "--domain-layer", box},
      {input.repair, "--repair", box},
      {!input.by.empty(), "--by", box},
      {input.globe, "--globe", "cells are either on the globe or in space"},
      {input.project.has_value(), "--project", "sites in space are not degrees"},
      {input.crs.has_value(), "--crs", "no file of cells in space names a coordinate system"},
      {!input.reading.layer.empty(), "--layer", "sites in space are read from tables"},
      {input.lattice && input.domain.space, "--domain", "sites that repeat by --lattice have none"},
      {input.lattice && input.periodic.any(), "--periodic", "sites repeat by --lattice already"},
      {input.lattice && input.margin, "--margin", "sites that repeat by --lattice have no domain"},
      {command.surface != Surface::none, "--surface", "cells in space fill their domain"},
      {!command.density.empty(), "--density", "is an image of a domain in the plane"},
      {!targets.edges.empty(), "--edges", "the edges of cells in space are in .vtu, .obj, .ply and .npz"},
      {!targets.triangulation.empty(), "--triangulation", "there is none in space; .npz has vertex_sites"},
      {targets.share, "--share", "is a share of areas"},
      {targets.only_cells, "--only-cells", "no file of cells in space has features"},
      {command.search.method != Search::grid, "--search", "cells in space are found on the grid alone"},
      {!command.backend.device.empty(), "--device", "cells in space are found on the CPU"},
      {backend != "auto" && backend != "cpu", "--backend",
       "cells in space are found on the CPU; name cpu, or none"},
  };
  for (const Refused& option : options) {
    if (option.given) return inputError(fmt::format("{}: {}", option.option, option.why));
  }
  return {};
}

struct SpaceTarget {
  std::string path;
  const SpaceFormat* format;
};

struct SpaceTargets {
  std::vector<SpaceTarget> files;
  Detail3 detail = Detail3::measures;  ///< of the run
  bool attributes = false;             ///< whether one of the files has those of the input
};

/// Returns the files to write, with their formats.
Result<SpaceTargets> targetsOf(const CellsCommand& command) {
  SpaceTargets targets;
  const std::string& kind = command.input.format.output;
  bool standard = false;
  for (const CellsTarget& target : command.targets.cells) {
    const bool named = target.path != standard_output;
    if (!named && std::exchange(standard, true))
      return inputError("-o: standard output takes one file, and is named twice");
    const std::string path = named ? target.path : "-." + (kind.empty() ? "csv" : kind);
    auto format = spaceFormatOf(path);
    if (!format && named) return tl::unexpected(std::move(format.error()));
    if (!format) {
      return inputError(fmt::format("--format: {} is no kind of file for cells in space; known are {}",
                                    inQuotes(kind), fmt::join(spaceExtensions(), ", ")));
    }
    targets.files.push_back({target.path, *format});
    targets.attributes = targets.attributes || (*format)->attributes;
    const bool measures = command.targets.only_measures && (*format)->extension == ".npz";
    if (!measures) targets.detail = std::max(targets.detail, (*format)->detail);
  }
  const auto has_lines = [](const SpaceTarget& target) { return target.format->extension == ".vol"; };
  const bool lines = std::ranges::any_of(targets.files, has_lines);
  if (!command.targets.voro_format.empty() && !lines)
    return inputError("--voro-format: there is no file of such lines: -o FILE.vol");
  if (!command.targets.id.empty() && !lines)
    return inputError("--id: of files of cells in space a .vol alone names sites");
  if (!kind.empty() && command.input.sites != "-" && !standard)
    return inputError("--format: neither --sites - nor -o - is there to take it");
  if (command.targets.only_measures && targets.detail == Detail3::polyhedra)
    return inputError("--detail: measures alone go to .npz and .csv, and no other");
  if (command.targets.only_measures && targets.files.empty())
    return inputError("--detail: names what a file has; -o FILE.npz");
  if (command.check && !command.targets.only_measures) targets.detail = Detail3::polyhedra;
  return targets;
}

/// The options of a run that its input has.
Cells3Options periodOf(const InputOptions& input, const Box3& domain) {
  Cells3Options options{};
  options.domain = input.domain.space.value_or(domain);
  options.periodic = input.periodic.inSpace();
  options.lattice = input.lattice;
  return options;
}

/// Returns the peak memory in bytes of a run over `sites` sites whose attributes take `attribute_bytes`.
std::uint64_t peakInSpace(const CellsCommand& command, const SpaceTargets& targets, std::uint64_t sites,
                          std::uint64_t attribute_bytes) {
  Workload work;
  work.sites = sites;
  work.threads = command.backend.threads;
  work.weighted = command.input.random_weights || !command.input.weights.empty();
  work.images = imagesInSpace(sites, periodOf(command.input, {0, 0, 0, 1, 1, 1}));
  MemoryPlan plan;
  planSpaceSites(plan, command.input.sites, sites);
  if (work.weighted) planWeights(plan, command.input.weights, sites);
  planAttributes(plan, attribute_bytes);
  planSession(plan, work);
  planCells(plan, work, targets.detail);
  if (command.check) planCellsCheck(plan, work, targets.detail);
  for (const SpaceTarget& target : targets.files) planSpaceFile(plan, sites, *target.format);
  return plan.peak();
}

/// Returns the peak. Error (input): there is not so much memory.
Result<std::uint64_t> forecastInSpace(const CellsCommand& command, const SpaceTargets& targets,
                                      std::uint64_t sites, std::uint64_t attribute_bytes = 0) {
  const auto needs = [&](std::uint64_t count) {
    const double part = static_cast<double>(count) / static_cast<double>(sites);
    return peakInSpace(command, targets, count,
                       static_cast<std::uint64_t>(part * static_cast<double>(attribute_bytes)));
  };
  const auto lack = lackOfMemory(needs(sites), command.memory_limit);
  if (!lack) return needs(sites);
  std::uint64_t fits = 0, fails = sites;
  while (fails - fits > fails / 100 + 1) {
    const std::uint64_t count = fits + (fails - fits) / 2;
    (lackOfMemory(needs(count), command.memory_limit) ? fails : fits) = count;
  }
  const bool polyhedra = targets.detail == Detail3::polyhedra;
  return inputError(fmt::format(
      "--sites: {}; {}{}", *lack,
      fits == 0 ? std::string("without any site it needs too much")
                : fmt::format("some {} sites would fit", fits),
      polyhedra ? "; volumes, areas, centroids and neighbors alone need less: -o FILE.npz --detail measures"
                : ""));
}

/// The number of sites outside of the domain that have no cell.
std::uint64_t emptyOutside(const SpaceInput& input, const Diagram3& diagram) {
  const Box3& box = input.domain;
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i < input.sites.size(); ++i) {
    const Point3& p = input.sites[i];
    const bool inside = p.x >= box.xmin && p.x <= box.xmax && p.y >= box.ymin && p.y <= box.ymax &&
                        p.z >= box.zmin && p.z <= box.zmax;
    outside += diagram.status[i] == Status::empty && !inside ? 1U : 0U;
  }
  return outside;
}

void noteSpaceCells(const CellsCommand& command, const SpaceTargets& targets, const SpaceInput& input,
                    const Diagram3& diagram) {
  if (command.talk.quiet) return;
  const Report& report = diagram.report;
  const std::uint64_t hidden = report.hidden - std::min(report.hidden, emptyOutside(input, diagram));
  const auto say = [&](std::uint64_t count, std::string_view why) {
    if (count > 0) printNote(fmt::format("{} of {} sites have no cell: {}", count, input.sites.size(), why));
  };
  say(hidden, "others of larger weight hide them");
  say(report.empty - hidden, "they lie outside the domain");
  for (const SpaceTarget& target : targets.files) {
    if (diagram.flat == 0 || !target.format->only_polyhedra) continue;
    printNote(fmt::format("{}: {} cells are too thin to have four faces, and are left out", target.path,
                          diagram.flat));
  }
  const bool carried = std::ranges::any_of(targets.files, &SpaceFormat::attributes, &SpaceTarget::format);
  const std::string renamed = renamingNoteInSpace(input.common.attributes);
  if (carried && !renamed.empty()) printNote(renamed);
}

/// Writes the files, and prints what was done.
Result<void> writeSpace(const CellsCommand& command, const SpaceTargets& targets, CommandRun& run,
                        const SpaceInput& input, const Diagram3& diagram) {
  VORPIPE_LET(names, namesOf(command.targets, input.common.attributes));
  const SpaceOutput cells{input.sites,
                          diagram,
                          input.common.attributes,
                          targets.detail,
                          command.backend.threads,
                          input.weights(),
                          command.targets.voro_format,
                          names};
  SpaceOutput measures = cells;
  measures.detail = Detail3::measures;
  RunOutput output{input.common, diagram.report};
  for (const SpaceTarget& target : targets.files) {
    output.writers.emplace_back([&, format = target.format](ByteSink& to) {
      return writeSpaceCells(to, command.targets.only_measures ? measures : cells, *format);
    });
  }
  output.figures = [&](nlohmann::ordered_json& json) {
    const Box3& box = input.domain;
    json["dimension"] = 3;
    json["sites"] = input.sites.size();
    json["domain"] = {box.xmin, box.ymin, box.zmin, box.xmax, box.ymax, box.zmax};
    if (const auto& lattice = command.input.lattice) {
      const auto& [a, b, c] = *lattice;
      json["domain"] = nullptr;
      json["lattice"] = {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
    }
    if (command.input.periodic.any()) json["periodic"] = command.input.periodic.name();
    json["volume_sum"] = volumeSum(diagram);
    json["flat"] = diagram.flat;
  };
  return run.write(output);
}

/// Computes the cells of an input, and writes them.
Result<ExitCode> computeInSpace(const CellsCommand& command, const SpaceTargets& targets, CommandRun& run,
                                const SpaceInput& input) {
  Cells3Options options = periodOf(command.input, input.domain);
  options.detail = targets.detail;
  options.weights = input.weights();
  VORPIPE_TRY(namesOf(command.targets, input.common.attributes));
  if (auto checked = checkInput(input.sites, options, command.backend.threads); !checked)
    return asOption(std::move(checked.error()), command.input);
  printNotes(command.talk, input.common);
  VORPIPE_TRY(run.createFiles());
  VORPIPE_TRY(run.openSession());
  std::uint64_t attribute_bytes = 0;
  for (const Attribute& attribute : input.common.attributes) attribute_bytes += attribute.bytes();
  VORPIPE_LET(bytes, forecastInSpace(command, targets, input.sites.size(), attribute_bytes));
  run.forecast = bytes;
  ProgressBar bar(command.talk.quiet);
  options.progress = bar.callback();
  auto diagram = run.session->cells(input.sites, options);
  bar.clear();
  if (!diagram) return asOption(std::move(diagram.error()), command.input);
  printNotes(command.talk, diagram->report);
  noteSpaceCells(command, targets, input, *diagram);
  if (command.check) {
    VORPIPE_LET(passed, passesCheck(check(input.sites, options, *diagram, command.backend.threads)));
    if (!passed) return exit_different;
  }
  VORPIPE_TRY(writeSpace(command, targets, run, input, *diagram));
  const Report& report = diagram->report;
  run.printSummary(fmt::format("{}{}{} {}cells in space ({} empty, {} duplicate)", fmt::join(run.paths, ", "),
                               run.paths.empty() ? "" : ": ", report.ok,
                               input.weights().empty() ? "" : "weighted ", report.empty, report.duplicate),
                   report);
  return exit_done;
}

}  // namespace

bool isInSpace(const InputOptions& input) {
  const bool named = input.sites == "-" && !input.format.input.empty();
  return input.space || input.lattice || input.domain.space.has_value() ||
         isOfSpace(named ? "-." + input.format.input : input.sites);
}

Result<ExitCode> cellsInSpace(const CellsCommand& command, const Invocation& how) {
  VORPIPE_TRY(refuseOptionsOfPlane(command));
  CellsCommand on_cpu = command;
  on_cpu.backend.name = "cpu";
  CommandRun run("cells", on_cpu, how, command.targets.paths());
  VORPIPE_TRY(run.needsOutput("cells.npz", "--stats or --check"));
  VORPIPE_LET(targets, targetsOf(command));
  InputOptions from = command.input;
  from.reading.attributes = targets.attributes || !command.targets.id.empty();
  from.reading.needed = neededFor(command.targets);
  if (const auto count = generatedInSpace(from.sites)) {
    VORPIPE_TRY(forecastInSpace(command, targets, *count));
  }
  VORPIPE_LET(input, loadSpaceInput(from));
  return computeInSpace(on_cpu, targets, run, input);
}

}  // namespace vorpipe::cli
