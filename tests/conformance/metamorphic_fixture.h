/// Inputs that are changed in a way whose effect is known, and what must then become of cells and pictures.
#pragma once

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "conformance/cells_fixture.h"
#include "support/hard/hard_random.h"
#include "support/hard/hard_runs.h"
#include "support/sites/data_sets.h"
#include "support/sites/moves.h"

namespace vorpipe::test {

inline constexpr std::uint64_t hard_count = 8;
inline constexpr int side = 48;

/// That of VORPIPE_SEED, of which `random` is a new one. Not new in every run: of edges as long as a tie,
/// some are one in a mirrored input and none in the other.
inline std::uint64_t seedOfRun() {
  static const std::uint64_t seed = [] {
    const char* given = std::getenv("VORPIPE_SEED");
    const std::string wanted = given != nullptr ? given : "1";
    const std::uint64_t drawn = wanted == "random" ? std::random_device()() : std::stoull(wanted);
    std::cout << "[   SEED   ] " << drawn << std::endl;
    return drawn;
  }();
  return seed;
}

inline HardInput inputOf(std::string name, Sites sites, const Box& domain = unit) {
  HardInput input;
  input.kinds = std::move(name);
  input.sites = std::move(sites);
  input.domain = domain;
  input.width = side + 16;
  input.height = side;
  return input;
}

inline HardInput outlined(HardInput input) {
  input.kinds += " in an outline";
  input.outline = {
      {{0.1, 0.1}, {0.9, 0.05}, {0.7, 0.5}, {0.95, 0.9}, {0.2, 0.8}, {0.4, 0.3}, {0.6, 0.3}, {0.5, 0.6}},
      {0, 5, 8},
      {0, 2}};
  input.domain = boxOf(input.outline.points);
  return input;
}

inline HardInput repeated(HardInput input, Periodic periodic) {
  input.kinds += " in a periodic domain";
  input.periodic = periodic;
  return input;
}

/// Along axes that repeat, places at the domain's ends may be rounded out of it. Where the cell of such a
/// site stands is a convention that mirrors do not know.
inline void putInside(HardInput& input) {
  const Box& box = input.domain;
  const bool x = input.periodic == Periodic::x || input.periodic == Periodic::xy;
  const bool y = input.periodic == Periodic::y || input.periodic == Periodic::xy;
  for (double& at : input.sites.x) at = x ? std::clamp(at, box.xmin, box.xmax) : at;
  for (double& at : input.sites.y) at = y ? std::clamp(at, box.ymin, box.ymax) : at;
}

/// As a periodic domain takes them, so that nothing is wrapped again elsewhere; and not too many.
inline HardInput hardInput(std::uint64_t number) {
  auto input = makeHardInput(seedOfRun(), number);
  constexpr std::size_t most = 150;
  if (input.sites.size() > most) {
    std::vector<std::uint32_t> first(most);
    std::iota(first.begin(), first.end(), 0u);
    input = chosen(input, first);
  }
  if (auto inside = wrapped(input.sites, input.domain, input.periodic)) input.sites = std::move(*inside);
  putInside(input);
  input.width = std::min(input.width, side);
  input.height = std::min(input.height, side);
  return input;
}

inline std::vector<HardInput> inputs() {
  const auto seed = seedOfRun();
  std::vector<HardInput> all;
  all.push_back(inputOf("random", generate(Pattern::random, 150, seed)));
  all.push_back(inputOf("clusters", generate(Pattern::clusters, 150, seed)));
  all.push_back(inputOf("square lattice", generate(Pattern::square, 100, seed)));
  all.push_back(inputOf("hexagonal lattice", generate(Pattern::hex, 90, seed), {0.1, 0.2, 0.9, 0.7}));
  for (const char* name : {"weights-1", "weights-100", "chessboard-verge"}) {
    auto set = makeDataSet(name, 120, seed);
    all.push_back(inputOf(name, std::move(set.sites), set.domain));
  }
  all.push_back(repeated(inputOf("random", generate(Pattern::random, 60, seed)), Periodic::xy));
  all.push_back(repeated(all[4], Periodic::x));
  all.push_back(outlined(inputOf("random", generate(Pattern::random, 100, seed))));
  for (std::uint64_t number = 0; number < hard_count; ++number) all.push_back(hardInput(number));
  return all;
}

class Metamorphic : public Cells {
 protected:
  /// Calls test(input) for all inputs that are not refused, without their duplicates.
  template <class Test>
  static void forInputs(const Test& test) {
    for (auto input : inputs()) {
      if (!isTaken(input)) continue;
      SCOPED_TRACE(testing::Message() << describe(input) << ", seed of the run " << seedOfRun());
      try {
        test(withoutDuplicates(input));
      } catch (const std::runtime_error& error) {
        ADD_FAILURE() << error.what();
      }
    }
  }

