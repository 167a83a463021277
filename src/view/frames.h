/// What a window requests of the render thread, the results, and the thread. So the window never waits.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/document.h"
#include "view/settings.h"
#include "vorpipe/devices.h"
#include "vorpipe/picture.h"
#include "vorpipe/relax.h"

namespace vorpipe::view {

/// Only the latest request is sure to be executed.
struct FrameRequest {
  std::uint64_t number = 0;  ///< larger than all before
  /// Equal for all requests of one gesture (panning, zooming, dragging a site). A picture of an earlier
  /// gesture is abandoned; one of the same gesture is finished, so that pictures keep appearing.
  std::uint64_t gesture = 0;
  FixedSites sites{};
  RenderOptions picture{};  ///< with domain, view and size; its progress is not used
  BackendOptions backend{};
  std::string not_cpu{};  ///< backend to prefer where `backend` resolves to `cpu`; empty: none
  std::optional<BackendOptions> compared{};  ///< draws the same picture for comparison
  /// If a sharp picture takes more milliseconds, a preview precedes it during a drag.
  double longest_without_preview = 60;
  Motion motion = Motion::rests;  ///< unless they rest, sites take a step before the picture is drawn
  bool several_steps = false;     ///< as many as take about as long as the picture; else one
  RelaxMethod method = RelaxMethod::lloyd;
  std::shared_ptr<const Density> density{};  ///< may be null
  FixedFluid fluid{};  ///< fluid of the sites, which flows instead of relaxing; null: no fluid
  FlowColor flow_color = FlowColor::none;
  std::vector<Stroke> strokes{};  ///< all up to the latest; those the fluid already includes are skipped
};

struct Frame {
  std::uint64_t request = 0;
  FixedSites sites{};         ///< drawn sites
  FixedSites relaxed_from{};  ///< null: `sites` are those of the request; else the sites one step before
  std::optional<RelaxStep> step{};
  bool relaxed = false;     ///< there was nothing more to move
  FixedFluid fluid{};       ///< drawn fluid, which has `sites`
  FixedFluid fluid_from{};  ///< its state before the request; the same if unchanged
  FlowColor flow_color = FlowColor::none;
  bool flowed = false;              ///< made a step
  std::optional<FluidEnd> ended{};  ///< why a requested step was not made
  RenderOptions picture{};
  std::shared_ptr<const Rendering> rendering{};
  std::shared_ptr<const Image> compared{};  ///< the same picture by the other backend; null: none requested
  std::uint64_t differing = 0;              ///< pixels in which the two differ
  std::string compared_by{};                ///< "cpu on ..."
  double milliseconds = 0;
};

/// Measures of all cells, for the one under the pointer.
struct Measures {
  FixedSites sites{};  ///< the measured sites
  std::vector<double> area{};
  std::vector<std::uint32_t> neighbors{};
};

/// A file to write: the sites if it ends in .csv, the fluid if in .npz, else a picture.
struct Save {
  std::string path;
  FixedSites sites{};
  RenderOptions picture{};
  std::shared_ptr<const Rendering> rendering{};  ///< for pixels
  FixedFluid fluid{};                            ///< fluid of the sites, if there is one
  FlowColor flow_color = FlowColor::none;
};

/// The contents of a loaded file: sites, or a density for relaxing.
struct Loaded {
  std::optional<Opened> opened{};
  std::shared_ptr<const Density> density{};
};

/// A result of the render thread; any of its members may be set.
struct RenderResult {
  std::uint64_t request = 0;     ///< the completed request; 0: none
  std::optional<Frame> frame{};  ///< sharp
  std::optional<Frame>
      preview{};  ///< with half as many rows and columns, before the sharp one; `request` is 0 then
  std::shared_ptr<const Measures> measures{};
  std::optional<DeviceInfo> device{};  ///< computes from now on
  std::vector<DeviceInfo> devices{};   ///< all existing devices
  std::optional<Error> error{};        ///< why there is no picture, or no file
  std::string saved{};                 ///< the path of a saved file
  std::optional<Loaded> loaded{};
  std::string loaded_path{};              ///< of `loaded`
  std::vector<std::string> validation{};  ///< messages of the validation layers
};

/// Reads a file. Called on the Frames thread.
using Load = std::function<Result<Loaded>(const std::string& path)>;

class Frames {
 public:
  /// `wake` is called, from the other thread, when there is a result.
  Frames(std::function<void()> wake, Load load);
  /// Cancels the work in progress.
  ~Frames();
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// Replaces an earlier request that has not begun.
  void request(FrameRequest request);
  /// Saves and loads run between two requests, in order.
  void save(Save save);
  void load(std::string path);
  /// The next result, if there is one.
  std::optional<RenderResult> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::view
