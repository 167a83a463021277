#include "selftest/makers.h"
#include "selftest/random.h"

namespace vorpipe::selftests {
namespace {

constexpr Box small_domain{0.25, 0.25, 0.5, 0.75};

}  // namespace

// The cells of the circle nearly meet in its center, in the middle of a wall.
Scene circleInSmallDomain(const Scale& scale) {
  Scene scene = patternScene(Pattern::circle, scale.of(120, 1200), scale);
  Random random(scale.seed);
  for (double& x : scene.sites.x) x += random.nearLattice(1, 0, 1e-6);
  for (double& y : scene.sites.y) y += random.nearLattice(1, 0, 1e-6);
  scene.domain = small_domain;
  return scene;
}

// The bisectors of its lattice points are the domain's walls, or end in its corners.
Scene latticeInSmallDomain(const Scale& scale) {
  constexpr std::uint64_t side = 3;
  const std::uint64_t count = scale.of(120, 240);
  Random random(scale.seed);
  Scene scene;
  for (std::uint64_t i = 0; i < count; i++) {
    scene.sites.x.push_back(random.nearLattice(side, 0.5, 1e-6));
    scene.sites.y.push_back(random.nearLattice(side, 0.5, 1e-6));
  }
  scene.domain = small_domain;
  return scene;
}

}  // namespace vorpipe::selftests
