/// Programs from GLSL 4.10 text.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "backend/backend.h"
#include "backend/opengl/bindings.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// Number of programs of a kind: one for each Entries and each of the capacities small and large.
inline constexpr std::size_t programs = 6;
std::size_t programOf(Entries entries, Capacity capacity);

struct ProgramText {
  std::string_view vertex, geometry, fragment;  ///< fragment may be empty: nothing is drawn
  std::span<const char* const> captured;        ///< outputs for transform feedback, interleaved
};

/// A program that is compiled on first use. Its context owns it.
class Program {
 public:
  /// Makes it the current program; `text` must be the same in every call. Error (device): the driver's log.
  Result<void> use(const ProgramText& text);

 private:
  GLuint name_ = 0;
};

}  // namespace vorpipe::opengl
