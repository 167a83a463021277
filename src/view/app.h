/// `vorpipe view`: the loop that has a window and a viewer meet.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/screen.h"
#include "view/script.h"
#include "view/viewer.h"

namespace vorpipe::view {

struct AppOptions {
  ViewerOptions viewer{};
  std::optional<Script> script{};
  std::string record{};      ///< a film or a folder; empty: none
  std::string screenshot{};  ///< of what is shown after `frames` pictures, after which it closes; empty: none
  std::uint64_t frames = 1;
  std::function<bool()> is_stopped;  ///< asked often; true ends it
};

struct AppEnd {
  std::uint64_t pictures = 0;
  std::string computed_by{};
  std::vector<std::string> validation{};  ///< what the validation layers said
};

/// Runs until the window is closed, `is_stopped`, or `frames` were shown. Errors: no backend works, or the
/// sites cannot be drawn at all; a script waited too long; a file cannot be written.
Result<AppEnd> run(Screen& screen, AppOptions options);

}  // namespace vorpipe::view
