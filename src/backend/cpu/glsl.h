/// The words of shaders/glsl as C++ with GLM understands them: the twin of vocabulary.glsl.
/// A struct that includes cell.glsl defines `real`, MAX_EDGES and the accessors itself.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <limits>

#define EDGES(T, name) T name[static_cast<std::size_t>(MAX_EDGES)]
#define EDGE_END edgeEnd()
#define IN(T) const T&
#define INOUT(T) T&
#define ROUNDING (std::numeric_limits<real>::epsilon() / real(2))

namespace vorpipe::cpu {
using std::abs;
using std::max;
using std::min;
using std::sqrt;
}  // namespace vorpipe::cpu
