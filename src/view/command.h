/// The command line that reproduces a window's picture.
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
  std::string sites;    ///< of the document; not used while the document is as it was opened
  std::string outline;  ///< likewise; only if there is an outline
  std::string picture = "picture.png";
};

/// Returns `vorpipe render` with the options that draw `picture` of the document's sites, with the same ids.
std::vector<std::string> commandFor(const Document& document, const RenderOptions& picture,
                                    const BackendOptions& backend, const CommandFiles& files);

/// Returns `vorpipe fluid` with the options that continue from a checkpoint; its first picture is `picture`.
std::vector<std::string> commandForFluid(const std::string& checkpoint, const RenderOptions& picture,
                                         FlowColor color, const BackendOptions& backend);

/// Writes sites as CSV, each number with enough digits to be read back exactly. Errors: those of OutputFile.
Result<void> writeSites(const std::string& path, const Sites& sites);

/// Writes an outline as WKT, likewise.
Result<void> writeOutline(const std::string& path, const Outline& outline);

}  // namespace vorpipe::view
