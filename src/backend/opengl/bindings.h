/// Where programs find data on the device.
#pragma once

#include <cstdint>

#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// Texture units and the uniform binding that every program uses.
inline constexpr GLuint lines_unit = 0;
inline constexpr GLuint palette_unit = 1;
inline constexpr GLuint sites_unit = 2;
inline constexpr GLuint bins_unit = 3;
inline constexpr GLuint marks_unit = 4;
inline constexpr GLuint weights_unit = 5;
inline constexpr GLuint heaviest_unit = 6;
inline constexpr GLuint view_binding = 0;
inline constexpr GLuint grid_binding = 1;

/// What a program takes for each point.
enum class Entries : std::uint8_t {
  lists,           ///< an entry of a batch
  sites,           ///< the index of a site of the upload
  weighted_sites,  ///< the same, of sites with weights
};

}  // namespace vorpipe::opengl
