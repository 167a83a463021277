#include <cmath>
#include <numbers>

#include "selftest/makers.h"
#include "selftest/random.h"

namespace vorpipe::selftests {

// Few crowds of few sites: their cells reach across the domain and reveal how far a bisector is turned.
Scene crowds(double width, const Scale& scale) {
  constexpr int sites_of_one = 6;
  const std::uint64_t count = scale.of(2, 5);
  Random random(scale.seed);
  Scene scene;
  for (std::uint64_t crowd = 0; crowd < count; crowd++) {
    const double x = random.between(0.05, 0.95), y = random.between(0.05, 0.95);
    for (int i = 0; i < sites_of_one; i++) {
      scene.sites.x.push_back(x + width * random.between(0, 1));
      scene.sites.y.push_back(y + width * random.between(0, 1));
    }
  }
  scene.width = scene.height = static_cast<int>(scale.of(500, 1000));
  return scene;
}

Scene nearTwins(const Scale& scale) {
  const std::uint64_t pairs = scale.of(60, 600);
  Random random(scale.seed);
  Scene scene;
  for (std::uint64_t i = 0; i < pairs; i++) {
    const double x = random.between(0, 1), y = random.between(0, 1);
    const double distance = random.power(-14, -6), angle = random.between(0, 2 * std::numbers::pi);
    scene.sites.x.insert(scene.sites.x.end(), {x, x + distance * std::cos(angle)});
    scene.sites.y.insert(scene.sites.y.end(), {y, y + distance * std::sin(angle)});
  }
  return scene;
}

}  // namespace vorpipe::selftests
