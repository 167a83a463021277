/// What a window asks the render thread for, and the answers.
#pragma once

#include <cstdint>
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

/// Only the latest wish is sure to be fulfilled.
struct Wish {
  std::uint64_t number = 0;  ///< larger than all before
  /// Equal for all wishes of one gesture (panning, zooming, dragging a site). A picture of an earlier gesture
  /// is abandoned; one of the same gesture is finished, so that pictures keep appearing.
  std::uint64_t gesture = 0;
  FixedSites sites{};
  RenderOptions picture{};  ///< with domain, view and size; its progress is not used
  BackendOptions backend{};
  std::string not_cpu{};  ///< backend to prefer where `backend` resolves to `cpu`; empty: none
  std::optional<BackendOptions> compared{};  ///< draws the same picture for comparison
  /// If a sharp picture takes more milliseconds, a preview precedes it during a drag.
  double longest_without_preview = 60;
  Motion motion = Motion::rests;  ///< unless they rest, sites take a step before the picture is drawn
  RelaxMethod method = RelaxMethod::lloyd;
  std::shared_ptr<const Density> density{};  ///< may be null
  FixedFluid fluid{};  ///< fluid of the sites, which flows instead of relaxing; null: no fluid
  FlowColor flow_color = FlowColor::none;
  std::vector<Stroke> strokes{};  ///< all up to the latest; those the fluid already includes are skipped
};

/// A picture.
struct Frame {
  std::uint64_t wish = 0;
  FixedSites sites{};         ///< drawn sites
  FixedSites relaxed_from{};  ///< null: `sites` are those of the wish; else the sites one step before
  std::optional<RelaxStep> step{};
  bool relaxed = false;     ///< there was nothing more to move
  FixedFluid fluid{};       ///< drawn fluid, which has `sites`
  FixedFluid fluid_from{};  ///< its state before the wish; the same if unchanged
  FlowColor flow_color = FlowColor::none;
  bool flowed = false;              ///< made a step
  std::optional<FluidEnd> ended{};  ///< why a wished step was not made
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

/// An answer of the render thread; any of its members may be set.
struct Answer {
  std::uint64_t wish = 0;        ///< the answered wish; 0: none
  std::optional<Frame> frame{};  ///< sharp
  std::optional<Frame>
      preview{};  ///< with half as many rows and columns, before the sharp one; `wish` is 0 then
  std::shared_ptr<const Measures> measures{};
  std::optional<DeviceInfo> device{};  ///< computes from now on
  std::vector<DeviceInfo> devices{};   ///< all existing devices
  std::optional<Error> error{};        ///< why there is no picture, or no file
  std::string saved{};                 ///< the path of a saved file
  std::optional<Loaded> loaded{};
  std::string loaded_path{};              ///< of `loaded`
  std::vector<std::string> validation{};  ///< messages of the validation layers
};

}  // namespace vorpipe::view
