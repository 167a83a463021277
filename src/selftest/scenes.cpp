#include <array>

#include "selftest/makers.h"

namespace vorpipe::selftests {
namespace {

constexpr Traits once = Traits::once, random_ = Traits::random, often = Traits::often,
                 extreme = Traits::extreme;
constexpr Masked whole = Masked::nothing;

template <Pattern pattern, std::uint64_t few, std::uint64_t many>
Scene of(const Scale& scale) {
  return patternScene(pattern, scale.of(few, many), scale);
}

template <std::uint64_t sites>
Scene few(const Scale& scale) {
  return fewSites(sites, scale);
}

template <Periodic axes>
Scene repeated(const Scale& scale) {
  return periodic(axes, scale);
}

// Powers of ten, because not all compilers accept floating-point template arguments.
constexpr double tenTo(int power) {
  double result = 1;
  for (int i = 0; i < (power < 0 ? -power : power); i++) result *= 10;
  return power < 0 ? 1 / result : result;
}

template <int power>
Scene sized(const Scale& scale) {
  return scaled(tenTo(power), scale);
}

template <int power>
Scene away(const Scale& scale) {
  return farAway(tenTo(power), scale);
}

template <std::uint64_t sites, int power>
Scene lifted(const Scale& scale) {
  return liftedTwins(sites, tenTo(power), scale);
}

template <int power>
Scene crowded(const Scale& scale) {
  return crowds(tenTo(power), scale);
}

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
    SceneKind{"periodic", "along x", random_, whole, repeated<Periodic::x>},
    SceneKind{"periodic", "along x and y", random_, whole, repeated<Periodic::xy>},
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
    SceneKind{"large", "many sites", once, whole, manySites},
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
