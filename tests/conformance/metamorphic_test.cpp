/// What must become of the cells and the picture when the input is changed in a way whose effect is known:
/// the diagram of turned, mirrored, scaled, shifted or renumbered sites is that of the sites, turned,
/// mirrored and so on. No oracle is asked.
#include "conformance/metamorphic_fixture.h"

namespace vorpipe::test {
namespace {

TEST_P(Metamorphic, MirroredSitesHaveMirroredCells) {
  forInputs([](const HardInput& input) {
    expectMoved(input, {"mirrored in x", -1, 0, 0, 1});
    expectMoved(input, {"mirrored in y", 1, 0, 0, -1});
  });
}

TEST_P(Metamorphic, TurnedSitesHaveTurnedCells) {
  forInputs([](const HardInput& input) {
    expectMoved(input, {"turned by a right angle", 0, -1, 1, 0});
    expectMoved(input, {"mirrored at the diagonal", 0, 1, 1, 0});
  });
}

template <class T>
std::vector<T> times(std::vector<T> values, double factor) {
  for (T& value : values) value *= factor;
  return values;
}

std::vector<double> coordinates(const std::vector<Point>& points) {
  std::vector<double> numbers;
  for (const Point p : points) numbers.insert(numbers.end(), {p.x, p.y});
  return numbers;
}

/// To the bit: a power of two rounds nothing.
TEST_P(Metamorphic, SitesScaledByAPowerOfTwoHaveTheSameBits) {
  forInputs([](const HardInput& input) {
    const auto plain = cellsOf(input);
    const auto image = pictureOf(input);
    for (const int exponent : {-40, 1, 33}) {
      SCOPED_TRACE(exponent);
      const double s = std::ldexp(1.0, exponent);
      const auto other = moved(input, {"scaled", 1, 0, 0, 1, s});
      const auto scaled = cellsOf(other);
      EXPECT_EQ(scaled.status, plain.status);
      EXPECT_EQ(scaled.neighbors, plain.neighbors);
      EXPECT_EQ(scaled.cell_offsets, plain.cell_offsets);
      EXPECT_EQ(scaled.triangles, plain.triangles);
      EXPECT_EQ(scaled.area, times(plain.area, s * s));
      EXPECT_EQ(scaled.edge_lengths, times(plain.edge_lengths, s));
      EXPECT_EQ(coordinates(scaled.vertices), times(coordinates(plain.vertices), s));
      EXPECT_EQ(coordinates(scaled.centroid), times(coordinates(plain.centroid), s));
      const auto picture = pictureOf(other);
      EXPECT_EQ(picture.ids, image.ids);
      EXPECT_EQ(picture.rgba, image.rgba);
    }
  });
}

/// By a power of two so small beside the last places of all coordinates that no sum is rounded: to be so, the
/// sites are put on a grid first, whose steps are many of a coordinate: corners are rounded.
TEST_P(Metamorphic, ShiftedSitesHaveShiftedCells) {
  forInputs([](HardInput input) {
    const Box& box = input.domain;
    double largest =
        std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
    for (std::size_t i = 0; i < input.sites.size(); ++i)
      largest = std::max({largest, std::abs(input.sites.x[i]), std::abs(input.sites.y[i])});
    // Where coordinates have few steps to a pixel, centers of pixels are rounded by more than ties are wide.
    if (largest > 0x1p20 * std::max(box.xmax - box.xmin, box.ymax - box.ymin)) return;
    const double by = std::exp2(std::ceil(std::log2(largest))), quantum = by * 0x1p-36;
    const auto put = [quantum](double& value) { value = std::round(value / quantum) * quantum; };
    for (std::size_t i = 0; i < input.sites.size(); ++i) {
      put(input.sites.x[i]);
      put(input.sites.y[i]);
    }
    for (Point& p : input.outline.points) {
      put(p.x);
      put(p.y);
    }
    for (double* wall : {&input.domain.xmin, &input.domain.ymin, &input.domain.xmax, &input.domain.ymax})
      put(*wall);
    if (!isTaken(input)) return;
    expectMoved(withoutDuplicates(input), {"shifted", 1, 0, 0, 1, 1, {by, -by}});
  });
}

TEST_P(Metamorphic, TheOrderOfSitesIsOfNoMatter) {
  forInputs([](const HardInput& input) {
    std::vector<std::uint32_t> order(input.sites.size());
    std::iota(order.begin(), order.end(), 0u);
    std::mt19937_64 random(seedOfRun());
    std::ranges::shuffle(order, random);
    const auto other = chosen(input, order);
    expectSameCells(input, cellsOf(input), renumbered(cellsOf(other), order, order.size()));
    auto ids = pictureOf(other).ids;
    for (auto& id : ids) id = id == no_site ? no_site : order[id];
    expectSameIds(input, pictureOf(input), ids);
  });
}

TEST_P(Metamorphic, ASiteWithoutACellIsOfNoMatter) {
  forInputs([](const HardInput& input) {
    const auto whole = cellsOf(input);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < input.sites.size(); ++i) {
      if (whole.status[i] != Status::empty) kept.push_back(i);
    }
    if (kept.empty() || kept.size() == input.sites.size()) return;
    const auto other = chosen(input, kept);
    expectSameCells(input, whole, renumbered(cellsOf(other), kept, input.sites.size()));
    auto ids = pictureOf(other).ids;
    for (auto& id : ids) id = id == no_site ? no_site : kept[id];
    expectSameIds(input, pictureOf(input), ids);
  });
}

TEST_P(Metamorphic, EqualWeightsAreNone) {
  forInputs([](HardInput input) {
    input.sites.weight.clear();
    const auto plain = cellsOf(input);
    const auto image = pictureOf(input);
    const Box& box = input.domain;
    const double side_of_domain = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
    for (const double squares : {0.0, -3.5, 1e-30, 1e9}) {
      SCOPED_TRACE(squares);
      const double weight = squares * side_of_domain * side_of_domain;
      input.sites.weight.assign(input.sites.size(), weight);
      const auto weighted = cellsOf(input);
      EXPECT_EQ(weighted.status, plain.status);
      EXPECT_EQ(weighted.area, plain.area);
      EXPECT_EQ(weighted.neighbors, plain.neighbors);
      EXPECT_EQ(weighted.triangles, plain.triangles);
      EXPECT_EQ(pictureOf(input).ids, image.ids);
    }
  });
}

TEST_P(Metamorphic, DuplicatesChangeNothingButTheirOwnRecords) {
  forInputs([](const HardInput& input) {
    const auto count = static_cast<std::uint32_t>(input.sites.size());
    std::vector<std::uint32_t> with(count);
    std::iota(with.begin(), with.end(), 0u);
    Random random(seedOfRun());
    for (int k = 0; k < 5; ++k) with.push_back(static_cast<std::uint32_t>(random.below(count)));
    const auto other = chosen(input, with);
    const auto doubled = cellsOf(other);
    for (std::size_t k = count; k < with.size(); ++k) {
      EXPECT_EQ(doubled.status[k], Status::duplicate);
      EXPECT_EQ(doubled.owner[k], with[k]);
      EXPECT_EQ(doubled.area[k], 0);
    }
    auto first = doubled;
    first.status.resize(count);
    first.owner.resize(count);
    first.area.resize(count);
    expectSameCells(input, cellsOf(input), first);
    expectSameIds(input, pictureOf(input), pictureOf(other).ids);
  });
}

INSTANTIATE_TEST_SUITE_P(Backends, Metamorphic, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
