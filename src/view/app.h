/// `vorpipe view`: the main loop, which connects a window to a viewer.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/script.h"
#include "view/viewer.h"
#include "view/window/window.h"

namespace vorpipe::view {

struct AppOptions {
  ViewerOptions viewer{};
  std::optional<Script> script{};
  std::string record{};      ///< path of a film or a folder; empty: none
  std::string screenshot{};  ///< path; taken after `frames` pictures, then the window closes; empty: none
  std::uint64_t frames = 1;
  std::function<bool()> is_stopped;  ///< polled often; true ends the loop
};

struct AppEnd {
  std::uint64_t pictures = 0;
  std::string computed_by{};
  std::vector<std::string> validation{};  ///< messages of the validation layers
};

/// Runs until the window is closed, `is_stopped` returns true, or `frames` pictures were shown. Errors: no
/// backend works, or the sites cannot be drawn at all; a script waited too long; a file cannot be written.
Result<AppEnd> run(Screen& screen, AppOptions options);

}  // namespace vorpipe::view
