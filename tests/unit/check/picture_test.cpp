#include <gmock/gmock.h>

#include "unit/fixtures/checked_runs.h"

namespace vorpipe::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int pixels_across = 160, pixels_down = 120;

RenderOptions pictureOptions() {
  RenderOptions options{};
  options.domain = {0, 0, 1, 1};
  options.width = pixels_across;
  options.height = pixels_down;
  return options;
}

class CheckPicture : public ::testing::Test {
 protected:
  static const Rendering& rightPicture() {
    static const Rendering right = *cpuSession().render(mixedSites(), pictureOptions());
    return right;
  }
  [[nodiscard]] std::vector<std::string> broken() const {
    return promisesOf(check(sites, pictureOptions(), picture, 2));
  }
  [[nodiscard]] std::uint32_t& id(int row, int column) {
    return picture.image.ids[static_cast<std::size_t>(row * pixels_across + column)];
  }

  Sites sites = mixedSites();
  Rendering picture = rightPicture();
};

TEST_F(CheckPicture, FindsNothingInARightOne) { EXPECT_THAT(broken(), IsEmpty()); }

TEST_F(CheckPicture, FindsWrongStatuses) {
  picture.status[3] = Status::empty;
  EXPECT_THAT(broken(), Contains("statuses"));
  picture = rightPicture();
  picture.owner[200] = 200;
  EXPECT_THAT(broken(), ElementsAre("owners"));
  picture = rightPicture();
  picture.report.duplicate = 0;
  EXPECT_THAT(broken(), ElementsAre("statuses"));
}

TEST_F(CheckPicture, FindsAnUncoveredPixel) {
  for (const std::uint32_t none : {no_site, 200u, 202u, 203u}) {
    id(70, 90) = none;
    EXPECT_THAT(broken(), ElementsAre("pixels")) << none;
  }
}

TEST_F(CheckPicture, FindsAWrongPixel) {
  id(70, 90) = id(70, 90) == 5 ? 6 : 5;
  EXPECT_THAT(broken(), ElementsAre("pixels"));
}

TEST_F(CheckPicture, FindsAShiftedPicture) {
  std::rotate(picture.image.ids.begin(), picture.image.ids.begin() + 1, picture.image.ids.end());
  EXPECT_THAT(broken(), ElementsAre("pixels"));
}

TEST_F(CheckPicture, FindsASiteThatWasMoved) {
  sites.x[20] += 0.02;
  EXPECT_THAT(broken(), ElementsAre("pixels"));
}

TEST_F(CheckPicture, FindsMissingPixels) {
  picture.image.ids.pop_back();
  EXPECT_THAT(broken(), ElementsAre("pixels"));
  picture = rightPicture();
  picture.image.width += 1;
  EXPECT_THAT(broken(), ElementsAre("pixels"));
}

/// Pixel centers on the bisectors of a lattice belong to either site.
TEST(Check, FindsNothingInAPictureOfTies) {
  const Sites sites = generate(Pattern::square, 400, 1);
  RenderOptions options = pictureOptions();
  options.width = options.height = 50;
  const auto picture = cpuSession().render(sites, options);
  ASSERT_TRUE(picture);
  EXPECT_THAT(promisesOf(check(sites, options, *picture)), IsEmpty());
}

/// More pixels than are sampled: a wrong part is found all the same.
TEST(Check, SamplesALargePicture) {
  const Sites sites = generate(Pattern::random, 4, 1);
  RenderOptions options = pictureOptions();
  options.width = 4096;
  options.height = 2048;
  auto picture = cpuSession().render(sites, options);
  ASSERT_TRUE(picture);
  EXPECT_THAT(promisesOf(check(sites, options, *picture)), IsEmpty());
  auto& ids = picture->image.ids;
  std::fill_n(ids.begin(), 1000, ids.back() == 0 ? 1 : 0);
  EXPECT_THAT(promisesOf(check(sites, options, *picture)), ElementsAre("pixels"));
}

}  // namespace
}  // namespace vorpipe::test
