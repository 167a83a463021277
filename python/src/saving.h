/// Files that hold the whole of what was to be written, or stay as they were.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "errors.h"
#include "io/base/output_file.h"
#include "runs.h"
#include "vorpipe.h"

namespace vorpipe::python {

/// Has `write` fill a file, without the GIL, which is none of those that `inputs` names. Throws what goes
/// wrong; the file is then what it was.
template <class Write>
void saveFile(const std::string& path, const std::vector<std::string>& inputs, const Write& write) {
  for (const std::string& input : inputs) {
    std::error_code none;
    if (!std::filesystem::equivalent(path, input, none)) continue;
    raiseInput("path", path + ": is what this was computed from, and would be replaced; name another file");
  }
  auto saved = [&]() -> Result<void> {
    const WithoutGil no_gil;
    return writeFile(path, write);
  }();
  valueOf(std::move(saved));
}

}  // namespace vorpipe::python
