/// Scripts that drive a window, one event per line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "view/window/event.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

struct ScriptLine {
  Event event;
  std::size_t number = 0;  ///< of the line, from 1
};

struct Script {
  std::string name;  ///< of the file, for messages
  std::vector<ScriptLine> lines;
};

/// The possible values of Key::name.
const std::vector<std::string>& keyNames();

/// Reads a script; "-" is standard input. Errors: a wrong word, with file, line and column (input); reading
/// failed (device).
Result<Script> readScript(const std::string& path);

Result<Script> parseScript(const std::string& name, std::string_view text);

}  // namespace vorpipe::view
