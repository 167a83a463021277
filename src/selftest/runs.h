/// The functions under test: pictures and cells of one device.
#pragma once

#include <functional>
#include <memory>

#include "vorpipe.h"

namespace vorpipe::selftests {

class Runs {
 public:
  virtual ~Runs() = default;
  virtual Result<Rendering> render(const Sites& sites, const RenderOptions& options) = 0;
  virtual Result<Diagram> cells(const Sites& sites, const CellsOptions& options) = 0;
  virtual Result<Arithmetic> arithmetic() = 0;
};

/// Opens the device with a mask.
using OpenRuns = std::function<Result<std::unique_ptr<Runs>>(const Mask& mask)>;

/// The runs of a session opened with `options`; masks add their limits to the options' own.
OpenRuns sessionRuns(const BackendOptions& options);

}  // namespace vorpipe::selftests
