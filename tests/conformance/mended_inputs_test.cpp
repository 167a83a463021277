// Inputs that were wrong once: the same for every backend.
#include <gtest/gtest.h>

#include <array>

#include "conformance/cells_fixture.h"
#include "support/hard/hard_runs.h"
#include "support/mended/mended_inputs.h"

namespace vorpipe::test {
namespace {

using MendedInputs = Cells;

TEST_P(MendedInputs, keepTheirPromises) {
  const std::array<Session*, 2> sessions{&sharedSession("cpu"), &sharedSession(GetParam())};
  for (const HardInput& input : mendedInputs()) {
    SCOPED_TRACE(input.kinds);
    const auto result = runHardInput(input, sessions, {});
    EXPECT_FALSE(result.refused) << result.refusal;
    for (const HardFault& fault : result.faults)
      ADD_FAILURE() << fault.backend << " " << fault.run << ": " << fault.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, MendedInputs, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
