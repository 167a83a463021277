/// The figures of a run as JSON, for --stats.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/input.h"
#include "cli/run_log.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// Figures of a relaxation.
struct RelaxFigures {
  std::string method, end;
  std::uint64_t diagrams;
  RelaxStep first, last;  ///< of the input sites, and of the resulting sites
};

/// Figures of a transport.
struct TransportFigures {
  std::string end;
  bool free_surface;
  std::uint64_t diagrams, newton;
  TransportStep last;  ///< the last step that was kept
  double mass;         ///< of all cells together
  double cost;
};

/// Figures of a fluid.
struct FluidFigures {
  std::string scheme, end;
  FluidStep first, last;
  double worst, drift;  ///< of areas, and of the energy relative to the first; each the largest of all steps
  double epsilon;       ///< of springs
};

/// Figures of a run in tiles.
struct TileFigures {
  std::uint64_t sites;                 ///< of the run
  std::uint64_t tiles, largest, open;  ///< as in TiledReport
};

struct Stats {
  std::string command;
  const Input& input;
  const Report& report;
  const RunLog& log;
  double write_ms, total_ms;
  std::uint64_t forecast;            ///< bytes at the peak, forecast before the run
  std::optional<double> area_sum{};  ///< none if cells were only drawn
  std::optional<double> mass_sum{};  ///< none without a density
  std::optional<ColorKey> color{};   ///< of a picture; none by site
  std::optional<RelaxFigures> relaxation{};
  std::optional<FluidFigures> fluid{};
  std::optional<TransportFigures> transport{};
  std::optional<TileFigures> tiles{};
};

/// Adds the domain's properties besides its box, and the range of the weights: "outline", "periodic",
/// "projection" and "weights", each null if there is none.
void addShape(nlohmann::ordered_json& json, const Input& input);

/// Returns the object that `--stats` writes, with a line end; a figure that does not apply is null.
std::string statsJson(const Stats& stats);

}  // namespace vorpipe::cli
