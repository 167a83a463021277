/// A Window as a Screen.
#pragma once

#include <utility>

#include "view/screen.h"
#include "view/window/window.h"

namespace vorpipe::view {

class WindowScreen final : public Screen {
 public:
  explicit WindowScreen(Window window) : window_(std::move(window)) {}
  std::vector<Event> events(double seconds) override { return window_.events(seconds); }
  void wake() override { window_.wake(); }
  void apply(const Event& event) override { window_.apply(event); }
  [[nodiscard]] int width() const override { return window_.width(); }
  [[nodiscard]] int height() const override { return window_.height(); }
  [[nodiscard]] double scale() const override { return window_.scale(); }
  void setTitle(const std::string& title) override { window_.setTitle(title); }
  void copyToClipboard(const std::string& text) override { window_.copyToClipboard(text); }
  [[nodiscard]] Presenter& presenter() override { return window_.presenter(); }

 private:
  Window window_;
};

}  // namespace vorpipe::view
