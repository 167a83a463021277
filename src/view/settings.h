/// Settings of a window, except its view: those that keys, the panel and the command line change.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "view/flowing.h"
#include "vorpipe/devices.h"
#include "vorpipe/picture.h"
#include "vorpipe/relax.h"

namespace vorpipe::view {

/// Whether sites move by themselves.
enum class Motion : std::uint8_t { rests, steps_once, runs };

/// The brush that stirs a fluid.
struct Brush {
  double radius = 0.1;  ///< as a fraction of the domain's shorter side
  double push = 1;      ///< what a stroke adds, in units of the fluid's usual speed
};

struct Settings {
  /// Colors, edges, sites, dual, labels, legend, outline, period, domain; width, height and view are the
  /// window's.
  RenderOptions picture{};
  FlowColor flow_color = FlowColor::none;  ///< of fluids
  bool cells = true;                       ///< filled; else cells are white
  bool panel = true, help = false;
  BackendOptions backend{};
  std::optional<BackendOptions> compared{};  ///< draws the same picture, to the right of a line
  double wipe = 0.5;                         ///< position of that line, as a fraction of the window's width
  RelaxMethod method = RelaxMethod::lloyd;
  Motion motion = Motion::rests;
  Density density{};         ///< for relaxing
  std::string density_path;  ///< where it came from
  Brush brush{};
  std::uint64_t parcels = 2048;  ///< of a new fluid
};

/// Returns a backend to compare with: it shares only the number of threads and the validation setting.
inline BackendOptions comparedWith(const BackendOptions& backend, std::string name, std::string device) {
  BackendOptions other{};
  other.name = std::move(name);
  other.device = std::move(device);
  other.threads = backend.threads;
  other.validation = backend.validation;
  return other;
}

}  // namespace vorpipe::view
