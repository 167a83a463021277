/// Hard inputs on one backend after another: what fails, and the smallest input that still does.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "support/hard/hard_inputs.h"

namespace vorpipe::test {

/// Whether an error is the refusal of sites that are too near to each other, which is found when they have
/// been sorted; what else is refused checkInput() says.
bool isRefusal(const Error& error);

/// A promise that was broken.
struct HardFault {
  std::string backend;
  std::string run;      ///< cells or picture
  std::string message;  ///< of the error, the check or the comparison
  /// What faults of one cause have in common: the message's beginning without numbers.
  [[nodiscard]] std::string kind() const;
};

struct HardResult {
  bool refused = false;  ///< as what no backend takes
  std::string refusal;
  std::vector<HardFault> faults;
};

/// What is run of an input.
struct HardPlan {
  bool cells = true, pictures = true;
  int threads = 0;  ///< of the checks
};

/// Runs an input on each session: cells and picture are checked, and compared with those of the first one.
HardResult runHardInput(const HardInput& input, std::span<Session* const> sessions, const HardPlan& plan);

/// Takes sites away as long as a fault of the same backend, run and kind is left; gives up after so long.
HardInput shrunken(const HardInput& input, const HardFault& fault, std::span<Session* const> sessions,
                   double most_seconds);

}  // namespace vorpipe::test
