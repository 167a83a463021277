/// Files that hold the whole of what was to be written, or stay as they were.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "errors.h"
#include "io/files/output_file.h"
#include "runs.h"
#include "vorpipe.h"

namespace vorpipe::python {

/// Has `write` fill a file, without the GIL. Throws what goes wrong; the file is then what it was.
template <class Write>
void saveFile(const std::string& path, const Write& write) {
  auto saved = [&]() -> Result<void> {
    const WithoutGil no_gil;
    auto file = OutputFile::create(path);
    if (!file) return tl::unexpected(std::move(file.error()));
    auto written = write(*file);
    return written ? file->commit() : written;
  }();
  valueOf(std::move(saved));
}

}  // namespace vorpipe::python