  static bool isTaken(const HardInput& input) {
    if (!checkInput(input.sites, cellsOptions(input))) return false;
    const auto diagram = sharedSession(GetParam()).cells(input.sites, cellsOptions(input));
    return diagram || !isRefusal(diagram.error());
  }

  static HardInput withoutDuplicates(const HardInput& input) {
    const auto diagram = cellsOf(input);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < input.sites.size(); ++i) {
      if (diagram.status[i] != Status::duplicate) kept.push_back(i);
    }
    return kept.size() == input.sites.size() ? input : chosen(input, kept);
  }

  static Diagram cellsOf(const HardInput& input) { return cells(input.sites, cellsOptions(input)); }

  static Image pictureOf(const HardInput& input) {
    auto rendering = sharedSession(GetParam()).render(input.sites, pictureOptions(input));
    if (!rendering) throw std::runtime_error(rendering.error().message);
    EXPECT_EQ(rendering->report.validation_messages, std::vector<std::string>{});
    return std::move(rendering->image);
  }

  static double distance(Point p, Point a, Point b) {
    const Point edge{b.x - a.x, b.y - a.y}, to{p.x - a.x, p.y - a.y};
    const double squared = edge.x * edge.x + edge.y * edge.y;
    const double along = squared > 0 ? std::clamp((to.x * edge.x + to.y * edge.y) / squared, 0.0, 1.0) : 0;
    return std::hypot(to.x - along * edge.x, to.y - along * edge.y);
  }

