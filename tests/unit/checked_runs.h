/// A right diagram and a right picture for the tests of what checks and compares them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

inline const CellsOptions unit_cells{{0, 0, 1, 1}, {}, Periodic::none, {}, {}, Detail::everything, {}};

/// 200 random sites; then site 200, a duplicate of site 7; 201, whose cell reaches in from outside; and
/// 202, far away and empty.
inline Sites mixedSites() {
  Sites sites = generate(Pattern::random, 200, 1);
  const auto add = [&](double x, double y) {
    sites.x.push_back(x);
    sites.y.push_back(y);
  };
  add(sites.x[7], sites.y[7]);
  add(1.01, 0.5);
  add(30, 40);
  return sites;
}

inline Session cpuSession() {
  BackendOptions options;
  options.name = "cpu";
  return std::move(*Session::open(options));
}

inline Diagram cellsOf(const Sites& sites, const CellsOptions& options) {
  auto cells = cpuSession().cells(sites, options);
  EXPECT_TRUE(cells) << cells.error().message;
  return std::move(*cells);
}

/// The promises that a check finds broken: what stands before the colon of each line.
inline std::vector<std::string> promisesOf(const Result<std::vector<std::string>>& lines) {
  if (!lines) return {lines.error().message};
  std::vector<std::string> promises;
  for (const std::string& line : *lines) promises.push_back(line.substr(0, line.find(':')));
  return promises;
}

}  // namespace vorpipe::test
