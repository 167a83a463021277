/// Which backends the tests run on, and which they may leave out.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::test {

inline constexpr std::array backend_names{"cpu", "vulkan-geometry", "vulkan-compute", "opengl"};

/// A backend's name as that of a test may be: without hyphens.
inline std::string testName(std::string_view backend) {
  std::string name(backend);
  std::erase(name, '-');
  return name;
}

/// Why a backend cannot be used here; empty if it can. Asks the drivers only once.
inline std::string whyUnusable(std::string_view backend) {
  static const auto known = devices({});
  std::string reason = "there is no backend of this name";
  for (const auto& device : known) {
    if (device.backend != backend) continue;
    if (device.usable) return {};
    reason = device.reason;
  }
  return reason;
}

/// Whether a backend must be usable: VORPIPE_EXPECTED_BACKENDS, as the build sets it where the software
/// drivers are installed, names it. Then a test of it fails where it would be skipped elsewhere.
inline bool isExpected(std::string_view backend) {
  if (backend == "cpu") return true;
  const char* expected = std::getenv("VORPIPE_EXPECTED_BACKENDS");
  std::string_view names(expected ? expected : "");
  while (!names.empty()) {
    const auto name = names.substr(0, names.find(','));
    if (name == backend) return true;
    names.remove_prefix(std::min(name.size() + 1, names.size()));
  }
  return false;
}

/// In a test or its SetUp: leaves it where its backend cannot be used.
#define SKIP_UNUSABLE(backend)                                                                         \
  if (const auto reason = vorpipe::test::whyUnusable(backend); !reason.empty()) {                      \
    if (vorpipe::test::isExpected(backend)) FAIL() << (backend) << " must be usable here: " << reason; \
    GTEST_SKIP() << (backend) << ": " << reason;                                                       \
  }

}  // namespace vorpipe::test
