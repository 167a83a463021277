/// Scenes that devices are tested with.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::selftests {

/// Sites, and the options for their cells and picture.
struct Scene {
  Sites sites;
  Box domain{0, 0, 1, 1};
  Outline outline{};
  Periodic periodic = Periodic::none;
  int width = 256, height = 256;  ///< of the picture
};

/// Parameters of a scene.
struct Scale {
  bool quick;
  std::uint64_t seed;
  /// Chooses `few` for quick tests, else `many`.
  [[nodiscard]] std::uint64_t of(std::uint64_t few, std::uint64_t many) const { return quick ? few : many; }
};

/// Limits lowered for a scene. A device is reopened for each of these.
enum class Masked : std::uint8_t {
  nothing,
  limits,  ///< few sites and bins at once, few cells per call
  bits,    ///< vertices on a coarse grid
};

enum class Traits : std::uint8_t {
  once = 0,     ///< made with one seed or none
  random = 1,   ///< other seeds give other scenes
  often = 2,    ///< likewise, but only some are hard: a quick test has several
  extreme = 3,  ///< beyond the supported range: it may be refused, but a wrong result is a fault
};

struct SceneKind {
  std::string_view group, name;
  Traits traits;
  Masked masked;
  Scene (*make)(const Scale& scale);
};

/// All kinds; those of a group follow each other.
std::span<const SceneKind> sceneKinds();

Mask maskOf(Masked masked, const Scale& scale);

}  // namespace vorpipe::selftests
