#include "selftest/makers.h"
#include "selftest/random.h"

namespace vorpipe::selftests {

Scene randomWeights(const Scale& scale) {
  const std::uint64_t count = scale.of(600, 6000);
  Scene scene = patternScene(Pattern::random, count, scale);
  Random random(scale.seed);
  // In units of the squared mean distance, so that some sites are hidden and most are not.
  for (std::uint64_t i = 0; i < count; i++) {
    scene.sites.weight.push_back(random.between(-1, 1) / static_cast<double>(count));
  }
  return scene;
}

Scene liftedTwins(std::uint64_t sites, double noise, const Scale& scale) {
  constexpr std::uint64_t side = 3;
  Random random(scale.seed);
  Scene scene;
  for (std::uint64_t i = 0; i < sites; i++) {
    const double x = random.nearLattice(side, 1, noise), y = random.nearLattice(side, 1, noise);
    scene.sites.x.push_back(x);
    scene.sites.y.push_back(y);
    scene.sites.weight.push_back(x * x + y * y);
  }
  scene.domain = {-0.1, -0.1, 2.1, 2.1};
  return scene;
}

}  // namespace vorpipe::selftests
