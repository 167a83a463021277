#include "selftest/makers.h"

namespace vorpipe::selftests {

Scene scaled(double factor, const Scale& scale) {
  Scene scene = patternScene(Pattern::random, scale.of(300, 3000), scale);
  for (double& x : scene.sites.x) x *= factor;
  for (double& y : scene.sites.y) y *= factor;
  scene.domain = {0, 0, factor, factor};
  return scene;
}

Scene farAway(double distance, const Scale& scale) {
  Scene scene = patternScene(Pattern::random, scale.of(200, 2000), scale);
  for (double& x : scene.sites.x) x += distance;
  for (double& y : scene.sites.y) y -= distance;
  // So many pixels that rounding their centers, to 1e-16 of the distance, moves them by a fraction of a
  // pixel.
  scene.width = scene.height = static_cast<int>(scale.of(500, 1000));
  scene.domain = {distance + 0.2, 0.3 - distance, distance + 0.7, 0.8 - distance};
  return scene;
}

}  // namespace vorpipe::selftests