  /// Whether a pixel's center is as near to an edge of the outline as rounding is: it may have a site or
  /// none.
  static bool isOnOutline(const HardInput& input, std::size_t pixel) {
    const Box& box = input.domain;
    const auto columns = static_cast<std::size_t>(input.width);
    const double right = (static_cast<double>(pixel % columns) + 0.5) / input.width;
    const double down = (static_cast<double>(pixel / columns) + 0.5) / input.height;
    const Point center{box.xmin + right * (box.xmax - box.xmin), box.ymax - down * (box.ymax - box.ymin)};
    const double rounding =
        1e-14 * std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
    const auto& [points, rings, polygons] = input.outline;
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      for (auto k = rings[r]; k < rings[r + 1]; ++k) {
        const Point next = points[k + 1 < rings[r + 1] ? k + 1 : rings[r]];
        if (distance(center, points[k], next) <= rounding) return true;
      }
    }
    return false;
  }

  /// `ids` with those of `image` where one of the two has no site and the pixel is on the outline.
  static std::vector<std::uint32_t> withoutEdgePixels(const HardInput& input, const Image& image,
                                                      std::span<const std::uint32_t> ids) {
    std::vector<std::uint32_t> settled(ids.begin(), ids.end());
    for (std::size_t pixel = 0; pixel < settled.size(); ++pixel) {
      const bool differ = (settled[pixel] == no_site) != (image.ids[pixel] == no_site);
      if (differ && isOnOutline(input, pixel)) settled[pixel] = image.ids[pixel];
    }
    return settled;
  }

  /// Whether a pixel has so few steps of a coordinate that its center, and bisectors, are rounded by more
  /// than ties are wide.
  static bool hasCoarsePixels(const HardInput& input) {
    const Box& box = input.domain;
    double largest =
        std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
    for (std::size_t i = 0; i < input.sites.size(); ++i)
      largest = std::max({largest, std::abs(input.sites.x[i]), std::abs(input.sites.y[i])});
    constexpr double steps = 0x1p16;
    return std::max(box.xmax - box.xmin, box.ymax - box.ymin) <
           steps * side * std::numeric_limits<double>::epsilon() * largest;
  }

  static void expectSameIds(const HardInput& input, const Image& image, std::span<const std::uint32_t> ids) {
    if (hasCoarsePixels(input)) return;
    const auto settled = withoutEdgePixels(input, image, ids);
    const auto diff =
        diffIds(image.ids, settled, input.width, input.height, input.sites, input.domain, input.periodic);
    ASSERT_TRUE(diff);
    EXPECT_TRUE(diff->agree()) << diff->wrong << " pixels are wrong and " << diff->ties << " ties, "
                               << diff->ties_allowed << " allowed";
  }

  /// That a changed input has the same cells, and the same picture but for ties.
  static void expectMoved(const HardInput& input, const Move& move) {
    SCOPED_TRACE(move.name);
    const auto other = moved(input, move);
    expectSameCells(input, cellsOf(input), movedBack(cellsOf(other), move));
    expectSameIds(input, pictureOf(input), movedBack(pictureOf(other), move));
  }

  using ImageOf = std::pair<std::int64_t, std::array<std::int32_t, 2>>;

  /// The longest edge with each neighbor.
  static std::map<ImageOf, double> edgesOf(const Diagram& d, std::size_t i) {
    std::map<ImageOf, double> edges;
    for (auto e = d.cell_offsets[i]; e < d.cell_offsets[i + 1]; ++e) {
      const auto shift = d.neighbor_shifts.empty() ? std::array<std::int32_t, 2>{} : d.neighbor_shifts[e];
      auto& longest = edges[{d.neighbors[e], shift}];
      longest = std::max(longest, d.edge_lengths[e]);
    }
    return edges;
  }

  /// Where a cell has an edge that the other one lacks it is hardly longer than a tie. Ties at its ends may
  /// have taken one of the two, so that all distances at the cell count.
  static testing::AssertionResult areTies(const HardInput& input, const Diagram& a, const Diagram& b,
                                          std::size_t i) {
    const Box& box = input.domain;
    const auto edges_a = edgesOf(a, i), edges_b = edgesOf(b, i);
    double reach = 0, longest_missing = 0;
    const auto look = [&](const auto& here, const auto& there) {
      for (const auto& [neighbor, length] : here) {
        const auto& [j, shift] = neighbor;
        if (!there.contains(neighbor)) longest_missing = std::max(longest_missing, length);
        if (j < 0) continue;
        const auto site = static_cast<std::size_t>(j);
        reach = std::max(
            reach, std::hypot(input.sites.x[site] + shift[0] * (box.xmax - box.xmin) - input.sites.x[i],
                              input.sites.y[site] + shift[1] * (box.ymax - box.ymin) - input.sites.y[i]));
      }
    };
    look(edges_a, edges_b);
    look(edges_b, edges_a);
    // In an outline corners are rounded like coordinates, and with them the edges between.
    const double largest =
        std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
    const double clipped = input.outline.empty() ? 0 : 64 * std::numeric_limits<double>::epsilon() * largest;
    // With weights a cell may be much smaller than how far away its neighbors were that ties took.
    const double side_of_domain = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
    const double rounding = clipped + (input.sites.weight.empty() ? 0 : 1e-12 * side_of_domain);
    if (longest_missing <= 1.1e-6 * reach + rounding) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "only one has an edge of length " << longest_missing
                                       << ", its neighbors are up to " << reach << " away";
  }

  static void expectSameCells(const HardInput& input, const Diagram& a, const Diagram& b) {
    const auto diff = diffCells(a, b);
    ASSERT_TRUE(diff);
    EXPECT_EQ(diff->statuses, 0u);
    EXPECT_EQ(diff->areas, 0u) << "site " << diff->worst_site << " by " << diff->worst_area;
    if (diff->neighbors == 0) return;
    for (std::size_t i = 0; i < input.sites.size(); ++i) EXPECT_TRUE(areTies(input, a, b, i)) << "site " << i;
  }
};

}  // namespace vorpipe::test
