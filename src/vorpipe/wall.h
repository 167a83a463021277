/// The walls that bound cells where they have no neighbor.
#pragma once

#include <cstdint>
#include <string_view>

namespace vorpipe {

/// The sides of the domain, in the plane its outline, and in space zmin and zmax. Lists of neighbors contain
/// a wall as its number; sites are nonnegative.
enum class Wall : std::int64_t {
  xmin = -1,
  xmax = -2,
  ymin = -3,
  ymax = -4,
  outline = -5,
  zmin = -6,
  zmax = -7
};

/// Whether a neighbor is a wall, static_cast<Wall>(neighbor), and not a site.
constexpr bool isWall(std::int64_t neighbor) { return neighbor < 0; }

/// Its name: "xmin", "outline".
constexpr std::string_view nameOf(Wall wall) {
  switch (wall) {
    case Wall::xmin:
      return "xmin";
    case Wall::xmax:
      return "xmax";
    case Wall::ymin:
      return "ymin";
    case Wall::ymax:
      return "ymax";
    case Wall::zmin:
      return "zmin";
    case Wall::zmax:
      return "zmax";
    case Wall::outline:
      break;
  }
  return "outline";
}

/// The same numbers, as they appear in lists with sites.
inline constexpr auto wall_xmin = static_cast<std::int64_t>(Wall::xmin),
                      wall_xmax = static_cast<std::int64_t>(Wall::xmax),
                      wall_ymin = static_cast<std::int64_t>(Wall::ymin),
                      wall_ymax = static_cast<std::int64_t>(Wall::ymax),
                      wall_outline = static_cast<std::int64_t>(Wall::outline),
                      wall_zmin = static_cast<std::int64_t>(Wall::zmin),
                      wall_zmax = static_cast<std::int64_t>(Wall::zmax);

}  // namespace vorpipe
