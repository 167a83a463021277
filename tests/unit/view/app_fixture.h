/// Scripts play on a screen that keeps what it is shown.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "io/pictures/png_file.h"
#include "io/sites/sites_file.h"
#include "unit/fixtures/temporary_directory.h"
#include "view/app.h"

namespace vorpipe::view {

/// Keeps the picture where it is sharp, and marks the first pixel where the panel is drawn over it.
class KeepingPresenter final : public Presenter {
 public:
  Result<void> setTexture(const PanelTexture& /*texture*/) override { return {}; }
  Result<void> show(const Shown& frame, int width, int height) override {
    ++frames;
    const bool sharp = frame.picture != nullptr && frame.placement.left == 0 && frame.placement.top == 0 &&
                       frame.placement.width == width && frame.placement.height == height &&
                       frame.picture->width == width;
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (sharp) kept = *frame.picture;
    if (!sharp) kept = {width, height, std::vector<std::uint32_t>(pixels, background), {}};
    for (std::uint32_t& pixel : kept.rgba) {
      if (pixel >> 24 == 0) pixel = background;
    }
    if (frame.panel != nullptr && !frame.panel->parts.empty()) kept.rgba[0] = panel_color;
    return {};
  }
  Result<Image> read() override { return kept; }
  [[nodiscard]] std::string name() const override { return "nothing"; }

  static constexpr std::uint32_t panel_color = 0xFF123456;
  Image kept{};
  int frames = 0;
};

class FakeScreen final : public Screen {
 public:
  std::vector<Event> events(double seconds) override {
    std::unique_lock lock(mutex_);
    if (seconds > 0 && events_.empty()) {
      changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return woken_; });
    }
    woken_ = false;
    return std::exchange(events_, {});
  }
  void wake() override {
    const std::scoped_lock lock(mutex_);
    woken_ = true;
    changed_.notify_all();
  }
  void apply(const Event& event) override {
    const std::scoped_lock lock(mutex_);
    if (const auto* const size = std::get_if<Resize>(&event)) {
      if (refuses_sizes) return;
      width_ = size->width;
      height_ = size->height;
    }
    if (std::holds_alternative<Minimize>(event)) minimized_ = true;
    if (std::holds_alternative<Restore>(event)) minimized_ = false;
    events_.push_back(event);
  }
  [[nodiscard]] int width() const override { return minimized_ ? 0 : width_; }
  [[nodiscard]] int height() const override { return minimized_ ? 0 : height_; }
  void setTitle(const std::string& /*title*/) override {}
  void copyToClipboard(const std::string& text) override { copied = text; }
  [[nodiscard]] Presenter& presenter() override { return kept; }

  KeepingPresenter kept{};
  std::string copied{};
  bool refuses_sizes = false;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool woken_ = false, minimized_ = false;
  std::vector<Event> events_{};
  int width_ = 400, height_ = 300;
};

class AppTest : public test::InTemporaryDirectory {
 protected:
  AppTest() {
    options.viewer.opened = {{{0.25, 0.5, 0.75}, {0.5, 0.5, 0.5}, {}}, {0, 0, 1, 1}};
    options.viewer.settings.backend.name = "cpu";
    options.viewer.settings.panel = false;
    options.viewer.copy = [this](const std::string& text) { screen.copyToClipboard(text); };
    options.viewer.load = [](const std::string& file) -> Result<Loaded> {
      auto table = readSites(file);
      if (!table) return tl::unexpected(table.error());
      Loaded loaded;
      loaded.opened = Opened{std::move(table->sites), {0, 0, 1, 1}, {}, Periodic::none, {"--sites", file}};
      return loaded;
    };
    // What is saved goes to the current folder.
    EXPECT_EQ(::chdir(directory().c_str()), 0);
  }
  ~AppTest() override { EXPECT_EQ(::chdir("/"), 0); }

  Result<AppEnd> play(const std::string& text) {
    auto script = parseScript("play.txt", text);
    if (!script) return tl::unexpected(script.error());
    options.script = std::move(*script);
    return run(screen, options);
  }

  /// A point of the plane in the window as it is at first, which fits the domain by its height.
  static std::string at(double x, double y) {
    const double side = 300 / 1.04;
    return std::to_string(200 + (x - 0.5) * side) + " " + std::to_string(150 - (y - 0.5) * side);
  }
  Image shot(const std::string& name) const {
    auto image = readPng(path(name));
    EXPECT_TRUE(image) << image.error().message;
    return image ? std::move(*image) : Image{};
  }

  FakeScreen screen;
  AppOptions options;
};

}  // namespace vorpipe::view
