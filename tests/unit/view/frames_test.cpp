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

FrameRequest requestOf(std::uint64_t number, FixedSites sites) {
  FrameRequest request{number, number, std::move(sites)};
  request.picture.domain = {0, 0, 1, 1};
  request.picture.width = 64;
  request.picture.height = 48;
  request.backend.name = "cpu";
  return request;
}

const Outdated never = [] { return false; };

class FramesTest : public test::InTemporaryDirectory {
 protected:
  /// The next result for which `fits` holds; the others are dropped.
  template <class Fits>
  RenderResult await(const Fits& fits) {
    std::unique_lock lock(mutex_);
    for (;;) {
      while (auto result = frames.next()) {
        if (fits(*result)) return std::move(*result);
      }
      woken_ = false;
      if (!changed_.wait_for(lock, std::chrono::minutes(1), [&] { return woken_; })) {
        ADD_FAILURE() << "no answer within a minute";
        return {};
      }
    }
  }
  RenderResult awaitRequest(std::uint64_t number) {
    return await([=](const RenderResult& result) { return result.request == number; });
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
  const FrameRequest request = requestOf(1, sites);
  frames.request(request);
  const RenderResult result = awaitRequest(1);
  ASSERT_TRUE(result.frame);
  EXPECT_EQ(result.frame->sites, sites);
  ASSERT_TRUE(result.device);
  EXPECT_EQ(result.device->backend, "cpu");
  auto session = Session::open(request.backend);
  ASSERT_TRUE(session);
  const auto expected = session->render(*sites, request.picture);
  ASSERT_TRUE(expected);
  EXPECT_EQ(result.frame->rendering->image.ids, expected->image.ids);
  EXPECT_EQ(result.frame->rendering->image.rgba, expected->image.rgba);
}

TEST_F(FramesTest, MeasureCellsWhileNothingElseIsWanted) {
  const FixedSites sites = randomSites(20);
  frames.request(requestOf(1, sites));
  const RenderResult result = await([](const RenderResult& one) { return one.measures != nullptr; });
  ASSERT_TRUE(result.measures);
  EXPECT_EQ(result.measures->sites, sites);
  double sum = 0;
  for (const double area : result.measures->area) sum += area;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_GT(result.measures->neighbors[0], 1U);
}

TEST_F(FramesTest, AnswerTheLatestWish) {
  const FixedSites sites = randomSites(1000);
  for (std::uint64_t number = 1; number <= 20; ++number) frames.request(requestOf(number, sites));
  const RenderResult result = awaitRequest(20);
  ASSERT_TRUE(result.frame);
  EXPECT_EQ(result.frame->request, 20U);
}

TEST_F(FramesTest, GoOnAfterABackendThatIsNotHere) {
  FrameRequest request = requestOf(1, randomSites(10));
  request.backend.device = "no device is called so";
  frames.request(request);
  const RenderResult refused = awaitRequest(1);
  ASSERT_TRUE(refused.error);
  EXPECT_EQ(refused.error->code, ErrorCode::device);
  request = requestOf(2, request.sites);
  frames.request(request);
  EXPECT_TRUE(awaitRequest(2).frame);
  request.picture.color = ColorBy::weight;
  request.number = request.gesture = 3;
  frames.request(request);
  const RenderResult wrong = awaitRequest(3);
  ASSERT_TRUE(wrong.error);
  EXPECT_EQ(wrong.error->code, ErrorCode::input);
}

TEST_F(FramesTest, PreviewWhatIsDragged) {
  FrameRequest request = requestOf(1, randomSites(50));
  request.longest_without_preview = 0;
  frames.request(request);
  EXPECT_TRUE(await([](const RenderResult& one) { return one.preview || one.frame; }).frame)
      << "nothing is dragged";
  request.number = 2;
  request.picture.view = Box{0.25, 0.25, 0.75, 0.75};
  request.picture.labels = true;
  frames.request(request);
  const RenderResult early = await([](const RenderResult& one) { return one.preview || one.frame; });
  ASSERT_TRUE(early.preview);
  EXPECT_EQ(early.request, 0U);
  EXPECT_EQ(early.preview->rendering->image.width, 32);
  EXPECT_EQ(early.preview->picture.view->xmin, 0.25);
  EXPECT_EQ(awaitRequest(2).frame->rendering->image.width, 64);
  request.number = request.gesture = 3;
  frames.request(request);
  EXPECT_TRUE(await([](const RenderResult& one) { return one.preview || one.frame; }).frame)
      << "another gesture";
}

TEST_F(FramesTest, SavePictures) {
  const FixedSites sites = randomSites(10);
  frames.request(requestOf(1, sites));
  const RenderResult result = awaitRequest(1);
  ASSERT_TRUE(result.frame);
  for (const std::string name : {"a.png", "a.svg"}) {
    frames.save({path(name), sites, result.frame->picture, result.frame->rendering});
    const RenderResult saved = await([](const RenderResult& one) { return one.error || !one.saved.empty(); });
    EXPECT_EQ(saved.saved, path(name));
    EXPECT_GT(contents(path(name)).size(), 100U);
  }
  frames.save({path("none/a.png"), sites, result.frame->picture, result.frame->rendering});
  EXPECT_TRUE(await([](const RenderResult& one) { return one.error || !one.saved.empty(); }).error);
}

TEST_F(FramesTest, LoadFiles) {
  frames.load("");
  frames.load("three.csv");
  EXPECT_TRUE(await([](const RenderResult& one) { return one.error.has_value(); }).error);
  const RenderResult loaded = await([](const RenderResult& one) { return one.loaded_path == "three.csv"; });
  ASSERT_TRUE(loaded.loaded && loaded.loaded->opened);
  EXPECT_EQ(loaded.loaded->opened->sites.size(), 3U);
}

TEST(Painter, RelaxesStepByStep) {
  Painter painter;
  FrameRequest request = requestOf(1, randomSites(30));
  request.motion = Motion::runs;
  double energy = 1e300;
  for (int step = 0; step < 5; ++step) {
    const RenderResult result = painter.paint(request, never);
    ASSERT_TRUE(result.frame);
    EXPECT_EQ(result.frame->relaxed_from, request.sites);
    ASSERT_TRUE(result.frame->step);
    EXPECT_EQ(result.frame->step->diagram, static_cast<std::uint64_t>(step) + 1);
    EXPECT_LT(result.frame->step->energy, energy);
    energy = result.frame->step->energy;
    request.sites = result.frame->sites;
  }
  request.sites = randomSites(30);
  EXPECT_EQ(painter.paint(request, never).frame->step->diagram, 1U) << "other sites relax anew";
}

TEST(Painter, MakesStepsForAboutAsLongAsItDrew) {
  Painter painter;
  // Ten sites would be at rest before the time is over.
  FrameRequest request = requestOf(1, randomSites(1000));
  request.picture.width = request.picture.height = 1500;
  ASSERT_TRUE(painter.paint(request, never).frame);
  request.motion = Motion::runs;
  request.several_steps = true;
  RenderResult result = painter.paint(request, never);
  ASSERT_TRUE(result.frame && result.frame->step);
  EXPECT_GT(result.frame->step->diagram, 2U);
  EXPECT_NE(result.frame->sites, request.sites);
  EXPECT_EQ(result.frame->relaxed_from, request.sites);
  request.several_steps = false;
  request.sites = result.frame->sites;
  const std::uint64_t before = result.frame->step->diagram;
  result = painter.paint(request, never);
  EXPECT_EQ(result.frame->step->diagram, before + 1);
}

TEST(Painter, RelaxesOnAfterAStepThatWasGivenUp) {
  Painter painter;
  FrameRequest request = requestOf(1, randomSites(1000));
  request.motion = Motion::runs;
  request.sites = painter.paint(request, never).frame->sites;
  EXPECT_EQ(painter.paint(request, [] { return true; }).error->code, ErrorCode::cancelled);
  const RenderResult result = painter.paint(request, never);
  ASSERT_TRUE(result.frame);
  EXPECT_FALSE(result.frame->relaxed);
  EXPECT_NE(result.frame->sites->x, request.sites->x);
}

TEST(Painter, DrawsByAnotherBackendToCompare) {
  Painter painter;
  FrameRequest request = requestOf(1, randomSites(30));
  request.compared = comparedWith(request.backend, "cpu", "");
  RenderResult result = painter.paint(request, never);
  ASSERT_TRUE(result.frame && result.frame->compared);
  EXPECT_EQ(result.frame->compared->ids, result.frame->rendering->image.ids);
  EXPECT_EQ(result.frame->differing, 0U);
  EXPECT_FALSE(result.frame->compared_by.empty());
  request.compared->device = "no device is called so";
  EXPECT_EQ(painter.paint(request, never).error->code, ErrorCode::device);
  request.compared.reset();
  EXPECT_FALSE(painter.paint(request, never).frame->compared);
}

TEST(Painter, GivesUpWhatIsOutdated) {
  Painter painter;
  const FrameRequest request = requestOf(1, randomSites(1000));
  const RenderResult result = painter.paint(request, [] { return true; });
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->code, ErrorCode::cancelled);
  EXPECT_TRUE(painter.paint(request, never).frame);
}

TEST(Painter, DrawsADomainWithoutSites) {
  Painter painter;
  FrameRequest request = requestOf(1, std::make_shared<const Sites>());
  request.motion = Motion::runs;
  const RenderResult result = painter.paint(request, never);
  ASSERT_TRUE(result.frame);
  EXPECT_EQ(result.frame->rendering->image.ids.front(), no_site);
}

}  // namespace
}  // namespace vorpipe::view
