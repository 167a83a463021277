/// A film encoded by ffmpeg.
#pragma once

#include <memory>
#include <string>

#include "view/recorder.h"

namespace vorpipe::view {

Result<std::unique_ptr<Recorder>> openFilm(const std::string& path);

}  // namespace vorpipe::view
