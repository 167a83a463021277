/// Records a window as a film or as numbered pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "vorpipe/picture.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

inline constexpr int frame_rate = 30;  ///< of films, per second

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Adds the next frame. All get the size of the first: a larger one is cropped at the right and the bottom,
  /// a smaller one padded with dark pixels.
  virtual Result<void> add(const Image& frame) = 0;
  /// Puts the film in place. Without this call there is no film.
  virtual Result<void> finish() = 0;
};

/// Writes a picture as a PNG file. Errors: those of OutputFile and writePng.
Result<void> savePng(const std::string& path, const Image& image);

inline constexpr std::string_view film_extension = ".mp4";

/// Opens a film by ffmpeg if the path ends in film_extension; else a folder of frame-00001.png and so on,
/// creating it if needed. Errors (input): the folder is not empty, or cannot be written; (device): there is
/// no ffmpeg on PATH.
Result<std::unique_ptr<Recorder>> openRecorder(const std::string& path);

/// Opens a folder of numbered frames that continues with number `first`, whatever it holds. Error (input): it
/// cannot be made.
Result<std::unique_ptr<Recorder>> openFrames(const std::string& folder, std::uint64_t first);

}  // namespace vorpipe::view
