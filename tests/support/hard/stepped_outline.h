/// Rectilinear outlines.
#pragma once

#include <span>

#include "support/sites/random_sites.h"

namespace vorpipe::test {

/// What some random boxes cover together, without what others do: with sides on lines at `xs` and `ys`, which
/// ascend and are two at least each, in some parts, with holes; valid, with no two rings that touch. Some
/// corners lie on straight lines.
Outline steppedOutline(std::span<const double> xs, std::span<const double> ys, Random& random);

}  // namespace vorpipe::test
