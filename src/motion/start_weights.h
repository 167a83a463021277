/// Weights with which every cell has some of its mass, to begin with.
#pragma once

#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// Weights for which the point of `into` that lies as the site does in the box of all sites belongs to the
/// site's cell, so that no cell is empty, wherever the sites are (Meyron 2019, section 3.3: the weights of a
/// convex function's gradient). Sites on one line, or all at one place, stay as they are across it.
/// Along an axis that repeats, cells are where the sites are as they stand, and sites stay as they are too.
std::vector<double> spreadWeights(const Sites& sites, const Box& into, Periodic periodic);

/// Whether the box of all sites is about that of the domain: then equal weights are a better start.
/// Axes that repeat are full.
bool fillDomain(const Sites& sites, const Box& domain, Periodic periodic);

/// Takes their mean from all, which changes no cell, but for a free surface's. Newton steps have the mean 0.
/// To center what they led to would round the least weights off, after they were measured.
void centerWeights(std::vector<double>& weights, int threads);

/// Weights of discs that have the masses where no two of them meet.
std::vector<double> discWeights(std::span<const double> masses);

}  // namespace vorpipe::moving
