/// What is clipped to an outline.
#pragma once

#include "cells/neighbor_rows.h"
#include "sites/site_set.h"

namespace vorpipe::core {

/// The sites of a diagram and its domain, and the cells that it is of, as they were found.
struct ClippedRun {
  const Sites& sites;
  const Box& domain;
  const SiteSet& set;
  const NeighborRows& rows;
  int exponent;  ///< what is computed is in units times 2^exponent
  int threads;
};

}  // namespace vorpipe::core
