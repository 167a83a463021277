#include "selftest/makers.h"
#include "selftest/random.h"

namespace vorpipe::selftests {
namespace {

constexpr Box small_domain{0.25, 0.25, 0.5, 0.75};

}  // namespace

// The cells meet in the circle's center, in the middle of a wall.
Scene circleInSmallDomain(const Scale& scale) {
  Scene scene = patternScene(Pattern::circle, scale.of(120, 1200), scale);
  scene.domain = small_domain;
  return scene;
}

Scene latticeInSmallDomain(const Scale& scale) {
  constexpr std::uint64_t side = 5;
  const std::uint64_t count = scale.of(40, 80);
  Random random(scale.seed);
  Scene scene;
  for (std::uint64_t i = 0; i < count; i++) {
    const double away = random.power(-9, -6);
    scene.sites.x.push_back(0.25 * static_cast<double>(random.whole(side)) + away * random.between(0, 1));
    scene.sites.y.push_back(0.25 * static_cast<double>(random.whole(side)) + away * random.between(0, 1));
  }
  scene.domain = small_domain;
  return scene;
}

}  // namespace vorpipe::selftests
