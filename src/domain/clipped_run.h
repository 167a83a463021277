/// The input of clipping to an outline.
#pragma once

#include "cells/neighbor_rows.h"
#include "sites/site_set.h"

namespace vorpipe::core {

/// The sites and the domain of a diagram, and the cells as they were found.
struct ClippedRun {
  const Sites& sites;
  const Box& domain;
  const SiteSet& set;
  const NeighborRows& rows;
  int exponent;  ///< computation is in the caller's units times 2^exponent
  int threads;
};

}  // namespace vorpipe::core
