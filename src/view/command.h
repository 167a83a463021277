/// The command line that makes the picture of a window.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "view/document.h"
#include "vorpipe/devices.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {

/// The files that a command line reads and writes.
struct CommandFiles {
  std::string sites;    ///< of the document; not read where it is as it was opened
  std::string outline;  ///< likewise, and where there is an outline
  std::string picture = "picture.png";
};

/// `vorpipe render` and its options, which draw `picture` of the document's sites with the ids that it has.
std::vector<std::string> commandFor(const Document& document, const RenderOptions& picture,
                                    const BackendOptions& backend, const CommandFiles& files);

/// `vorpipe fluid` and its options, which go on from a checkpoint: of its pictures the first is `picture`.
std::vector<std::string> commandForFluid(const std::string& checkpoint, const RenderOptions& picture,
                                         FlowColor color, const BackendOptions& backend);

/// Writes sites as CSV, numbers with as many digits as tell them apart. Errors: those of OutputFile.
Result<void> writeSites(const std::string& path, const Sites& sites);

/// Writes an outline as WKT, likewise.
Result<void> writeOutline(const std::string& path, const Outline& outline);

}  // namespace vorpipe::view
