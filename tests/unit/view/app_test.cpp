// The whole of `vorpipe view` but its window.
#include "unit/view/app_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace vorpipe::view {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

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
