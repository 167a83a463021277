/// Sessions of a backend for the tests of cells as data.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/devices/backends.h"
#include "support/oracles/cell_oracle.h"
#include "support/shared.h"
#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {

inline CellsOptions within(const Box& domain, SearchOptions search = {}, Detail detail = Detail::everything) {
  CellsOptions wanted{};
  wanted.domain = domain;
  wanted.search = search;
  wanted.detail = detail;
  return wanted;
}

class Cells : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_UNUSABLE(GetParam()); }

  static BackendOptions backend(const char* name) {
    BackendOptions chosen;
    chosen.name = name;
    chosen.validation = true;
    return chosen;
  }

  static Session open(const BackendOptions& chosen) {
    auto session = Session::open(chosen);
    if (!session) throw std::runtime_error(session.error().message);
    return std::move(*session);
  }

  /// One for all tests of a process.
  static Session& sharedSession(const char* name) {
    return Shared<Session>::get(name, [&] { return open(backend(name)); });
  }

  static Diagram cells(Session& session, const Sites& sites, const CellsOptions& wanted) {
    auto diagram = session.cells(sites, wanted);
    if (!diagram) throw std::runtime_error(diagram.error().message);
    EXPECT_EQ(diagram->report.validation_messages, std::vector<std::string>{});
    return std::move(*diagram);
  }

  static Diagram cells(const Sites& sites, const CellsOptions& wanted) {
    return cells(sharedSession(GetParam()), sites, wanted);
  }

  static Diagram expectTiled(const Sites& sites, const Box& domain = unit) {
    auto diagram = cells(sites, within(domain));
    expectTiling(diagram, sites, domain);
    return diagram;
  }
};

}  // namespace vorpipe::test
