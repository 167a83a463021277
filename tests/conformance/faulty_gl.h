/// OpenGL and EGL that fail at will, between the program and the driver.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorpipe::test {

/// While one lives, every call through libepoxy goes through it. Only one may live at a time.
class FaultyGl {
 public:
  enum class Failure {
    out_of_memory,  ///< the call does nothing, and glGetError says so once
    context_lost,   ///< the call does nothing, and glGetError says so without end
  };

  /// Call number `failing_call` fails, counted from 1; 0: none. Those of EGL return what says that they
  /// failed.
  explicit FaultyGl(int failing_call = 0, Failure failure = Failure::out_of_memory);
  ~FaultyGl();
  FaultyGl(const FaultyGl&) = delete;
  FaultyGl& operator=(const FaultyGl&) = delete;

  int calls = 0;           ///< that could fail
  int contexts_alive = 0;  ///< that were made by EGL and not destroyed
  std::string failed;      ///< the name of the one that failed

  /// The names of all that are made to fail, and of those that cannot.
  static std::span<const std::string_view> canFail();
  static std::span<const std::string_view> cannotFail();

  // What the functions in between use.
  bool failsNow(std::string_view name);
  unsigned takeNoted();
  unsigned noted = 0;

 private:
  int failing_call_;
  unsigned error_;
  std::vector<std::function<void()>> restores_;
};

}  // namespace vorpipe::test
