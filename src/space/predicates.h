/// Exact signs about sites in space and walls of a box: a filter in double with an error bound; where it
/// fails, integers of fixed width; where those are too short, integers of any width.
///
/// Range: coordinates up to 2^195 (of sites and walls), weights up to 2^390. There is no least difference:
/// products that underflow are part of the error bounds. Needs numbers below 2^-1022 as IEEE 754 has them (no
/// flush to zero), and sums and products that are rounded one by one (-ffp-contract=off).
#pragma once

#include <cstdint>

#include "space/label.h"

namespace vorpipe::space {

/// The sign of det(d_j, d_k, d_l), exact: d of a site is its place less that of site i; d of a wall is its
/// outward normal. 1: seen from outside, the faces of j, k, l turn counter-clockwise around the vertex
/// (i; j, k, l) of the cell of i. 0: they have no common point, or infinitely many.
int orientation(const Places& places, Label i, Label j, Label k, Label l);

/// Whether label m cuts the vertex (i; j, k, l) off the cell of site i: it is nearer to site m than to i
/// (with weights: its power is less), or beyond the wall m. Exact; orientation(i; j, k, l) must not be 0, and
/// m is none of the four.
///
/// Ties are broken by heights: every lifted height |x|^2 of a site (less its weight), and every offset of a
/// wall, is lowered by an infinitesimal: those of walls first (wall 0 by infinitely more than wall 1, ...),
/// then those of sites in lexicographic order of their coordinates, each by infinitely more than the next. So
/// the answer depends only on places, is the same for translated sites, and all cells agree.
bool cuts(const Places& places, Label i, Label j, Label k, Label l, Label m);

/// How often the filter in double did not suffice, on this thread so far.
std::uint64_t exactSigns();

}  // namespace vorpipe::space
