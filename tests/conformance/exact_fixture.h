/// Sessions of a backend whose cells are held to exact ones.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/exact/exact_comparison.h"
#include "support/exact/exact_triangles.h"
#include "support/shared.h"
#include "vorpipe.h"

namespace vorpipe::test {

inline CellsOptions cellsOptions(const Box& domain, Search method = Search::grid, int neighbors = 30) {
  CellsOptions options{};
  options.domain = domain;
  options.search = {method, neighbors};
  return options;
}

inline void expectExact(const Diagram& diagram, const Sites& sites, const Box& domain,
                        const ExactCells& exact) {
  const auto comparison = compareWithExact(diagram, sites, domain, exact);
  EXPECT_TRUE(comparison.agree()) << comparison.summary();
  for (const auto& fault : comparison.first) ADD_FAILURE() << fault;
  for (const auto& fault : findTriangleFaults(diagram, sites, domain, exact).first) ADD_FAILURE() << fault;
}

inline void expectExact(Session& session, const Sites& sites, const CellsOptions& options,
                        const ExactCells& exact) {
  const auto diagram = session.cells(sites, options);
  ASSERT_TRUE(diagram) << diagram.error().message;
  EXPECT_EQ(diagram->report.validation_messages, std::vector<std::string>{});
  expectExact(*diagram, sites, options.domain, exact);
}

/// Opens a backend's session once; it serves all tests of the process.
class OnBackend {
 protected:
  static BackendOptions backendOptions(const std::string& name) {
    BackendOptions options;
    options.name = name;
    options.validation = true;
    return options;
  }

  static Session& session(const std::string& name) {
    return Shared<Session>::get(name, [&] {
      auto opened = Session::open(backendOptions(name));
      if (!opened) throw std::runtime_error(opened.error().message);
      return std::move(*opened);
    });
  }
};

}  // namespace vorpipe::test
