#include "sites/cut_out.h"

#include <algorithm>
#include <numeric>

#include "sites/weight_pyramid.h"

namespace vorpipe::core {
namespace {

/// Adds the set's weights and heavy sites to a part, which already holds the sites in a block of the set's
/// bins. Heavy sites from elsewhere follow after the bins.
void takeWeights(const SiteSet& sites, const BinBlock& block, SiteSet& part,
                 std::vector<std::uint32_t>& whole) {
  const auto in_bins = static_cast<std::ptrdiff_t>(whole.size());
  for (const auto heavy : sites.heavy) {
    const auto end = whole.begin() + in_bins;
    const auto at = std::find(whole.begin(), end, heavy);
    part.heavy.push_back(static_cast<std::uint32_t>((at == end ? whole.end() : at) - whole.begin()));
    if (at != end) continue;
    whole.push_back(heavy);
    part.x.push_back(sites.x[heavy]);
    part.y.push_back(sites.y[heavy]);
    part.id.push_back(sites.id[heavy]);
  }
  for (const auto site : whole) part.weight.push_back(sites.weight[site]);
  for (auto row = block.south; row <= block.north; ++row) {
    const auto of_row = std::span(sites.grid.heaviest)
                            .subspan(std::size_t{row} * sites.grid.columns + block.west,
                                     block.east - block.west + std::size_t{1});
    part.grid.heaviest.insert(part.grid.heaviest.end(), of_row.begin(), of_row.end());
  }
  countBeyond(sites, block, part);
  buildPyramid(part.grid);
}

}  // namespace

SiteSet cutOut(const SiteSet& sites, const BinBlock& block, std::vector<std::uint32_t>& whole) {
  const auto& grid = sites.grid;
  const auto x = [&](std::uint32_t column) { return grid.xmin + column * grid.size; };
  const auto y = [&](std::uint32_t row) { return grid.ymin + row * grid.size; };
  SiteSet set;
  set.domain = sites.domain;
  set.shorter_side = sites.shorter_side;
  set.has_images = sites.has_images;
  const auto& coverage = sites.coverage;
  set.coverage = {block.west == 0 ? coverage.xmin : x(block.west),
                  block.south == 0 ? coverage.ymin : y(block.south),
                  block.east + 1 == grid.columns ? coverage.xmax : x(block.east + 1),
                  block.north + 1 == grid.rows ? coverage.ymax : y(block.north + 1)};
  set.grid = {x(block.west),
              y(block.south),
              grid.size,
              block.east - block.west + 1,
              block.north - block.south + 1,
              {0}};
  whole.clear();
  for (auto row = block.south; row <= block.north; ++row) {
    const auto bin = std::size_t{row} * grid.columns;
    const auto begin = grid.offsets[bin + block.west];
    const auto end = grid.offsets[bin + block.east + 1];
    const auto row_first = static_cast<std::uint32_t>(whole.size());
    for (auto column = block.west; column <= block.east; ++column) {
      set.grid.offsets.push_back(grid.offsets[bin + column + 1] - begin + row_first);
    }
    whole.resize(whole.size() + (end - begin));
    std::iota(whole.begin() + row_first, whole.end(), begin);
    set.x.insert(set.x.end(), sites.x.begin() + begin, sites.x.begin() + end);
    set.y.insert(set.y.end(), sites.y.begin() + begin, sites.y.begin() + end);
    set.id.insert(set.id.end(), sites.id.begin() + begin, sites.id.begin() + end);
  }
  if (!sites.weight.empty()) takeWeights(sites, block, set, whole);
  return set;
}

}  // namespace vorpipe::core
