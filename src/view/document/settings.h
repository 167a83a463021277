/// What a window shows of its sites, apart from where: what keys, the panel and the command line change.
#pragma once

#include <string>

#include "vorpipe/devices.h"
#include "vorpipe/picture.h"
#include "vorpipe/relax.h"

namespace vorpipe::view {

/// Whether sites move by themselves.
enum class Motion : std::uint8_t { rests, steps_once, runs };

struct Settings {
  /// Colors, edges, sites, dual, labels, legend, outline, period, domain; width, height and view are the
  /// window's.
  RenderOptions picture{};
  bool cells = true;  ///< filled; else cells are white
  bool panel = true, help = false;
  BackendOptions backend{};
  RelaxMethod method = RelaxMethod::lloyd;
  Motion motion = Motion::rests;
  Density density{};         ///< for relaxing
  std::string density_path;  ///< where it came from
};

}  // namespace vorpipe::view
