/// The thread that computes what a window shows, so that the window never waits for it.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "view/wish.h"

namespace vorpipe::view {

/// Reads a file. Called on the thread of Frames.
using Load = std::function<Result<Loaded>(const std::string& path)>;

class Frames {
 public:
  /// `wake` is called, from the other thread, when there is an answer.
  Frames(std::function<void()> wake, Load load);
  /// Gives up what is being done.
  ~Frames();
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// Takes the place of an earlier wish that was not begun.
  void wish(Wish wish);
  /// What follows is done between two wishes, in order.
  void save(Save save);
  void load(std::string path);
  /// The next answer, if there is one.
  std::optional<Answer> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::view
