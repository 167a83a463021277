/// What a window showed, as a film or as numbered pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "vorpipe/picture.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

/// Frames of a second of film.
inline constexpr int frame_rate = 30;

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// The next frame. All have the size of the first: of a larger one what is right and below is cut off,
  /// beside a smaller one it is dark.
  virtual Result<void> add(const Image& frame) = 0;
  /// Puts the film in place. Without it there is none.
  virtual Result<void> finish() = 0;
};

/// A film where the path ends in .mp4, made by ffmpeg; else a folder of frame-00001.png and so on, which is
/// made where it is not there. Errors (input): the folder holds something, or cannot be written; (device):
/// there is no ffmpeg on PATH.
Result<std::unique_ptr<Recorder>> openRecorder(const std::string& path);

/// A folder of numbered frames that continues with this number, whatever it holds. Error (input): it cannot
/// be made.
Result<std::unique_ptr<Recorder>> openFrames(const std::string& folder, std::uint64_t first);

}  // namespace vorpipe::view
