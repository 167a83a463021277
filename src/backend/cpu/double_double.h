/// What the search for a cell needs of a number type, for double-double.
#pragma once

#include "backend/cpu/glsl.h"
#include "base/double_double.h"

namespace vorpipe::cpu {

template <>
struct Number<DoubleDouble> {
  static DoubleDouble rounding() { return DoubleDouble(0x1p-101); }
  static DoubleDouble far() { return DoubleDouble(1e100); }
  static DoubleDouble nowhere() { return DoubleDouble(1e-150); }
  static DoubleDouble same() { return DoubleDouble(1e-120); }
};

}  // namespace vorpipe::cpu
