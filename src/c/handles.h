/// What is behind the opaque types of vorpipe_c.h.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "c/vorpipe_c.h"
#include "vorpipe.h"

struct vorpipe_devices {
  std::vector<vorpipe::DeviceInfo> infos;
};

struct vorpipe_session {
  vorpipe::Session session;
  int threads;
};

/// Diagrams and pictures share the sites, which a change of the input replaces.
struct vorpipe_input {
  std::shared_ptr<const vorpipe::Sites> sites;
  vorpipe::Box domain{};
  vorpipe::Outline outline{};
  vorpipe::Periodic periodic = vorpipe::Periodic::none;
  vorpipe::Density density{};
  bool of_unit_square = false;  ///< made by a generator
};

struct vorpipe_diagram {
  std::shared_ptr<const vorpipe::Sites> sites;
  vorpipe::CellsOptions options;  ///< of the run; without progress
  vorpipe::Diagram diagram;
  mutable std::once_flag topology_once;
  mutable std::optional<vorpipe::Result<vorpipe::Topology>> topology;  ///< found when first asked for
};

struct vorpipe_locator {
  vorpipe::Locator locator;
};

struct vorpipe_picture {
  std::shared_ptr<const vorpipe::Sites> sites;  ///< none where it was read
  vorpipe::RenderOptions options;               ///< of the run; without progress
  vorpipe::Rendering rendering;
};
