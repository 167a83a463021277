/// What keys, the panel and the command line request: settings of a window, except its view, and actions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "view/flowing.h"
#include "vorpipe/devices.h"
#include "vorpipe/picture.h"
#include "vorpipe/relax.h"

namespace vorpipe::view {

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
  double split = 0.5;                        ///< position of that line, as a fraction of the window's width
  RelaxMethod method = RelaxMethod::lloyd;
  Motion motion = Motion::rests;
  Density density{};         ///< for relaxing
  std::string density_path;  ///< where it came from
  Brush brush{};
  std::uint64_t parcels = 2048;  ///< of a new fluid
};

/// Sets what colors mean. A range and scale for the previous meaning no longer apply; colors by site have no
/// legend.
void colorBy(ColorBy color, Settings& settings);

/// Returns a backend to compare with: it shares only the number of threads and the validation setting.
BackendOptions comparedWith(const BackendOptions& backend, std::string name, std::string device);

/// Whether both open the same session.
bool isSame(const BackendOptions& a, const BackendOptions& b);

/// Whether both draw the same picture of the same sites and view, by the same backend. Ignores the panel,
/// motion and the settings of relaxation.
bool drawTheSame(const Settings& a, const Settings& b);

/// Actions that a key or a panel button can request.
enum class Action : std::uint8_t {
  undo,
  redo,
  fit,   ///< shows the whole domain
  step,  ///< one step of relaxation or of a fluid
  run,   ///< relaxes or flows until paused
  pause,
  begin_again,  ///< resets the fluid to its initial state
  save_png,     ///< the picture, without the panel
  save_svg,
  save_sites,    ///< a .csv of the sites
  save_fluid,    ///< a checkpoint, for `vorpipe fluid --resume`
  next_backend,  ///< among those that work here
  compare,       ///< toggles the comparison with another backend
  copy_command,  ///< the command line that makes this picture, to the clipboard and to standard output
  close,
};

}  // namespace vorpipe::view
