/// What is opened once and serves all tests of a process.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace vorpipe::test {

/// Things by name. They are closed when all tests have run, before the process ends: drivers and layers,
/// which were loaded later than anything static here was made, are gone by the time that is destroyed.
template <class Opened>
class Shared final : public testing::Environment {
 public:
  /// The one of that name; open(), if there is none yet.
  template <class Open>
  static Opened& get(const std::string& name, const Open& open) {
    // Owned, and torn down, by the test framework.
    static auto* const shared = new Shared;
    static const auto* const registered = testing::AddGlobalTestEnvironment(shared);
    (void)registered;
    const auto known = shared->opened_.find(name);
    return known != shared->opened_.end() ? known->second
                                          : shared->opened_.emplace(name, open()).first->second;
  }

  void TearDown() override { opened_.clear(); }

 private:
  std::map<std::string, Opened> opened_;
};

}  // namespace vorpipe::test
