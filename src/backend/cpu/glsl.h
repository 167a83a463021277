/// The vocabulary of shaders/glsl in C++ with GLM: the counterpart of vocabulary.glsl. A struct that includes
/// cell.glsl defines `real`, MAX_EDGES and the accessors itself.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <limits>
#include <type_traits>

#define cell_int int
#define cell_bool bool
#define ANY(condition) (condition)
#define CUTTING
#define UNROLL
#define EDGES(T, name) T name[static_cast<std::size_t>(MAX_EDGES)]
#define EDGE_END edgeEnd()
#define IN(T) const T&
#define INOUT(T) T&
#define ROUNDING Number<real>::rounding()
#define FAR Number<real>::far()
#define NOWHERE Number<real>::nowhere()
#define SAME Number<real>::same()

namespace vorpipe::cpu {

using std::abs;
using std::max;
using std::min;
using std::sqrt;

/// Properties of a number type; see cell.glsl for the terms.
template <class Real>
struct Number;

template <>
struct Number<float> {
  static constexpr float rounding() { return 5.9604645e-8F; }
  static constexpr float far() { return 1e30F; }
  static constexpr float nowhere() { return 1e-36F; }
  static constexpr float same() { return 1e-30F; }
};

template <>
struct Number<double> {
  static constexpr double rounding() { return 1.1102230246251565e-16; }
  static constexpr double far() { return 1e100; }
  static constexpr double nowhere() { return 1e-150; }
  static constexpr double same() { return 1e-120; }
};

template <class Real>
Real lesserWhere(const Real& sign, const Real& a, const Real& b) {
  return sign > Real(0) && a < b ? a : b;
}
template <class Real>
Real greaterWhere(const Real& sign, const Real& a, const Real& b) {
  return sign > Real(0) && a > b ? a : b;
}

/// For other number types: GLM's vectors hold only plain numbers.
template <class Real>
struct Pair {
  Real x, y;
  Pair(Real first, Real second) : x(std::move(first)), y(std::move(second)) {}
};

template <class Real>
struct Quadruple {
  Real x, y, z, w;
  Quadruple(Real first, Real second, Real third, Real fourth)
      : x(std::move(first)), y(std::move(second)), z(std::move(third)), w(std::move(fourth)) {}
};

template <class Real>
using Vec2 = std::conditional_t<std::is_floating_point_v<Real>, glm::vec<2, Real>, Pair<Real>>;
template <class Real>
using Vec4 = std::conditional_t<std::is_floating_point_v<Real>, glm::vec<4, Real>, Quadruple<Real>>;

}  // namespace vorpipe::cpu
