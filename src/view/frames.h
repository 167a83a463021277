/// The thread that computes a window's pictures, so that the window never waits.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "view/wish.h"

namespace vorpipe::view {

/// Reads a file. Called on the Frames thread.
using Load = std::function<Result<Loaded>(const std::string& path)>;

class Frames {
 public:
  /// `wake` is called, from the other thread, when there is an answer.
  Frames(std::function<void()> wake, Load load);
  /// Cancels the work in progress.
  ~Frames();
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// Replaces an earlier wish that has not begun.
  void wish(Wish wish);
  /// Saves and loads run between two wishes, in order.
  void save(Save save);
  void load(std::string path);
  /// The next answer, if there is one.
  std::optional<Answer> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::view
