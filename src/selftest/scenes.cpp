#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "selftest/run_scenes.h"

namespace vorpipe::selftests {
namespace {

/// Random numbers that are the same on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A whole number from 0 to `below` - 1.
  std::uint64_t whole(std::uint64_t below) { return engine_() % below; }

  /// A number in [low, high).
  double between(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }

  /// A coordinate of one of `side` lattice points that begin at 0 with a distance of `spacing`. About half of
  /// them are moved by up to `noise`.
  double nearLattice(std::uint64_t side, double spacing, double noise) {
    const double exact = spacing * static_cast<double>(whole(side));
    return whole(2) == 0 ? exact : exact + noise * between(0, 1);
  }

 private:
  std::mt19937_64 engine_;
};

// Powers of ten, because not all compilers accept floating-point template arguments.
constexpr double tenTo(int power) {
  double result = 1;
  for (int i = 0; i < (power < 0 ? -power : power); i++) result *= 10;
  return power < 0 ? 1 / result : result;
}

// Typical sites.

Scene patternScene(Pattern pattern, std::uint64_t sites, const Scale& scale) {
  Scene scene;
  scene.sites = generate(pattern, sites, scale.seed);
  return scene;
}

template <Pattern pattern, std::uint64_t few, std::uint64_t many>
Scene of(const Scale& scale) {
  return patternScene(pattern, scale.of(few, many), scale);
}

/// Cells of hundreds of pixels, whose corners need accurate floats.
template <std::uint64_t sites>
Scene few(const Scale& scale) {
  Scene scene = patternScene(Pattern::random, sites, scale);
  scene.width = scene.height = static_cast<int>(scale.of(400, 1000));
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

/// Wider than any view.
Scene wideStrip(const Scale& scale) {
  Scene scene = patternScene(Pattern::random, 400, scale);
  scene.width = static_cast<int>(scale.of(4200, 5000));
  scene.height = static_cast<int>(scale.of(40, 4200));
  return scene;
}

template <Periodic axes>
Scene periodic(const Scale& scale) {
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

// Weights.

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

/// Weights |p|^2 of points near a lattice: all cells nearly meet in one point.
template <std::uint64_t sites, int noise_power>
Scene lifted(const Scale& scale) {
  constexpr std::uint64_t side = 3;
  constexpr double noise = tenTo(noise_power);
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

// Coordinates that are very small, large or far away.

template <int power>
Scene sized(const Scale& scale) {
  constexpr double factor = tenTo(power);
  Scene scene = patternScene(Pattern::random, scale.of(300, 3000), scale);
  for (double& x : scene.sites.x) x *= factor;
  for (double& y : scene.sites.y) y *= factor;
  scene.domain = {0, 0, factor, factor};
  return scene;
}

template <int power>
Scene away(const Scale& scale) {
  constexpr double distance = tenTo(power);
  Scene scene = patternScene(Pattern::random, scale.of(200, 2000), scale);
  for (double& x : scene.sites.x) x += distance;
  for (double& y : scene.sites.y) y -= distance;
  // So many pixels that rounding their centers, to 1e-16 of the distance, moves them by a fraction of a
  // pixel.
  scene.width = scene.height = static_cast<int>(scale.of(500, 1000));
  scene.domain = {distance + 0.2, 0.3 - distance, distance + 0.7, 0.8 - distance};
  return scene;
}

// Sites that are very near to each other.

/// Few crowds of few sites: their cells reach across the domain and reveal how far a bisector is turned.
template <int power>
Scene crowded(const Scale& scale) {
  constexpr int sites_of_one = 6;
  constexpr double width = tenTo(power);
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
    const double distance = std::pow(10.0, random.between(-14, -6));
    const double angle = random.between(0, 2 * std::numbers::pi);
    scene.sites.x.insert(scene.sites.x.end(), {x, x + distance * std::cos(angle)});
    scene.sites.y.insert(scene.sites.y.end(), {y, y + distance * std::sin(angle)});
  }
  return scene;
}

// A small domain that cuts cells where they nearly meet.

constexpr Box small_domain{0.25, 0.25, 0.5, 0.75};

/// The cells of the circle nearly meet in its center, in the middle of a wall.
Scene circleInSmallDomain(const Scale& scale) {
  Scene scene = patternScene(Pattern::circle, scale.of(120, 1200), scale);
  Random random(scale.seed);
  for (double& x : scene.sites.x) x += random.nearLattice(1, 0, 1e-6);
  for (double& y : scene.sites.y) y += random.nearLattice(1, 0, 1e-6);
  scene.domain = small_domain;
  return scene;
}

/// The bisectors of its lattice points are the domain's walls, or end in its corners.
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

constexpr Traits once = Traits::once, random_ = Traits::random, often = Traits::often,
                 extreme = Traits::extreme;
constexpr Masked whole = Masked::nothing;

constexpr std::array kinds = {
    SceneKind{"even", "random", random_, whole, of<Pattern::random, 1000, 20'000>},
    SceneKind{"even", "jitter", random_, whole, of<Pattern::jitter, 1000, 20'000>},
    SceneKind{"even", "3 sites", random_, whole, few<3>},
    SceneKind{"even", "12 sites", random_, whole, few<12>},
    SceneKind{"clustered", "clusters", random_, whole, of<Pattern::clusters, 1500, 30'000>},
    SceneKind{"lattices", "square", once, whole, of<Pattern::square, 900, 10'000>},
    SceneKind{"lattices", "hexagonal", once, whole, of<Pattern::hex, 900, 10'000>},
    SceneKind{"curves", "circle", once, whole, of<Pattern::circle, 500, 5000>},
    SceneKind{"curves", "spiral", once, whole, spiral},
    SceneKind{"weights", "random", random_, whole, randomWeights},
    SceneKind{"weights", "20 of |p|^2, near twins", often, whole, lifted<20, -6>},
    SceneKind{"weights", "20 of |p|^2, nearer twins", often, whole, lifted<20, -7>},
    SceneKind{"weights", "260 of |p|^2, near twins", random_, whole, lifted<260, -7>},
    SceneKind{"periodic", "along x", random_, whole, periodic<Periodic::x>},
    SceneKind{"periodic", "along x and y", random_, whole, periodic<Periodic::xy>},
    SceneKind{"outline", "a star with a hole", random_, whole, ringOutline},
    SceneKind{"scales", "1e-100", random_, whole, sized<-100>},
    SceneKind{"scales", "1e30", random_, whole, sized<30>},
    SceneKind{"scales", "1e12 away", random_, whole, away<12>},
    SceneKind{"scales", "1e160", extreme, whole, sized<160>},
    SceneKind{"scales", "1e-170", extreme, whole, sized<-170>},
    SceneKind{"crowds", "1e-7 wide", random_, whole, crowded<-7>},
    SceneKind{"crowds", "1e-9 wide", random_, whole, crowded<-9>},
    SceneKind{"crowds", "1e-11 wide", random_, whole, crowded<-11>},
    SceneKind{"crowds", "1e-13 wide", random_, whole, crowded<-13>},
    SceneKind{"crowds", "near twins", random_, whole, nearTwins},
    SceneKind{"slivers", "a rough circle, cut", often, whole, circleInSmallDomain},
    SceneKind{"slivers", "a rough lattice, cut", often, whole, latticeInSmallDomain},
    SceneKind{"large", "many sites", once, whole, of<Pattern::random, 20'000, 300'000>},
    SceneKind{"large", "a wide picture", once, whole, wideStrip},
    SceneKind{"small limits", "random, in tiles", random_, Masked::limits,
              of<Pattern::random, 4000, 200'000>},
    SceneKind{"small limits", "clusters, in tiles", random_, Masked::limits,
              of<Pattern::clusters, 4000, 200'000>},
    SceneKind{"4 sub-pixel bits", "random", random_, Masked::bits, of<Pattern::random, 1000, 20'000>},
    SceneKind{"4 sub-pixel bits", "12 sites", random_, Masked::bits, few<12>},
    SceneKind{"4 sub-pixel bits", "hexagonal", once, Masked::bits, of<Pattern::hex, 400, 10'000>},
};

}  // namespace

std::span<const SceneKind> sceneKinds() { return kinds; }

Mask maskOf(Masked masked, const Scale& scale) {
  Mask mask;
  if (masked == Masked::limits) {
    mask.limits = {{"maxTexelBufferElements", scale.of(1024, 65536)},
                   {"maxStorageBufferRange", scale.of(16384, 65536)}};
  }
  if (masked == Masked::bits) mask.limits = {{"subPixelPrecisionBits", 4}};
  return mask;
}

}  // namespace vorpipe::selftests
