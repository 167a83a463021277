#include <fmt/format.h>

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/try.h"
#include "cli/cells_by.h"
#include "cli/cells_command.h"
#include "cli/commands/command.h"
#include "cli/drawing.h"
#include "cli/options/error_line.h"
#include "cli/options/mass_options.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "cli/tiled_cells.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "io/cells/forecast_files.h"

namespace vorpipe::cli {
namespace {

/// Rejects options that nothing uses or supports, and sets the format of standard output.
Result<void> checkCommand(CellsCommand& command, const CommandRun& run) {
  VORPIPE_TRY(run.needsOutput("cells.csv", "--stats or --check"));
  const CellsTargets& targets = command.targets;
  const bool is_free = command.surface == Surface::free;
  if (is_free && command.input.globe) {
    return inputError("--surface: the globe has cells without air around them alone");
  }
  if (is_free && command.check) {
    return inputError("--check: what verifies cells does not know free surfaces");
  }
  if (is_free && !targets.edges.empty()) {
    return inputError("--edges: cells with a free surface have arcs between them and air; -o has them");
  }
  if (!targets.triangulation.empty() && (is_free || command.input.periodic.any())) {
    return inputError(
        fmt::format("--triangulation: there is none {}; --edges has the edges of cells",
                    is_free ? "of cells with a free surface" : "in a domain that repeats itself"));
  }
  const std::string& format = command.input.format.output;
  if (!format.empty() && command.input.sites != "-" && !targets.useStandardOutput()) {
    return inputError("--format: neither --sites - nor -o - is there to take it");
  }
  if (command.input.by.empty()) return takeFormat(command.targets, format);
  if (!command.density.empty()) return inputError("--by: pieces have areas, and no masses of a --density");
  if (is_free) return inputError("--by: cells with a free surface have no pieces");
  return takePiecesFormat(command.targets, format);
}

/// Returns the parts of the cells that the outputs and the check need.
Detail neededDetail(const CellsCommand& command) {
  return command.check ? Detail::everything : command.targets.detail();
}

std::uint64_t bytesOf(std::span<const Attribute> attributes) {
  std::uint64_t bytes = 0;
  for (const Attribute& attribute : attributes) bytes += attribute.bytes();
  return bytes;
}

/// Whether nothing but the outputs keeps the cells from being measured in tiles.
bool mayBeTiled(const CellsCommand& command) {
  return command.surface == Surface::none && !command.check && command.density.empty() &&
         canBeTiled(command.input);
}

/// Returns further advice for a run that needs too much memory.
std::string_view adviceOn(const CellsCommand& command) {
  const bool helps = !command.targets.only_measures && command.targets.edges.empty() &&
                     command.targets.triangulation.empty() && mayBeTiled(command);
  return helps ? "; areas, centroids and numbers of neighbors alone need less: --detail measures" : "";
}

/// Plans the memory of a run; the density and the attributes may not have been read yet.
void planDiagram(const CellsCommand& command, std::uint64_t density_pixels, std::uint64_t attribute_bytes,
                 MemoryPlan& plan, Workload work) {
  work.density_pixels = density_pixels;
  if (density_pixels > 0) planDensity(plan, density_pixels);
  const Detail detail = neededDetail(command);
  planSession(plan, work);
  planCells(plan, work, detail);
  if (command.check) planCellsCheck(plan, work, detail);
  for (const CellsTarget& target : command.targets.cells)
    planCellsFile(plan, work, *target.format, attribute_bytes);
  planEdgesFiles(plan, work, formatsOf(command.targets.edges));
  planTriangulationFiles(plan, work, formatsOf(command.targets.triangulation));
}

/// Returns the options of the cells, except the progress; adds notes on the density to the input.
Result<CellsOptions> cellsOptions(const CellsCommand& command, Input& input) {
  VORPIPE_VAR(density, densityOf(command.density));
  VORPIPE_TRY(placeUnder(density, command.density, command.input, input));
  CellsOptions options = cellsOptionsOf(input, command.search);
  options.density = std::move(density.density);
  options.detail = neededDetail(command);
  return options;
}

std::string leftOutNote(const Diagram& diagram) {
  std::size_t left_out = 0;
  for (std::size_t site = 0; site < diagram.size(); ++site) left_out += hasPolygon(diagram, site) ? 0u : 1u;
  if (left_out == 0) return {};
  return fmt::format("--only-cells: {} of {} sites have no cell, and are left out", left_out, diagram.size());
}

/// Prints up to three lines on standard error, unless the run is quiet: how many records --only-cells left
/// out; which attributes were renamed in the files; that GeoJSON has coordinates of a plane without its name,
/// which readers take for degrees.
void printCellsNotes(const TalkOptions& talk, const CellsTargets& targets, const CellsOutput& output) {
  const auto note = [&talk](const std::string& text) {
    if (!talk.quiet && !text.empty()) printNote(text);
  };
  if (targets.only_cells) note(leftOutNote(output.diagram));
  if (targets.carryAttributes()) note(renamingNote(output.attributes, addedFields(output)));
  note(noteOnGeoJson(targets, output.system));
}

/// Writes the files, converted back to degrees if the input was projected.
Result<void> writeFiles(const CellsCommand& command, CommandRun& run, Input& input, Diagram& diagram) {
  const int threads = command.backend.threads;
  VORPIPE_LET(names, namesOf(command.targets, input.attributes));
  TriangulationLines triangulation;
  if (!command.targets.triangulation.empty()) triangulation = triangulationLines(input.sites, diagram);
  Topology topology;
  if (!command.targets.edges.empty()) {
    VORPIPE_VAR(found, topologyOf(diagram, threads));
    topology = std::move(found);
  }
  if (input.projection) toDegrees(*input.projection, topology, threads);
  backToDegrees(input, diagram, threads);
  RunOutput output{input, diagram.report};
  const CellsOutput cells{
      input.sites, diagram, input.attributes,     input.system, command.targets.only_cells,
      threads,     names,   command.targets.share};
  for (const CellsTarget& target : command.targets.cells) {
    output.writers.emplace_back(
        [&, format = target.format](ByteSink& to) { return writeCells(to, cells, *format); });
  }
  const auto addLines = [&](const std::vector<EdgesTarget>& targets, LinesOutput lines) {
    lines.threads = threads;
    lines.names = names;
    for (const EdgesTarget& target : targets) {
      output.writers.emplace_back(
          [lines, format = target.format](ByteSink& to) { return writeLines(to, lines, *format); });
    }
  };
  if (!command.targets.edges.empty())
    addLines(command.targets.edges, edgesOf(input.sites, diagram, topology, input.system));
  addLines(command.targets.triangulation, linesOf(triangulation, input.sites, input.system));
  output.figures = [&](nlohmann::ordered_json& json) { addSums(json, diagram); };
  VORPIPE_TRY(run.write(output));
  printCellsNotes(command.talk, command.targets, cells);
  return {};
}

/// Computes the cells of an input, and writes them.
Result<ExitCode> computeCells(const CellsCommand& command, CommandRun& run, Input& input) {
  VORPIPE_TRY(namesOf(command.targets, input.attributes));
  VORPIPE_VAR(options, cellsOptions(command, input));
  VORPIPE_TRY(checkInput(command.input, input, options, command.backend.threads));
  if (command.surface == Surface::free) {
    VORPIPE_TRY(checkDiscs(input.sites));
  }
  const PlanRun plan = std::bind_front(planDiagram, std::cref(command), options.density.values.size(),
                                       bytesOf(input.attributes));
  VORPIPE_TRY(run.begin(command.input, input, ImagesFor::cells, plan,
                        input.sites.weight.empty() ? adviceOn(command) : ""));
  ProgressBar bar(command.talk.quiet);
  options.progress = bar.callback();
  auto diagram = cellsWith(command.surface, *run.session, input.sites, options);
  bar.clear();
  if (!diagram) return asOption(diagram.error(), command.input);
  const Report& report = diagram->report;
  printNotes(command.talk, report);
  if (command.surface == Surface::none) printMissingCells(command.talk, input, diagram->status, report);
  if (!validationIsSilent(report)) return exit_device;
  if (command.check) {
    VORPIPE_LET(passed, passesCheck(check(input.sites, options, *diagram, command.backend.threads)));
    if (!passed) return exit_different;
  }
  VORPIPE_TRY(writeFiles(command, run, input, *diagram));
  run.printSummary(run.outcome(input.sites, report), report);
  return exit_done;
}

Result<ExitCode> cells(CellsCommand& command, const Invocation& how) {
  if (isInSpace(command.input)) return cellsInSpace(command, how);
  command.input.reading.advice_on_z = "; --dim 3 makes cells in space";
  CommandRun run("cells", command, how, command.targets.paths());
  VORPIPE_TRY(checkCommand(command, run));
  InputOptions from = command.input;
  from.reading.attributes = command.targets.carryAttributes() || !command.targets.id.empty();
  from.reading.needed = neededFor(command.targets);
  if (!command.targets.only_measures || !mayBeTiled(command)) {
    const std::uint64_t pixels = command.density.empty() ? 0 : 1;
    const PlanRun plan = std::bind_front(planDiagram, std::cref(command), pixels, std::uint64_t{0});
    VORPIPE_VAR(input, run.load(from, plan, adviceOn(command)));
    if (input.part_names) return writePiecesOf(run, command.input, input, command.targets);
    return computeCells(command, run, input);
  }
  VORPIPE_VAR(tiled, loadTiled(run, from));
  // A file may have weights of its own.
  if (!tiled.input.sites.weight.empty()) return computeCells(command, run, tiled.input);
  return measureInTiles(run, command.input, tiled, command.targets.cells.size());
}

}  // namespace

void addCells(CommandLine& line) {
  auto command = std::make_shared<CellsCommand>();
  Options options =
      line.addSubcommand("cells",
                         "computes the cells of sites (Thiessen polygons, Dirichlet cells): areas, "
                         "centroids, neighbors, polygons; with weights, those of the power diagram "
                         "(Laguerre or radical cells)",
                         [command](const Invocation& how) { return cells(*command, how); });
  addInputOptions(options, command->input).required();
  addParsed(options, "--by", command->input.by, "NAME",
            "cells in each feature of --domain by itself, which this attribute names: a record for each "
            "feature and each site whose cell meets it, with the area and its share of the feature; "
            "features of one name are one",
            parseAttributeWord);
  addDimension(options, command->input);
  addGlobe(options, command->input);
  options.group("Output");
  addCellsTargets(options, command->targets);
  options.group("Cells");
  addDensityOptions(options, command->density, "the mass of each cell and its center");
  addSurface(options, command->surface, surface_text);
  addCommonOptions(
      options, *command,
      "verifies areas, neighbors, polygons and nearest sites; exit code 1 if a promise is broken");
}

}  // namespace vorpipe::cli
