/// Interface of the window as the viewer needs it, so that tests can run without a window.
#pragma once

#include <string>
#include <vector>

#include "view/window/event.h"
#include "view/window/presenter.h"

namespace vorpipe::view {

/// See Window for the functions.
class Screen {
 public:
  virtual ~Screen() = default;
  virtual std::vector<Event> events(double seconds) = 0;
  virtual void wake() = 0;
  virtual void apply(const Event& event) = 0;
  [[nodiscard]] virtual int width() const = 0;
  [[nodiscard]] virtual int height() const = 0;
  [[nodiscard]] virtual double scale() const { return 1; }
  virtual void setTitle(const std::string& title) = 0;
  virtual void copyToClipboard(const std::string& text) = 0;
  [[nodiscard]] virtual Presenter& presenter() = 0;
};

}  // namespace vorpipe::view
