#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/base/npy_array.h"
#include "io/sites/weights_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;

class Weights : public InTemporaryDirectory {
 protected:
  [[nodiscard]] std::vector<double> read(std::string_view name, std::string_view text,
                                         std::uint64_t count) const {
    const auto weights = readWeights(write(name, text), count);
    EXPECT_TRUE(weights) << weights.error().message;
    return weights.value_or(std::vector<double>{});
  }
  /// What is said about the file, after its name.
  [[nodiscard]] std::string refusal(std::string_view name, std::string_view text, std::uint64_t count) const {
    const std::string file = write(name, text);
    const auto weights = readWeights(file, count);
    if (weights) {
      ADD_FAILURE() << "was accepted";
      return "";
    }
    EXPECT_EQ(weights.error().code, ErrorCode::input);
    EXPECT_TRUE(weights.error().message.starts_with(file + ":")) << weights.error().message;
    return weights.error().message.substr(file.size() + 1);
  }
  template <class Number>
  [[nodiscard]] static std::string npy(const std::vector<Number>& numbers) {
    const auto array = npyArray<Number, 1>(std::span(numbers));
    return array.header + std::string(array.elements);
  }
};

TEST_F(Weights, AreANumberToALine) {
  EXPECT_THAT(read("w.txt", "1\n-2.5\r\n 1e-300 # small\n\n# none\n+4", 4), ElementsAre(1, -2.5, 1e-300, 4));
  EXPECT_THAT(read("w.CSV", "7\n8\n", 2), ElementsAre(7, 8));
}

TEST_F(Weights, MayHaveAHeader) {
  EXPECT_THAT(read("w.csv", "weight\n7\n-8\n", 2), ElementsAre(7, -8));
  EXPECT_THAT(read("w.txt", "# radii\nradius\n3\n0.5\n", 2), ElementsAre(9, 0.25));
}

TEST_F(Weights, ComeFromNumPy) {
  EXPECT_THAT(read("w.npy", npy<double>({1, -2.5}), 2), ElementsAre(1, -2.5));
  EXPECT_THAT(read("w.npy", npy<float>({0.5F, 3}), 2), ElementsAre(0.5, 3));
}

TEST_F(Weights, AreAsManyAsSites) {
  EXPECT_EQ(refusal("w.txt", "1\n2\n", 3), "3:1: the file ends after 2 weights, there are 3 sites");
  EXPECT_EQ(refusal("w.txt", "1\n2\n\n3\n", 2), "4:1: a weight too many, there are 2 sites");
  EXPECT_EQ(refusal("w.txt", "", 1), "1:1: the file ends after 0 weights, there are 1 site");
  EXPECT_EQ(refusal("w.npy", npy<double>({1, 2}), 1), " holds 2 weights, there are 1 site");
}

TEST_F(Weights, AreFiniteNumbers) {
  EXPECT_EQ(refusal("w.txt", "1\n  nan\n", 2), "2:3: \"nan\" is not a finite number");
  EXPECT_EQ(refusal("w.txt", "1 2\n", 1), "1:1: \"1 2\" is not a number");
  EXPECT_EQ(refusal("w.csv", "weights\n1\n", 1), "1:1: \"weights\" is not a number");
  EXPECT_EQ(refusal("w.csv", "radius\n-1\n", 1), "2:1: \"-1\" is negative, and a radius");
  EXPECT_EQ(refusal("w.csv", "radius\n1e200\n", 1),
            "2:1: the square of \"1e200\" is out of the range of a double");
  EXPECT_EQ(refusal("w.npy", npy<double>({1, std::nan("")}), 2),
            " element [1] (counted from 0) is nan, not a finite number");
  EXPECT_EQ(refusal("w.doc", "1\n", 1), " unknown kind of file for weights; known are .txt, .csv and .npy");
}

TEST(RandomWeights, AreTheSameOnEveryPlatform) {
  const auto weights = randomWeights(-1, 3, 1000, 1);
  EXPECT_THAT(std::vector(weights.begin(), weights.begin() + 3),
              ElementsAre(-0x1.e1c9c626fdd80p-4, 0x1.61ed6d9046634p+1, 0x1.26d11f7b08050p-3));
  EXPECT_EQ(weights, randomWeights(-1, 3, 1000, 1));
  EXPECT_NE(weights, randomWeights(-1, 3, 1000, 2));
  const auto [least, greatest] = std::ranges::minmax(weights);
  EXPECT_GE(least, -1);
  EXPECT_LE(least, -0.98);
  EXPECT_LE(greatest, 3);
  EXPECT_GE(greatest, 2.98);
  EXPECT_THAT(randomWeights(2, 2, 2, 1), ElementsAre(2, 2));
}

TEST(RandomWeights, AreNotTheCoordinates) {
  const Sites sites = generate(Pattern::random, 100, 1);
  const auto weights = randomWeights(0, 1, 200, 1);
  for (const double weight : weights) {
    EXPECT_EQ(std::ranges::count(sites.x, weight) + std::ranges::count(sites.y, weight), 0);
  }
}

}  // namespace
}  // namespace vorpipe::test
