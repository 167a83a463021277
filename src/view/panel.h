/// The panel of the window: what it says, and what it changes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/action.h"
#include "view/settings.h"
#include "view/window/event.h"
#include "view/window/presenter.h"
#include "vorpipe/cells.h"
#include "vorpipe/fluid.h"

namespace vorpipe::view {

/// The cell under the pointer.
struct Hovered {
  std::uint32_t site = 0;
  Point place{0, 0};  ///< of the site
  double weight = 0, area = 0;
  std::uint64_t neighbors = 0;
};

/// What frames took lately, in milliseconds.
struct FrameTimes {
  double frame = 0;  ///< from a change to its sharp picture
  double order = 0, cells = 0, draw = 0, download = 0, present = 0;
  std::vector<float> history{};  ///< of `frame`, the latest last
};

/// What two backends draw, where they are compared.
struct Compared {
  std::uint64_t differing = 0, pixels = 0;
  std::string by{};  ///< "cpu on 2 threads": the other one
};

/// What stirs a fluid, in the window.
struct BrushShown {
  Place middle{};
  double radius = 0;  ///< in pixels
};

/// A fluid.
struct FluidShown {
  std::string name;  ///< a case, or a file
  FluidOptions options{};
  FluidStep last{};
  double steps_per_second = 0;  ///< 0: it rests
  std::optional<BrushShown> brush{};
};

struct PanelInput {
  Settings settings;
  std::optional<Hovered> hovered{};
  FrameTimes times{};
  std::vector<DeviceInfo> devices{};
  std::string presenter{}, message{};  ///< what presents; what was saved or went wrong last, or empty
  std::uint64_t sites = 0;
  std::optional<RelaxStep> relaxed{};  ///< the last step
  std::optional<FluidShown> fluid{};   ///< none: sites are no fluid's
  std::optional<Compared> compared{};
  std::optional<Placement> legend{};  ///< of the picture, which the panel is not to hide
  bool can_undo = false, can_redo = false;
  int width = 0, height = 0;  ///< of the window
  double scale = 1;           ///< of letters and all else: 2 where pixels are half as large as usual
  std::string computed_by{};  ///< "vulkan-compute on llvmpipe": what drew the last picture, or empty
  /// Each key with what it does: what the help lists.
  std::vector<std::pair<std::string, std::string>> keys{};
};

struct PanelAnswer {
  Settings settings;                               ///< as the panel has changed them
  std::vector<Action> actions;                     ///< after the settings have changed
  std::optional<FluidCase> begins{};               ///< is to take the place of all sites
  std::optional<FluidOptions> flows_by{};          ///< are the fluid's from now on
  bool takes_pointer = false, takes_keys = false;  ///< the window is not to have them
  /// How many pixels of the window the panel covers, from the left and from the right, up to what it leaves
  /// free on its wider side; none while a button is held, which may move it.
  std::optional<std::pair<double, double>> covers{};
  bool new_texture = false;  ///< another scale: the presenter needs texture() before this frame is shown
};

/// Where something stands in the window, by name: "Edges", "Color/area", "Run".
using PanelPlaces = std::map<std::string, Placement, std::less<>>;

/// Dear ImGui, without its windows and its graphics. Of one thread.
class Panel {
 public:
  Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;
  ~Panel();

  [[nodiscard]] const PanelTexture& texture() const;
  /// Whether it keeps the event to itself, as the panel stands since the last frame: the pointer is over it,
  /// drags what began there, or closes a list; a key is typed into a field. All others are the window's.
  bool take(const Event& event);
  /// The next frame, of all that was taken. `triangles` is replaced, and empty where nothing is to be seen.
  /// The same again is drawn in the same way: no time passes.
  PanelAnswer draw(const PanelInput& input, PanelTriangles& triangles);
  /// What stood where in the last frame; what is scrolled out of sight may be beyond the window.
  [[nodiscard]] const PanelPlaces& places() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::view
