// The whole of `vorpipe view` but its window: scripts play on a screen that keeps what it is shown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "io/fluid/fluid_state.h"
#include "io/pictures/png_file.h"
#include "io/sites/sites_file.h"
#include "unit/fixtures/temporary_directory.h"
#include "view/app/app.h"
#include "view/app/wipe.h"

namespace vorpipe::view {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

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

  /// A place of the plane in the window as it is at first, which fits the domain by its height.
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

TEST_F(AppTest, EditsByAScriptAreWhatTheCommandLineDraws) {
  const auto end =
      play("move " + at(0.3, 0.9) + "\npress left\nrelease left\n" +                             // adds
           "move " + at(0.5, 0.5) + "\npress left\nmove " + at(0.6, 0.2) + "\nrelease left\n" +  // drags
           "wait\nmove " + at(0.9, 0.5) + "\npress right\nrelease right\n" +                     // removes
           "wait\nscroll 3\nwait\nkey e\nscroll 2 control\nwait\n" +
           "screenshot a.png\nkey c control\nwait\nscreenshot b.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  const auto sites = readSites(path("vorpipe-sites.csv"));
  ASSERT_TRUE(sites) << sites.error().message;
  ASSERT_THAT(sites->sites.x, SizeIs(3));
  EXPECT_NEAR(sites->sites.x[1], 0.6, 1e-4);
  EXPECT_NEAR(sites->sites.x[2], 0.3, 1e-4);
  EXPECT_THAT(screen.copied, StartsWith("vorpipe render --sites vorpipe-sites.csv --domain 0,0,1,1 --view "));
  EXPECT_THAT(screen.copied, HasSubstr(" --size 400x300 --fit stretch --edges --backend cpu -o picture.png"));
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
}

TEST_F(AppTest, UndoesAndRelaxes) {
  const auto end =
      play("wait\nscreenshot a.png\nmove " + at(0.3, 0.9) +
           "\npress left\nrelease left\nwait\nscreenshot b.png\nkey z control\nwait\n"
           "screenshot c.png\nkey n\nwait\nscreenshot d.png\nkey space\nwait\nwait\nkey space\nwait\n"
           "key z control\nkey z control\nwait\nscreenshot e.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("c.png").rgba);
  EXPECT_EQ(shot("a.png").rgba, shot("e.png").rgba);
  EXPECT_NE(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_NE(shot("a.png").rgba, shot("d.png").rgba);
}

TEST_F(AppTest, TakesBackADragAndTheTurnsOfAWheelAsOneStep) {
  const auto end =
      play("wait\nmove " + at(0.5, 0.5) + "\npress left\nrelease left\nwait\n" +  //
           "press left\nmove " + at(0.55, 0.6) + "\nwait\nmove " + at(0.58, 0.7) + "\nwait\nmove " +
           at(0.6, 0.8) + "\nrelease left\nwait\nkey e control\nwait\nkey z control\n" +
           "wait\nkey e control\nwait\nscroll 1 control\nwait\nscroll 1 control\nwait\n" +
           "key e control\nwait\nkey z control\nwait\nkey e control\nwait\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  const auto saved = [this](const std::string& name) {
    auto sites = readSites(path(name));
    EXPECT_TRUE(sites) << sites.error().message;
    return sites ? std::move(sites->sites) : Sites{};
  };
  EXPECT_THAT(saved("sites.csv").y, ElementsAre(0.5, ::testing::DoubleNear(0.8, 1e-4), 0.5));
  EXPECT_THAT(saved("sites-2.csv").y, ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(saved("sites-3.csv").weight, SizeIs(3));
  EXPECT_THAT(saved("sites-4.csv").weight, SizeIs(0));
}

TEST_F(AppTest, ResizesMinimizesAndShowsThePanel) {
  const auto end = play(
      "wait\nresize 200 100\nwait\nscreenshot a.png\nminimize\nwait\nrestore\nwait\n"
      "key tab\nwait\nscreenshot b.png\nscreenshot c.png panel\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").width, 200);
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_EQ(shot("c.png").rgba[0], KeepingPresenter::panel_color);
}

TEST_F(AppTest, OpensDroppedFilesAndSaves) {
  write("one.csv", "x,y\n0.5,0.5\n");
  const auto end = play(
      "wait\ndrop one.csv\nwait\nkey s control\nkey s control shift\nkey e control\nwait\n"
      "key c control\ndrop none.csv\nwait\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_THAT(screen.copied, StartsWith("vorpipe render --sites one.csv --view"));
  EXPECT_EQ(contents(path("sites.csv")), "x,y\n0.5,0.5\n");
  EXPECT_EQ(shot("vorpipe.png").width, 400);
  EXPECT_THAT(contents(path("vorpipe.svg")), HasSubstr("<svg"));
}

TEST(Wipe, PutsTwoPicturesSideBySide) {
  const Image first{3, 2, {1, 2, 3, 4, 5, 6}, {}}, other{3, 2, {7, 8, 9, 10, 11, 12}, {}};
  Wipe wipe;
  EXPECT_THAT(wipe.put(first, other, 1).rgba, ElementsAre(1, 8, 9, 4, 11, 12));
  EXPECT_EQ(wipe.put(first, other, 3).rgba, first.rgba);
  EXPECT_EQ(wipe.put(first, other, -4).rgba, other.rgba);
}

TEST(Wipe, IsDraggedByItsLine) {
  Wipe wipe;
  double at = 0.5;
  EXPECT_FALSE(wipe.take(Press{}, Place{90, 5}, 200, 5, at));
  EXPECT_FALSE(wipe.take(Move{{50, 5}}, Place{90, 5}, 200, 5, at));
  EXPECT_TRUE(wipe.take(Press{}, Place{104, 5}, 200, 5, at));
  EXPECT_TRUE(wipe.take(Move{{50, 5}}, Place{104, 5}, 200, 5, at));
  EXPECT_EQ(at, 0.25);
  EXPECT_TRUE(wipe.take(Move{{-50, 5}}, Place{50, 5}, 200, 5, at));
  EXPECT_EQ(at, 0);
  EXPECT_TRUE(wipe.take(Release{}, Place{-50, 5}, 200, 5, at));
  EXPECT_FALSE(wipe.take(Move{{50, 5}}, Place{-50, 5}, 200, 5, at));
  EXPECT_EQ(at, 0);
}

TEST_F(AppTest, ComparesTwoBackendsWhosePicturesAreTheSame) {
  const auto alone = play("wait\nscreenshot a.png\nclose\n");
  ASSERT_TRUE(alone) << alone.error().message;
  options.viewer.settings.compared = comparedWith(options.viewer.settings.backend, "cpu", "");
  // The line is dragged; elsewhere the pointer does what it does.
  const auto end = play(
      "wait\nscreenshot b.png\nmove 202 150\npress left\nmove 100 150\nrelease left\nwait\nscreenshot c.png\n"
      "move 200 40\npress left\nrelease left\nwait\nscreenshot d.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_EQ(shot("a.png").rgba, shot("c.png").rgba);
  EXPECT_NE(shot("a.png").rgba, shot("d.png").rgba);
}

TEST_F(AppTest, LegendsAreDrawnWhereTheyCanBe) {
  options.viewer.settings.picture.color = ColorBy::area;
  options.viewer.settings.picture.legend = true;
  const auto end = play(
      "wait\nscreenshot a.png\nkey c\nwait\nscreenshot b.png\nkey c control\nwait\n"
      "resize 60 40\nwait\nscreenshot c.png\nkey c\nresize 400 300\nwait\nscreenshot d.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_NE(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_THAT(screen.copied, HasSubstr("--no-fill --color area"));
  EXPECT_EQ(shot("c.png").width, 60);
  EXPECT_EQ(shot("a.png").rgba, shot("d.png").rgba);
}

TEST_F(AppTest, IsIdleWhereNothingHappens) {
  const auto end = play("wait\nwait 0.3\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_LT(screen.kept.frames, 30);
  EXPECT_LE(end->pictures, 2U);
}

TEST_F(AppTest, RecordsAFrameForEachEventAndThirtyASecond) {
  options.record = path("film");
  const auto end = play("wait\nkey e\nwait 0.2\nkey space\nwait 0.1\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  // One at the beginning, one each for the keys, 6 and 3 for the times.
  EXPECT_TRUE(std::filesystem::exists(path("film/frame-00012.png")));
  EXPECT_FALSE(std::filesystem::exists(path("film/frame-00013.png")));
  EXPECT_NE(contents(path("film/frame-00010.png")), contents(path("film/frame-00011.png")));
  EXPECT_THAT(end->validation, SizeIs(0));
}

TEST_F(AppTest, DrawsSomeFramesAndSavesTheLast) {
  options.screenshot = path("a.png");
  options.frames = 5;
  options.viewer.settings.motion = Motion::runs;
  const auto end = run(screen, options);
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_GE(end->pictures, 5U);
  EXPECT_EQ(shot("a.png").height, 300);
}

class FluidAppTest : public AppTest {
 protected:
  FluidAppTest() { options.viewer.opened = openedFluid(toBegin(fluidCase(FluidCase::shear, 64)), "shear"); }
};

TEST_F(FluidAppTest, FlowsIsStirredAndBeginsAgain) {
  const std::string stirs = "move " + at(0.3, 0.5) + "\npress left\nmove " + at(0.5, 0.5) + "\nmove " +
                            at(0.7, 0.6) + "\nrelease left\n";
  const auto end =
      play("wait\nscreenshot a.png\nkey n\nwait\nscreenshot b.png\nwait 0.1\nwait\nscreenshot c.png\n" +
           stirs + "wait\nkey n\nwait\nscreenshot d.png\n" + "key r\nwait\nscreenshot e.png\nkey n\nwait\n" +
           stirs + "wait\nkey n\nwait\nscreenshot f.png\nkey r\nwait\nkey n\nwait\nkey n\nwait\n" +
           "screenshot g.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_NE(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_EQ(shot("b.png").rgba, shot("c.png").rgba) << "it pauses";
  EXPECT_EQ(shot("a.png").rgba, shot("e.png").rgba);
  EXPECT_EQ(shot("d.png").rgba, shot("f.png").rgba) << "the same strokes";
  EXPECT_NE(shot("d.png").rgba, shot("g.png").rgba) << "none";
}

TEST_F(FluidAppTest, WithoutAGpuIsDrawnByTheDriverThatTheWindowHasOpen) {
  const auto backendOf = [](const char* name) {
    BackendOptions named;
    named.name = name;
    const auto session = Session::open(named);
    return session ? session->device().backend : std::string();
  };
  const std::string vulkan = backendOf("vulkan");
  if (backendOf("auto") != "cpu" || vulkan.empty()) GTEST_SKIP() << "no software driver alone";
  options.viewer.settings.backend.name = "auto";
  options.viewer.shown_by = "vulkan";
  const auto end = play("wait\nkey c control\nwait\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_THAT(end->computed_by, StartsWith(vulkan));
  EXPECT_THAT(screen.copied, HasSubstr("--backend " + vulkan));
  // Sites without weights are the processor's, up to the first weight.
  options.viewer.opened = {{{0.25, 0.5, 0.75}, {0.5, 0.5, 0.5}, {}}, {0, 0, 1, 1}};
  const auto plain = play("wait\nclose\n");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_THAT(plain->computed_by, StartsWith("cpu"));
  const auto weighted = play("wait\nmove 200 150\nscroll 1 control\nwait\nclose\n");
  ASSERT_TRUE(weighted) << weighted.error().message;
  EXPECT_THAT(weighted->computed_by, StartsWith(vulkan));
}

TEST_F(FluidAppTest, IsSavedAndGoesOn) {
  const auto end = play(
      "wait\nkey n\nwait\nkey e control shift\nkey e control\nkey s control shift\nwait\nkey c "
      "control\nwait\n"
      "key c control\nwait\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  for (const char* name : {"fluid.npz", "vorpipe-fluid.npz"}) {
    const auto saved = readFluid(path(name));
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_EQ(saved->state.step, 1U);
  }
  EXPECT_THAT(contents(path("sites.csv")), StartsWith("x,y,weight\n"));
  EXPECT_THAT(contents(path("vorpipe.svg")), HasSubstr("<svg"));
  EXPECT_THAT(screen.copied, StartsWith("vorpipe fluid --resume vorpipe-fluid.npz --steps 100 --view"));
  EXPECT_FALSE(std::filesystem::exists(path("vorpipe-fluid-2.npz")));
}

TEST_F(FluidAppTest, IsNotEditedAndComesBack) {
  write("one.csv", "x,y\n0.5,0.5\n");
  const auto end =
      play("wait\nkey n\nwait\nscreenshot a.png\nmove " + at(0.4, 0.4) +
           "\npress left\nrelease left\npress right\nrelease right\nscroll 1 control\nkey z control\n"
           "wait\nscreenshot b.png\ndrop one.csv\nwait\nscreenshot c.png\nkey space\nkey space\nwait\nkey z "
           "control\n"
           "wait\nscreenshot d.png\nkey n\nwait\nscreenshot e.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_NE(shot("a.png").rgba, shot("c.png").rgba);
  EXPECT_EQ(shot("a.png").rgba, shot("d.png").rgba);
  EXPECT_NE(shot("a.png").rgba, shot("e.png").rgba);
}

TEST_F(FluidAppTest, IsDrawnWhileItRuns) {
  const auto stepped = play("wait\nkey n\nwait\nkey n\nwait\nkey n\nwait\nscreenshot a.png\nclose\n");
  ASSERT_TRUE(stepped) << stepped.error().message;
  options.script.reset();
  options.screenshot = path("b.png");
  options.frames = 3;
  options.viewer.settings.motion = Motion::runs;
  const auto end = run(screen, options);
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
}

TEST_F(AppTest, SaysThatThereIsNoFluid) {
  const auto end =
      play("wait\nscreenshot a.png\nkey r\nkey e control shift\nwait\nscreenshot b.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_FALSE(std::filesystem::exists(path("fluid.npz")));
}

TEST_F(AppTest, SaysWhatIsWrong) {
  const auto bad = play("wait\nscreenshot none/a.png\n");
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().message, StartsWith("play.txt:2: none/a.png"));
  options.viewer.settings.backend.device = "no device is called so";
  const auto none = play("wait\nclose\n");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::device);
  options.record = directory();
  write("something", "");
  EXPECT_THAT(play("close").error().message, HasSubstr("the folder holds something"));
}

TEST_F(AppTest, HandsFilmsToFfmpeg) {
  const std::string old = std::getenv("PATH");
  options.record = path("film.mp4");
  std::filesystem::create_directory(path("bin"));
  ::setenv("PATH", path("bin").c_str(), 1);
  EXPECT_THAT(play("close").error().message, HasSubstr("ffmpeg, which is not on PATH"));
  write("bin/ffmpeg",
        "#!/bin/sh\nfor last; do :; done\necho \"$*\" >" + path("arguments") + "\n/bin/cat >\"$last\"\n");
  std::filesystem::permissions(path("bin/ffmpeg"), std::filesystem::perms::owner_all);
  // What has the name of a film that is not finished may be anybody's.
  write("film.mp4.partial", "mine");
  write("film.mp4", "old");
  std::filesystem::permissions(path("film.mp4"),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const auto end = play("wait\nresize 200 100\nkey e\nclose\n");
  ::setenv("PATH", old.c_str(), 1);
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(std::filesystem::file_size(path("film.mp4")) % (400 * 300 * 4), 0U);
  EXPECT_THAT(contents(path("arguments")), HasSubstr("-video_size 400x300 -framerate 30 -i -"));
  EXPECT_EQ(contents(path("film.mp4.partial")), "mine");
  EXPECT_EQ(std::filesystem::status(path("film.mp4")).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  options.record = path("none/film.mp4");
  EXPECT_FALSE(play("close"));
}

}  // namespace
}  // namespace vorpipe::view
