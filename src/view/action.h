/// Actions that a key or a panel button can request.
#pragma once

#include <cstdint>

namespace vorpipe::view {

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
