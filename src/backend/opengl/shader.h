/// Programs from GLSL 4.10 text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "backend/backend.h"
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

/// How many programs there are of a kind: one for each Entries and each of the efforts fast and roomy.
inline constexpr std::size_t programs = 6;
std::size_t programOf(Entries entries, Effort effort);

struct ProgramText {
  std::string_view vertex, geometry, fragment;  ///< fragment may be empty: nothing is drawn
  std::span<const char* const> captured;        ///< outputs for transform feedback, interleaved
};

/// One that is compiled when it is first used. Its context owns it.
class Program {
 public:
  /// Makes it the one that is drawn with, from a text that is always the same. Error (device): the driver's
  /// log.
  Result<void> use(const ProgramText& text);

 private:
  GLuint name_ = 0;
};

}  // namespace vorpipe::opengl
