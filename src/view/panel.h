/// The window's panel: what it shows, and what it changes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/settings.h"
#include "view/window/event.h"
#include "view/window/presenter.h"
#include "vorpipe/cells.h"
#include "vorpipe/fluid.h"

namespace vorpipe::view {

struct Hovered {
  std::uint32_t site = 0;
  Point position{0, 0};  ///< of the site
  double weight = 0, area = 0;
  std::uint64_t neighbors = 0;
  std::vector<Position> border{};  ///< a closed line around it, in the window
};

/// In milliseconds.
struct FrameTimes {
  double frame = 0;  ///< from a change to its sharp picture
  double order = 0, cells = 0, draw = 0, download = 0, present = 0;
  std::vector<float> history{};  ///< of `frame`, the latest last
};

/// The difference between the pictures of two compared backends.
struct Compared {
  std::uint64_t differing = 0, pixels = 0;
  std::string by{};  ///< the other backend, e.g. "cpu on 2 threads"
};

struct BrushShown {
  Position middle{};
  double radius = 0;  ///< in pixels
};

struct FluidShown {
  std::string name;  ///< a case, or a file
  FluidOptions options{};
  FluidStep last{};
  double steps_per_second = 0;  ///< 0: paused
  std::optional<BrushShown> brush{};
};

struct PanelInput {
  Settings settings;
  std::optional<Hovered> hovered{};
  FrameTimes times{};
  std::vector<DeviceInfo> devices{};
  std::string presenter{}, message{};  ///< presenter's name; last save or error, or empty
  std::string hint{};                  ///< shown where there is no message; or empty
  double hint_shows = 1;               ///< from 1 to 0, where it is gone
  std::uint64_t sites = 0;
  std::optional<RelaxStep> relaxed{};  ///< the last step
  std::optional<FluidShown> fluid{};   ///< none: no fluid
  std::optional<Compared> compared{};
  std::optional<Placement> legend{};  ///< of the picture; the panel must not hide it
  bool can_undo = false, can_redo = false;
  int width = 0, height = 0;  ///< of the window
  double scale = 1;           ///< of the user interface: 2 if pixels are half the usual size
  std::string computed_by{};  ///< what drew the last picture, e.g. "vulkan-compute on llvmpipe"; or empty
  /// Keys and what they do, as the help lists them.
  std::vector<std::pair<std::string, std::string>> keys{};
};

struct PanelResult {
  Settings settings;                               ///< as the panel has changed them
  std::vector<Action> actions;                     ///< to perform after the change of settings
  std::optional<FluidCase> begins{};               ///< a fluid that replaces all sites
  std::optional<FluidOptions> flows_by{};          ///< new options of the fluid
  bool takes_pointer = false, takes_keys = false;  ///< the window must ignore them
  /// How many pixels at the window's left and right edges the panel takes; its wider side stays free. None
  /// while a button is held: the panel may be moving.
  std::optional<std::pair<double, double>> covers{};
  bool new_texture = false;  ///< the scale changed: the presenter needs texture() before it shows this frame
};

/// Positions of widgets in the window, by name: "Edges", "Color/area", "Run".
using WidgetPlacements = std::map<std::string, Placement, std::less<>>;

/// The panel, drawn by Dear ImGui without ImGui's own platform and graphics backends. For one thread only.
class Panel {
 public:
  Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;
  ~Panel();

  [[nodiscard]] const PanelTexture& texture() const;
  /// Whether the panel, as drawn last, consumes the event: the pointer is over it, drags from it, or closes a
  /// list; or a key goes into a field. All other events belong to the window.
  bool take(const Event& event);
  /// Draws the next frame from all events taken. Replaces `triangles`, which are empty if nothing is visible.
  /// Equal input gives an equal frame: no time passes.
  PanelResult draw(const PanelInput& input, PanelTriangles& triangles);
  /// Positions of widgets in the last frame; those scrolled out of sight may lie outside of the window.
  [[nodiscard]] const WidgetPlacements& placements() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::view
