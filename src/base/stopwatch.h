/// Wall time.
#pragma once

#include <chrono>

namespace vorpipe {

/// Starts when it is constructed.
class Stopwatch {
 public:
  [[nodiscard]] double milliseconds() const { return 1e3 * seconds(); }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace vorpipe
