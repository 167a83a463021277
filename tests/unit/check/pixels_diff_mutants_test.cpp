#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "unit/check/diff_pictures.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

constexpr std::uint64_t mutants_seed = 20240607;

/// For each pixel the site nearest to its center, the lowest index of several.
Ids nearestIds(const Sites& sites, const Box& domain) {
  Ids ids(at(picture_height, 0));
  for (int row = 0; row < picture_height; ++row) {
    for (int column = 0; column < picture_width; ++column) {
      const double x = domain.xmin + (column + 0.5) / picture_width * (domain.xmax - domain.xmin);
      const double y = domain.ymax - (row + 0.5) / picture_height * (domain.ymax - domain.ymin);
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const double dx = sites.x[i] - x, dy = sites.y[i] - y, square = dx * dx + dy * dy;
        if (square < least) {
          least = square;
          ids[at(row, column)] = static_cast<std::uint32_t>(i);
        }
      }
    }
  }
  return ids;
}

/// 200 random sites and their picture; each test alters a copy of it.
class DiffMutants : public testing::Test {
 protected:
  DiffMutants() { RecordProperty("seed", std::to_string(mutants_seed)); }

  void expectCaught(const Ids& mutant) const {
    const auto diff = diffIds(truth_, mutant, picture_width, picture_height, sites_, unit);
    ASSERT_TRUE(diff);
    EXPECT_GT(diff->wrong, 0u) << "seed " << mutants_seed;
    EXPECT_FALSE(diff->agree());
    EXPECT_EQ(diff->equal + diff->ties + diff->wrong, truth_.size());
    ASSERT_FALSE(diff->first.empty());
    const IdDifference& place = diff->first.front();
    EXPECT_EQ(diff->pixels[at(place.row, place.column)], PixelMatch::wrong);
    EXPECT_EQ(place.a, truth_[at(place.row, place.column)]);
    EXPECT_EQ(place.b, mutant[at(place.row, place.column)]);
  }

  const Sites sites_ = generate(Pattern::random, 200, mutants_seed);
  const Ids truth_ = nearestIds(sites_, unit);
};

TEST_F(DiffMutants, theSamePictureAgrees) {
  const auto diff = diffIds(truth_, truth_, picture_width, picture_height, sites_, unit);
  ASSERT_TRUE(diff);
  EXPECT_TRUE(diff->agree());
  EXPECT_EQ(diff->equal, truth_.size());
}

TEST_F(DiffMutants, aSiteMovedByAPixelIsCaught) {
  for (const std::size_t site : {std::size_t{0}, std::size_t{57}, std::size_t{199}}) {
    Sites moved = sites_;
    moved.x[site] += 1.0 / picture_width;
    expectCaught(nearestIds(moved, unit));
  }
}

TEST_F(DiffMutants, sitesMovedByTheVertexGridAgree) {
  Sites moved = sites_;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved.x[i] += (i % 2 == 0 ? 1.0 : -1.0) / (2048.0 * picture_width);
    moved.y[i] += (i % 3 == 0 ? 1.0 : -1.0) / (2048.0 * picture_height);
  }
  const auto diff = diffIds(truth_, nearestIds(moved, unit), picture_width, picture_height, sites_, unit);
  ASSERT_TRUE(diff);
  EXPECT_TRUE(diff->agree()) << diff->wrong << " wrong, seed " << mutants_seed;
}

TEST_F(DiffMutants, swappedIdsAreCaught) {
  const std::uint32_t one = truth_[at(60, 80)], other = truth_[at(10, 10)];
  ASSERT_NE(one, other);
  Ids mutant = truth_;
  for (std::uint32_t& id : mutant) id = id == one ? other : id == other ? one : id;
  expectCaught(mutant);
}

TEST_F(DiffMutants, swappedIdsOfNeighborsAreCaught) {
  int column = 80;
  while (truth_[at(60, column)] == truth_[at(60, 80)]) ++column;
  const std::uint32_t one = truth_[at(60, 80)], other = truth_[at(60, column)];
  Ids mutant = truth_;
  for (std::uint32_t& id : mutant) id = id == one ? other : id == other ? one : id;
  expectCaught(mutant);
}

TEST_F(DiffMutants, aMissingTriangleIsCaught) {
  // A wedge of the cell, from the site to the right.
  const std::uint32_t cell = truth_[at(60, 80)];
  const double x = sites_.x[cell] * picture_width, y = (1 - sites_.y[cell]) * picture_height;
  for (const bool background : {true, false}) {
    Ids mutant = truth_;
    for (int row = 0; row < picture_height; ++row) {
      for (int column = 0; column < picture_width; ++column) {
        const double dx = column + 0.5 - x, dy = row + 0.5 - y;
        const bool inside = truth_[at(row, column)] == cell && dx > 0 && std::abs(dy) < dx;
        if (inside) mutant[at(row, column)] = background ? no_site : (cell + 1) % 200;
      }
    }
    ASSERT_NE(mutant, truth_);
    expectCaught(mutant);
  }
}

TEST_F(DiffMutants, aShiftedColumnIsCaught) {
  Ids mutant = truth_;
  for (int row = 0; row < picture_height; ++row) mutant[at(row, 80)] = truth_[at(row, 79)];
  expectCaught(mutant);
}

TEST_F(DiffMutants, aPictureShiftedByAColumnIsCaught) {
  Ids mutant = truth_;
  for (int row = 0; row < picture_height; ++row) {
    for (int column = 1; column < picture_width; ++column)
      mutant[at(row, column)] = truth_[at(row, column - 1)];
  }
  expectCaught(mutant);
}

TEST_F(DiffMutants, aMirroredPictureIsCaught) {
  Ids left_right = truth_, upside_down = truth_;
  for (int row = 0; row < picture_height; ++row) {
    for (int column = 0; column < picture_width; ++column) {
      left_right[at(row, column)] = truth_[at(row, picture_width - 1 - column)];
      upside_down[at(row, column)] = truth_[at(picture_height - 1 - row, column)];
    }
  }
  expectCaught(left_right);
  expectCaught(upside_down);
}

TEST_F(DiffMutants, anUncoveredPixelIsCaught) {
  Ids mutant = truth_;
  mutant[at(119, 159)] = no_site;
  const auto diff = diffIds(truth_, mutant, picture_width, picture_height, sites_, unit);
  ASSERT_TRUE(diff);
  EXPECT_EQ(diff->wrong, 1u);
  EXPECT_EQ(diff->worst.row, 119);
  EXPECT_EQ(diff->worst.column, 159);
  EXPECT_TRUE(std::isinf(diff->worst.distance));
}

TEST_F(DiffMutants, aWrongDomainIsCaught) {
  Ids mutant = truth_;
  for (int row = 0; row < picture_height; ++row) {
    for (int column = 1; column < picture_width; ++column)
      mutant[at(row, column)] = truth_[at(row, column - 1)];
  }
  const auto diff = diffIds(truth_, mutant, picture_width, picture_height, sites_, Box{0, 0, 1e9, 1e9});
  ASSERT_TRUE(diff);
  EXPECT_FALSE(diff->agree());
}

}  // namespace
}  // namespace vorpipe::test
