/// How long something took, by the clock and by what it used of the processor.
#pragma once

#include <ctime>

#include "base/stopwatch.h"

namespace vorpipe::test {

struct Taken {
  double seconds;
  double cpu_seconds;  ///< of all threads together: what does not depend on what else the machine does
};

/// Runs from its construction.
class JobWatch {
 public:
  [[nodiscard]] Taken taken() const {
    return {watch_.seconds(), static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC};
  }

 private:
  std::clock_t start_ = std::clock();
  Stopwatch watch_;
};

}  // namespace vorpipe::test
