/// What a key or a button of the panel asks for.
#pragma once

#include <cstdint>

namespace vorpipe::view {

enum class Action : std::uint8_t {
  undo,
  redo,
  fit,   ///< shows the whole domain
  step,  ///< one step of relaxation, or of a fluid
  run,   ///< relaxes or flows until it is told to pause
  pause,
  begin_again,  ///< the fluid as it was at first
  save_png,     ///< the picture, without the panel
  save_svg,
  save_sites,    ///< a .csv of the sites
  save_fluid,    ///< a checkpoint, for `vorpipe fluid --resume`
  next_backend,  ///< of those that work here
  compare,       ///< with another backend, or no more
  copy_command,  ///< the command line that makes this picture, to the clipboard and to standard output
  close,
};

}  // namespace vorpipe::view
