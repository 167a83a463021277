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

/// What moved the sites, where a run did.
struct RelaxFigures {
  std::string method, end;
  std::uint64_t diagrams;
  RelaxStep first, last;  ///< of the sites as they came, and of those that are the result
};

/// What found weights, where a run did.
struct TransportFigures {
  std::string end;
  bool free_surface;
  std::uint64_t diagrams, newton;
  TransportStep last;  ///< that was kept
  double mass;         ///< of all cells together
  double cost;
};

/// What a fluid came to.
struct FluidFigures {
  std::string scheme, end;
  FluidStep first, last;
  double worst, drift;  ///< of areas, and of the energy as a part of the first: largest of all steps
  double epsilon;       ///< of springs
};

/// What a run in tiles was cut into.
struct TileFigures {
  std::uint64_t sites;                 ///< of the run
  std::uint64_t tiles, largest, open;  ///< as TiledReport has them
};

struct Stats {
  std::string command;
  const Input& input;
  const Report& report;
  const RunLog& log;
  double write_ms, total_ms;
  std::uint64_t forecast;            ///< bytes at the peak, told before
  std::optional<double> area_sum{};  ///< none where cells were only drawn
  std::optional<double> mass_sum{};  ///< none without a density
  std::optional<ColorKey> color{};   ///< of a picture; none by site
  std::optional<RelaxFigures> relaxation{};
  std::optional<FluidFigures> fluid{};
  std::optional<TransportFigures> transport{};
  std::optional<TileFigures> tiles{};
};

/// Adds what the domain is besides its box, and between which numbers the weights are: "outline", "periodic",
/// "projection" and "weights", each null where there is none.
void addShape(nlohmann::ordered_json& json, const Input& input);

/// The object that `--stats` writes, with a line's end; a figure that does not apply is null.
std::string statsJson(const Stats& stats);

}  // namespace vorpipe::cli
