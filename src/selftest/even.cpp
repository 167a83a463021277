#include <cmath>
#include <numbers>

#include "selftest/makers.h"
#include "selftest/random.h"

namespace vorpipe::selftests {

Scene patternScene(Pattern pattern, std::uint64_t sites, const Scale& scale) {
  Scene scene;
  scene.sites = generate(pattern, sites, scale.seed);
  return scene;
}

Scene spiral(const Scale& scale) {
  constexpr double turns = 9;
  const std::uint64_t count = scale.of(600, 6000);
  Scene scene;
  for (std::uint64_t i = 0; i < count; i++) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double angle = 2 * std::numbers::pi * turns * std::sqrt(part);
    scene.sites.x.push_back(0.5 + 0.48 * std::sqrt(part) * std::cos(angle));
    scene.sites.y.push_back(0.5 + 0.48 * std::sqrt(part) * std::sin(angle));
  }
  return scene;
}

Scene fewSites(std::uint64_t sites, const Scale& scale) {
  Scene scene = patternScene(Pattern::random, sites, scale);
  scene.width = scene.height = static_cast<int>(scale.of(400, 1000));
  return scene;
}

Scene manySites(const Scale& scale) {
  return patternScene(Pattern::random, scale.of(20'000, 300'000), scale);
}

Scene wideStrip(const Scale& scale) {
  Scene scene = patternScene(Pattern::random, 400, scale);
  scene.width = static_cast<int>(scale.of(4200, 5000));
  scene.height = static_cast<int>(scale.of(40, 4200));
  return scene;
}

Scene periodic(Periodic axes, const Scale& scale) {
  Scene scene = patternScene(Pattern::random, scale.of(300, 3000), scale);
  scene.periodic = axes;
  return scene;
}

Scene ringOutline(const Scale& scale) {
  constexpr int points = 22;
  Scene scene = patternScene(Pattern::random, scale.of(400, 4000), scale);
  Outline& outline = scene.outline;
  for (int i = 0; i < points; i++) {
    const double angle = 2 * std::numbers::pi * i / points;
    const double radius = i % 2 == 0 ? 0.47 : 0.31;
    outline.points.push_back({0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)});
  }
  for (const Point hole : {Point{0.4, 0.42}, Point{0.61, 0.45}, Point{0.52, 0.63}})
    outline.points.push_back(hole);
  outline.ring_offsets = {0, points, points + 3};
  outline.polygon_offsets = {0, 2};
  return scene;
}

}  // namespace vorpipe::selftests
