#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "unit/fixtures/temporary_directory.h"
#include "view/frames.h"
#include "view/painter.h"

namespace vorpipe::view {
namespace {

FixedSites randomSites(std::uint64_t count) {
  return std::make_shared<const Sites>(generate(Pattern::random, count, 1));
}

Wish wishOf(std::uint64_t number, FixedSites sites) {
  Wish wish{number, number, std::move(sites)};
  wish.picture.domain = {0, 0, 1, 1};
  wish.picture.width = 64;
  wish.picture.height = 48;
  wish.backend.name = "cpu";
  return wish;
}

const Outdated never = [] { return false; };

class FramesTest : public test::InTemporaryDirectory {
 protected:
  /// The next answer for which `fits` holds; the others are dropped.
  template <class Fits>
  Answer await(const Fits& fits) {
    std::unique_lock lock(mutex_);
    for (;;) {
      while (auto answer = frames.next()) {
        if (fits(*answer)) return std::move(*answer);
      }
      woken_ = false;
      if (!changed_.wait_for(lock, std::chrono::minutes(1), [&] { return woken_; })) {
        ADD_FAILURE() << "no answer within a minute";
        return {};
      }
    }
  }
  Answer awaitWish(std::uint64_t number) {
    return await([=](const Answer& answer) { return answer.wish == number; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool woken_ = false;

 protected:
  Frames frames{[this] {
                  const std::scoped_lock lock(mutex_);
                  woken_ = true;
                  changed_.notify_all();
                },
                [](const std::string& path) -> Result<Loaded> {
                  if (path.empty()) return tl::unexpected(Error{ErrorCode::input, "there is no name"});
                  Loaded loaded;
                  loaded.opened = Opened{*randomSites(3)};
                  return loaded;
                }};
};

TEST_F(FramesTest, GiveThePictureThatRenderDraws) {
  const FixedSites sites = randomSites(50);
  const Wish wish = wishOf(1, sites);
  frames.wish(wish);
  const Answer answer = awaitWish(1);
  ASSERT_TRUE(answer.frame);
  EXPECT_EQ(answer.frame->sites, sites);
  ASSERT_TRUE(answer.device);
  EXPECT_EQ(answer.device->backend, "cpu");
  auto session = Session::open(wish.backend);
  ASSERT_TRUE(session);
  const auto expected = session->render(*sites, wish.picture);
  ASSERT_TRUE(expected);
  EXPECT_EQ(answer.frame->rendering->image.ids, expected->image.ids);
  EXPECT_EQ(answer.frame->rendering->image.rgba, expected->image.rgba);
}

TEST_F(FramesTest, MeasureCellsWhileNothingElseIsWanted) {
  const FixedSites sites = randomSites(20);
  frames.wish(wishOf(1, sites));
  const Answer answer = await([](const Answer& one) { return one.measures != nullptr; });
  ASSERT_TRUE(answer.measures);
  EXPECT_EQ(answer.measures->sites, sites);
  double sum = 0;
  for (const double area : answer.measures->area) sum += area;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_GT(answer.measures->neighbors[0], 1U);
}

TEST_F(FramesTest, AnswerTheLatestWish) {
  const FixedSites sites = randomSites(1000);
  for (std::uint64_t number = 1; number <= 20; ++number) frames.wish(wishOf(number, sites));
  const Answer answer = awaitWish(20);
  ASSERT_TRUE(answer.frame);
  EXPECT_EQ(answer.frame->wish, 20U);
}

TEST_F(FramesTest, GoOnAfterABackendThatIsNotHere) {
  Wish wish = wishOf(1, randomSites(10));
  wish.backend.device = "no device is called so";
  frames.wish(wish);
  const Answer refused = awaitWish(1);
  ASSERT_TRUE(refused.error);
  EXPECT_EQ(refused.error->code, ErrorCode::device);
  wish = wishOf(2, wish.sites);
  frames.wish(wish);
  EXPECT_TRUE(awaitWish(2).frame);
  wish.picture.color = ColorBy::weight;
  wish.number = wish.gesture = 3;
  frames.wish(wish);
  const Answer wrong = awaitWish(3);
  ASSERT_TRUE(wrong.error);
  EXPECT_EQ(wrong.error->code, ErrorCode::input);
}

TEST_F(FramesTest, PreviewWhatIsDragged) {
  Wish wish = wishOf(1, randomSites(50));
  wish.longest_without_preview = 0;
  frames.wish(wish);
  EXPECT_TRUE(await([](const Answer& one) { return one.preview || one.frame; }).frame)
      << "nothing is dragged";
  wish.number = 2;
  wish.picture.view = Box{0.25, 0.25, 0.75, 0.75};
  wish.picture.labels = true;
  frames.wish(wish);
  const Answer early = await([](const Answer& one) { return one.preview || one.frame; });
  ASSERT_TRUE(early.preview);
  EXPECT_EQ(early.wish, 0U);
  EXPECT_EQ(early.preview->rendering->image.width, 32);
  EXPECT_EQ(early.preview->picture.view->xmin, 0.25);
  EXPECT_EQ(awaitWish(2).frame->rendering->image.width, 64);
  wish.number = wish.gesture = 3;
  frames.wish(wish);
  EXPECT_TRUE(await([](const Answer& one) { return one.preview || one.frame; }).frame) << "another gesture";
}

TEST_F(FramesTest, SavePictures) {
  const FixedSites sites = randomSites(10);
  frames.wish(wishOf(1, sites));
  const Answer answer = awaitWish(1);
  ASSERT_TRUE(answer.frame);
  for (const std::string name : {"a.png", "a.svg"}) {
    frames.save({path(name), sites, answer.frame->picture, answer.frame->rendering});
    const Answer saved = await([](const Answer& one) { return one.error || !one.saved.empty(); });
    EXPECT_EQ(saved.saved, path(name));
    EXPECT_GT(contents(path(name)).size(), 100U);
  }
  frames.save({path("none/a.png"), sites, answer.frame->picture, answer.frame->rendering});
  EXPECT_TRUE(await([](const Answer& one) { return one.error || !one.saved.empty(); }).error);
}

TEST_F(FramesTest, LoadFiles) {
  frames.load("");
  frames.load("three.csv");
  EXPECT_TRUE(await([](const Answer& one) { return one.error.has_value(); }).error);
  const Answer loaded = await([](const Answer& one) { return one.loaded_path == "three.csv"; });
  ASSERT_TRUE(loaded.loaded && loaded.loaded->opened);
  EXPECT_EQ(loaded.loaded->opened->sites.size(), 3U);
}

TEST(Painter, RelaxesStepByStep) {
  Painter painter;
  Wish wish = wishOf(1, randomSites(30));
  wish.motion = Motion::runs;
  double energy = 1e300;
  for (int step = 0; step < 5; ++step) {
    const Answer answer = painter.paint(wish, never);
    ASSERT_TRUE(answer.frame);
    EXPECT_EQ(answer.frame->relaxed_from, wish.sites);
    ASSERT_TRUE(answer.frame->step);
    EXPECT_EQ(answer.frame->step->diagram, static_cast<std::uint64_t>(step) + 1);
    EXPECT_LT(answer.frame->step->energy, energy);
    energy = answer.frame->step->energy;
    wish.sites = answer.frame->sites;
  }
  wish.sites = randomSites(30);
  EXPECT_EQ(painter.paint(wish, never).frame->step->diagram, 1U) << "other sites relax anew";
}

TEST(Painter, RelaxesOnAfterAStepThatWasGivenUp) {
  Painter painter;
  Wish wish = wishOf(1, randomSites(1000));
  wish.motion = Motion::runs;
  wish.sites = painter.paint(wish, never).frame->sites;
  EXPECT_EQ(painter.paint(wish, [] { return true; }).error->code, ErrorCode::cancelled);
  const Answer answer = painter.paint(wish, never);
  ASSERT_TRUE(answer.frame);
  EXPECT_FALSE(answer.frame->relaxed);
  EXPECT_NE(answer.frame->sites->x, wish.sites->x);
}

TEST(Painter, DrawsByAnotherBackendToCompare) {
  Painter painter;
  Wish wish = wishOf(1, randomSites(30));
  wish.compared = comparedWith(wish.backend, "cpu", "");
  Answer answer = painter.paint(wish, never);
  ASSERT_TRUE(answer.frame && answer.frame->compared);
  EXPECT_EQ(answer.frame->compared->ids, answer.frame->rendering->image.ids);
  EXPECT_EQ(answer.frame->differing, 0U);
  EXPECT_FALSE(answer.frame->compared_by.empty());
  wish.compared->device = "no device is called so";
  EXPECT_EQ(painter.paint(wish, never).error->code, ErrorCode::device);
  wish.compared.reset();
  EXPECT_FALSE(painter.paint(wish, never).frame->compared);
}

TEST(Painter, GivesUpWhatIsOutdated) {
  Painter painter;
  const Wish wish = wishOf(1, randomSites(1000));
  const Answer answer = painter.paint(wish, [] { return true; });
  ASSERT_TRUE(answer.error);
  EXPECT_EQ(answer.error->code, ErrorCode::cancelled);
  EXPECT_TRUE(painter.paint(wish, never).frame);
}

TEST(Painter, DrawsADomainWithoutSites) {
  Painter painter;
  Wish wish = wishOf(1, std::make_shared<const Sites>());
  wish.motion = Motion::runs;
  const Answer answer = painter.paint(wish, never);
  ASSERT_TRUE(answer.frame);
  EXPECT_EQ(answer.frame->rendering->image.ids.front(), no_site);
}

}  // namespace
}  // namespace vorpipe::view
