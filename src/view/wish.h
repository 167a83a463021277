/// What a window wants to show, and what it gets.
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

/// The latest is fulfilled; those before it need not be.
struct Wish {
  std::uint64_t number = 0;  ///< above that of all before
  /// Wishes of one gesture (panning, zooming, dragging a site) have the same. A picture of an earlier gesture
  /// is given up; one of the same is finished, so that pictures appear meanwhile.
  std::uint64_t gesture = 0;
  FixedSites sites{};
  RenderOptions picture{};  ///< with all that is drawn: domain, view, size; its progress is not read
  BackendOptions backend{};
  std::string not_cpu{};  ///< the backend that is taken where that comes to `cpu`; empty: none
  std::optional<BackendOptions> compared{};  ///< draws the same picture, to compare with
  /// Milliseconds of a sharp picture, above which a preview comes before it while something is dragged.
  double longest_without_preview = 60;
  Motion motion = Motion::rests;  ///< sites take a step before the picture is drawn, unless they rest
  RelaxMethod method = RelaxMethod::lloyd;
  std::shared_ptr<const Density> density{};  ///< may be null
  FixedFluid fluid{};  ///< that the sites are of, which flows instead of relaxing; null: they are no fluid's
  FlowColor flow_color = FlowColor::none;
  std::vector<Stroke> strokes{};  ///< through it, up to the latest: those that it does not have yet count
};

/// A picture.
struct Frame {
  std::uint64_t wish = 0;
  FixedSites sites{};         ///< that are drawn
  FixedSites relaxed_from{};  ///< null: `sites` are those of the wish; else they moved one step from these
  std::optional<RelaxStep> step{};
  bool relaxed = false;     ///< there is nothing more to move
  FixedFluid fluid{};       ///< that is drawn, and `sites` are of
  FixedFluid fluid_from{};  ///< what it was before the wish; the same where it has not changed
  FlowColor flow_color = FlowColor::none;
  bool flowed = false;              ///< by a step
  std::optional<FluidEnd> ended{};  ///< why there was no step, where one was wished
  RenderOptions picture{};
  std::shared_ptr<const Rendering> rendering{};
  std::shared_ptr<const Image>
      compared{};               ///< the same picture by the other backend; null: none was asked for
  std::uint64_t differing = 0;  ///< pixels in which the two differ
  std::string compared_by{};    ///< "cpu on ..."
  double milliseconds = 0;
};

/// What is told of the cell under the pointer.
struct Measures {
  FixedSites sites{};  ///< that they are of
  std::vector<double> area{};
  std::vector<std::uint32_t> neighbors{};
};

/// A file that is to be written: a picture, or where it ends in .csv, the sites, in .npz, the fluid.
struct Save {
  std::string path;
  FixedSites sites{};
  RenderOptions picture{};
  std::shared_ptr<const Rendering> rendering{};  ///< for pixels
  FixedFluid fluid{};                            ///< that the sites are of, if there is one
  FlowColor flow_color = FlowColor::none;
};

/// What is in a file that was to be loaded: sites, or a density for relaxing.
struct Loaded {
  std::optional<Opened> opened{};
  std::shared_ptr<const Density> density{};
};

/// Any of these.
struct Answer {
  std::uint64_t wish = 0;        ///< that it answers; 0: none
  std::optional<Frame> frame{};  ///< sharp
  std::optional<Frame>
      preview{};  ///< of half as many rows and columns, before the sharp one; `wish` is 0 then
  std::shared_ptr<const Measures> measures{};
  std::optional<DeviceInfo> device{};  ///< that computes from now on
  std::vector<DeviceInfo> devices{};   ///< all there are
  std::optional<Error> error{};        ///< why there is no picture, or no file
  std::string saved{};                 ///< the path of a file
  std::optional<Loaded> loaded{};
  std::string loaded_path{};              ///< of `loaded`
  std::vector<std::string> validation{};  ///< what the validation layers said
};

}  // namespace vorpipe::view
