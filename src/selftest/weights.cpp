#include <algorithm>

#include "selftest/makers.h"
#include "selftest/random.h"

namespace vorpipe::selftests {

Scene randomWeights(const Scale& scale) {
  const std::uint64_t count = scale.of(600, 6000);
  Scene scene = patternScene(Pattern::random, count, scale);
  Random random(scale.seed);
  // In squares of the mean distance, so that some sites are hidden and most are not.
  for (std::uint64_t i = 0; i < count; i++) {
    scene.sites.weight.push_back(random.between(-1, 1) / static_cast<double>(count));
  }
  return scene;
}

Scene liftedTwins(const Scale& scale) {
  constexpr std::uint64_t side = 4, count = 260;
  Random random(scale.seed);
  Scene scene;
  Sites& sites = scene.sites;
  for (std::uint64_t i = 0; i < count; i++) {
    const double away = random.power(-8, -6);
    const double x = static_cast<double>(random.whole(side)) + away * random.between(0, 1);
    const double y = static_cast<double>(random.whole(side)) + away * random.between(0, 1);
    sites.x.push_back(x);
    sites.y.push_back(y);
    sites.weight.push_back(x * x + y * y);
  }
  scene.domain = {-0.15, -0.15, 3.15, 3.15};
  return scene;
}

}  // namespace vorpipe::selftests
