/// What devices are tested with.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::selftests {

/// Sites, and what is made of them.
struct Scene {
  Sites sites;
  Box domain{0, 0, 1, 1};
  Outline outline{};
  Periodic periodic = Periodic::none;
  int width = 256, height = 256;  ///< of the picture
};

/// What a scene is made from.
struct Scale {
  bool quick;
  std::uint64_t seed;
  /// A number for quick tests, and one for others.
  [[nodiscard]] std::uint64_t of(std::uint64_t few, std::uint64_t many) const { return quick ? few : many; }
};

/// Limits that are lowered for a scene. A device is opened anew for each of these.
enum class Masked : std::uint8_t {
  nothing,
  limits,  ///< few sites and bins at once, few cells in one call
  bits,    ///< vertices on a coarse grid
};

enum class Traits : std::uint8_t {
  once = 0,     ///< made with one seed, or without
  random = 1,   ///< other seeds give other scenes
  often = 2,    ///< and only some are hard: a quick test has several
  extreme = 3,  ///< beyond the numbers that work: that it is refused is right, a wrong result is not
};

struct SceneKind {
  std::string_view group, name;
  Traits traits;
  Masked masked;
  Scene (*make)(const Scale& scale);
};

/// All of them; those of a group one after another.
std::span<const SceneKind> sceneKinds();

Mask maskOf(Masked masked, const Scale& scale);

}  // namespace vorpipe::selftests
