#include "cli/cells_by.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/try.h"
#include "cli/options/error_line.h"
#include "cli/progress.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/forecast_files.h"
#include "io/cells/pieces_file.h"

namespace vorpipe::cli {
namespace {

void planPieces(const CellsTargets& targets, bool check, MemoryPlan& plan, const Workload& work) {
  const Detail detail = check ? Detail::everything : Detail::polygons;
  planSession(plan, work);
  planCells(plan, work, detail);
  if (check) planCellsCheck(plan, work, detail);
  for (const CellsTarget& target : targets.cells) planCellsFile(plan, work, *target.format, 0);
}

/// The sites of the pieces in degrees, and the pieces as well. Without a projection nothing changes.
void piecesToDegrees(Input& input, Pieces& pieces, int threads) {
  if (!input.projection) return;
  Sites of_pieces;
  for (const std::uint32_t site : pieces.site) {
    of_pieces.x.push_back(input.longitudes[site]);
    of_pieces.y.push_back(input.latitudes[site]);
  }
  toDegrees(*input.projection, of_pieces, pieces.cells, threads);
  Diagram none;
  backToDegrees(input, none, threads);
}

/// Checks the cells of each region, and that its pieces have its area.
EachRegion checkOf(const CommandRun& run, bool& passed) {
  if (!run.options.check) return {};
  return
      [&run, &passed](const Sites& sites, const CellsOptions& options, const Diagram& cells) -> Result<void> {
        VORPIPE_LET(passes, passesCheck(check(sites, options, cells, run.options.backend.threads)));
        passed = passed && passes;
        return {};
      };
}

Result<void> writePieceFiles(CommandRun& run, Input& input, const CellsTargets& targets, Pieces& pieces) {
  const auto unit = squareKilometersIn(input.system);
  piecesToDegrees(input, pieces, run.options.backend.threads);
  const PiecesOutput pieces_output{pieces,       input.sites, *input.part_names,          input.attributes,
                                   input.system, unit,        run.options.backend.threads};
  RunOutput output{input, pieces.cells.report};
  for (const CellsTarget& target : targets.cells) {
    output.writers.emplace_back([&, format = piecesFormat(target.format->extension)](ByteSink& to) {
      return writePieces(to, pieces_output, *format);
    });
  }
  output.figures = [&](nlohmann::ordered_json& json) {
    json["area_sum"] = areaSum(pieces.cells);
    json["features"] = pieces.region_area.size();
    json["pieces"] = pieces.size();
  };
  return run.write(output);
}

}  // namespace

Result<void> takePiecesFormat(CellsTargets& targets, const std::string& kind) {
  const auto refused = [](std::string_view option) {
    return inputError(fmt::format("--by: {} is for cells, and not for their pieces in features", option));
  };
  if (!targets.edges.empty()) return refused("--edges");
  if (!targets.triangulation.empty()) return refused("--triangulation");
  if (!targets.id.empty()) return refused("--id");
  if (targets.share) return refused("--share, which pieces have,");
  if (targets.only_cells) return refused("--only-cells");
  if (targets.only_measures) return refused("--detail measures");
  VORPIPE_TRY(takeFormat(targets, kind));
  for (const CellsTarget& target : targets.cells) {
    if (piecesFormat(target.format->extension) != nullptr) continue;
    return inputError(
        fmt::format("--by: {}: pieces go to {}", target.path, fmt::join(piecesExtensions(), ", ")));
  }
  return {};
}

Result<ExitCode> writePiecesOf(CommandRun& run, const InputOptions& from, Input& input,
                               const CellsTargets& targets) {
  const TalkOptions& talk = run.options.talk;
  CellsOptions options = cellsOptionsOf(input, run.options.search);
  options.detail = run.options.check ? Detail::everything : Detail::polygons;
  VORPIPE_TRY(checkInput(from, input, options, run.options.backend.threads));
  const auto plan = [&](MemoryPlan& to, const Workload& work) {
    planPieces(targets, run.options.check, to, work);
  };
  VORPIPE_TRY(run.begin(from, input, ImagesFor::cells, plan));
  ProgressBar bar(talk.quiet);
  options.progress = bar.callback();
  bool passed = true;
  auto pieces = piecesOf(*run.session, input.sites, options, input.parts, checkOf(run, passed));
  bar.clear();
  if (!pieces) return asOption(pieces.error(), from);
  const Report report = pieces->cells.report;
  printNotes(talk, report);
  if (!validationIsSilent(report)) return exit_device;
  if (!passed) return exit_different;
  VORPIPE_TRY(writePieceFiles(run, input, targets, *pieces));
  if (const auto note = noteOnGeoJson(targets, input.system); !note.empty() && !talk.quiet) printNote(note);
  run.printSummary(fmt::format("{}{}{} pieces of {} cells in {} features", fmt::join(run.paths, ", "),
                               run.paths.empty() ? "" : ": ", pieces->size(), report.ok, input.parts.size()),
                   report);
  return exit_done;
}

}  // namespace vorpipe::cli
