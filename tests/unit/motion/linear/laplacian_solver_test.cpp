#include "motion/linear/laplacian_solver.h"
#include "unit/fixtures/cpu_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "motion/memory_order.h"
#include "vorpipe.h"

namespace vorpipe::moving {
namespace {

// Below and above what is solved by factors (decision D110); of the last, loops run on several threads.
constexpr std::uint32_t few = 40, many = 150, very_many = 200;

/// Numbers from 0 to 1, the same everywhere.
class Numbers {
 public:
  double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::vector<double> several(std::size_t count) {
    std::vector<double> numbers(count);
    for (auto& number : numbers) number = next();
    return numbers;
  }

 private:
  std::mt19937_64 engine_{7};
};

struct Edge {
  std::uint32_t a, b;
  double coupling;
};

Laplacian matrixOf(std::size_t rows, const std::vector<Edge>& edges) {
  std::vector<std::vector<std::pair<std::uint32_t, double>>> entries(rows);
  for (const auto& [a, b, coupling] : edges) {
    entries[a].emplace_back(b, coupling);
    entries[b].emplace_back(a, coupling);
  }
  Laplacian matrix;
  matrix.offsets.push_back(0);
  for (const auto& row : entries) {
    for (const auto& [column, coupling] : row) {
      matrix.columns.push_back(column);
      matrix.coupling.push_back(coupling);
    }
    matrix.offsets.push_back(matrix.columns.size());
  }
  return matrix;
}

/// A square of side * side rows, each coupled to those beside it by what coupling(x, y) says.
template <class Coupling>
Laplacian square(std::uint32_t side, const Coupling& coupling) {
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const auto x = i % side, y = i / side;
    if (x + 1 < side) edges.push_back({i, i + 1, coupling(x, y)});
    if (y + 1 < side) edges.push_back({i, i + side, coupling(x, y)});
  }
  return matrixOf(side * side, edges);
}
Laplacian evenSquare(std::uint32_t side) {
  return square(side, [](std::uint32_t, std::uint32_t) { return 1.0; });
}

std::vector<double> product(const Laplacian& matrix, const std::vector<double>& x) {
  std::vector<double> image(matrix.rows());
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!matrix.extra.empty()) image[i] = matrix.extra[i] * x[i];
    for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
      image[i] += matrix.coupling[k] * (x[i] - x[matrix.columns[k]]);
    }
  }
  return image;
}

double norm(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

std::vector<double> withoutMean(std::vector<double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  for (auto& value : values) value -= sum / static_cast<double>(values.size());
  return values;
}

double difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return norm(a);
}

struct Solved {
  LinearSolution solution;
  std::vector<double> x;
};

/// Solves, and holds the solution to what it says of itself. b has no part that cannot be reached.
Solved solved(const Laplacian& matrix, const std::vector<double>& b, double tolerance, int threads = 1) {
  Solved solved;
  const auto solution = LaplacianSolver(threads).solve(matrix, b, tolerance, solved.x);
  EXPECT_TRUE(solution);
  solved.solution = solution.value_or(LinearSolution{});
  const double residual = difference(product(matrix, solved.x), b) / norm(b);
  EXPECT_NEAR(residual, solved.solution.residual, 1e-3 * residual + 1e-14);
  return solved;
}

/// The matrix of cells of sites in the unit square, and what their areas lack of equal ones.
std::pair<Laplacian, std::vector<double>> ofCells(Pattern pattern, std::uint64_t count, double weights) {
  constexpr Box box{0, 0, 1, 1};
  Sites sites = generate(pattern, count, 1);
  sites = inOrder(sites, memoryOrder(sites, box));
  const double mean = 1 / static_cast<double>(count);
  if (weights > 0) {
    sites.weight = Numbers().several(count);
    for (auto& weight : sites.weight) weight *= weights * mean;
  }
  Session session = test::cpuSession();
  CellsOptions options{};
  options.domain = box;
  MovingCells cells(session, options);
  EXPECT_TRUE(cells.update(sites));
  Laplacian matrix;
  std::vector<double> lacking(count);
  matrix.offsets.push_back(0);
  for (std::size_t i = 0; i < count; ++i) {
    for (auto k = cells.neighbors().offsets[i]; k < cells.neighbors().offsets[i + 1]; ++k) {
      if (cells.neighbors().neighbors[k] < 0) continue;
      matrix.columns.push_back(static_cast<std::uint32_t>(cells.neighbors().neighbors[k]));
      matrix.coupling.push_back(cells.edges().coupling[k]);
    }
    matrix.offsets.push_back(matrix.columns.size());
    // A site that weights hide is a part by itself, where nothing can be reached.
    const bool alone = matrix.offsets[i] == matrix.offsets[i + 1];
    lacking[i] = alone ? 0 : mean - cells.moments().mass[i];
  }
  double sum = 0;
  for (const double value : lacking) sum += value;
  lacking[0] -= sum;
  return {matrix, lacking};
}

TEST(LaplacianSolver, FindsWhatEliminationFinds) {
  Numbers numbers;
  constexpr std::size_t rows = 30;
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      if (numbers.next() < 0.2) edges.push_back({i, j, numbers.next()});
    }
  }
  // Couplings of one pair are added up.
  edges.push_back(edges.front());
  Laplacian matrix = matrixOf(rows, edges);
  matrix.extra = numbers.several(rows);
  const auto b = numbers.several(rows);
  std::vector<std::vector<double>> dense;
  for (std::size_t i = 0; i < rows; ++i) {
    std::vector<double> unit(rows);
    unit[i] = 1;
    dense.push_back(product(matrix, unit));
    dense.back().push_back(b[i]);
  }
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      const double factor = dense[j][i] / dense[i][i];
      for (std::size_t k = i; j != i && k <= rows; ++k) dense[j][k] -= factor * dense[i][k];
    }
  }
  std::vector<double> expected(rows);
  for (std::size_t i = 0; i < rows; ++i) expected[i] = dense[i][rows] / dense[i][i];
  EXPECT_LT(difference(solved(matrix, b, 1e-12).x, expected), 1e-12 * norm(expected));
}

TEST(LaplacianSolver, SolvesForCells) {
  for (const auto& [pattern, weights] : {std::tuple(Pattern::random, 0.0),
                                         {Pattern::clusters, 0.0},
                                         {Pattern::random, 0.5},
                                         {Pattern::square, 0.0}}) {
    for (const std::uint64_t side : {few, many}) {
      const auto [matrix, b] = ofCells(pattern, side * side, weights);
      for (const double tolerance : {1e-3, 1e-10}) {
        const auto [solution, x] = solved(matrix, b, tolerance);
        EXPECT_LE(solution.residual, tolerance);
        EXPECT_LE(solution.iterations, side == few ? 0 : tolerance > 1e-4 ? 12 : 35);
        EXPECT_GE(solution.iterations, side == few ? 0 : 1);
      }
    }
  }
}

TEST(LaplacianSolver, ThreadsChangeNothing) {
  const auto matrix = evenSquare(very_many);
  const auto b = withoutMean(Numbers().several(matrix.rows()));
  const auto alone = solved(matrix, b, 1e-8);
  EXPECT_LE(alone.solution.residual, 1e-8);
  for (const int threads : {2, 5}) EXPECT_EQ(solved(matrix, b, 1e-8, threads).x, alone.x) << threads;
}

TEST(LaplacianSolver, EarlierSystemsChangeNothing) {
  Numbers numbers;
  LaplacianSolver solver(1);
  for (int round = 0; round < 2; ++round) {
    for (const std::uint32_t side : {many, few, very_many, few + 1}) {
      auto matrix = evenSquare(side);
      if (round == 0) matrix.coupling.assign(matrix.coupling.size(), 3);
      const auto b = withoutMean(Numbers().several(matrix.rows()));
      std::vector<double> x;
      ASSERT_TRUE(solver.solve(matrix, b, 1e-6, x));
      EXPECT_EQ(x, solved(matrix, b, 1e-6).x);
    }
  }
}

TEST(LaplacianSolver, PartsHaveTheMeanZero) {
  for (const std::uint32_t side : {few, many}) {
    // Columns 0 to 9 are one part, those from 10 on another. Two rows are alone, one of them with an extra.
    auto matrix = evenSquare(side);
    const auto alone = side * side - 1, drop = side * side - 3;
    for (std::uint32_t i = 0; i < matrix.rows(); ++i) {
      for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
        const auto j = matrix.columns[k];
        const bool apart = (i % side < 10) != (j % side < 10);
        if (apart || std::max(i, j) == alone || i == drop || j == drop) matrix.coupling[k] = 0;
      }
    }
    matrix.extra.assign(matrix.rows(), 0);
    matrix.extra[drop] = 2;
    auto b = Numbers().several(matrix.rows());
    std::vector<double> x;
    const auto solution = LaplacianSolver(1).solve(matrix, b, 1e-10, x);
    ASSERT_TRUE(solution);
    EXPECT_LE(solution->residual, 1e-10);
    EXPECT_EQ(x[alone], 0);
    EXPECT_NEAR(x[drop], b[drop] / 2, 1e-8);
    const auto image = product(matrix, x);
    for (const bool left : {true, false}) {
      double sum_b = 0, sum_x = 0, rows = 0;
      const auto ofPart = [&](const auto& each) {
        for (std::uint32_t i = 0; i < matrix.rows(); ++i) {
          if (i != alone && i != drop && (i % side < 10) == left) each(i);
        }
      };
      ofPart([&](std::uint32_t i) { sum_b += b[i], sum_x += x[i], ++rows; });
      EXPECT_NEAR(sum_x, 0, 1e-9);
      double worst = 0;
      ofPart([&](std::uint32_t i) { worst = std::max(worst, std::abs(b[i] - sum_b / rows - image[i])); });
      EXPECT_LT(worst, 1e-7);
    }
  }
}

TEST(LaplacianSolver, ScalesMayBeFarApart) {
  for (const std::uint32_t side : {few, many}) {
    Numbers numbers;
    const auto atRandom = [&](std::uint32_t, std::uint32_t) { return std::pow(10, -12 * numbers.next()); };
    const auto fading = [&](std::uint32_t x, std::uint32_t) { return std::pow(10, -12.0 * x / side); };
    const auto blocks = [](std::uint32_t x, std::uint32_t y) { return (x / 9 + y / 9) % 2 ? 1e150 : 1e138; };
    for (const auto& matrix : {square(side, atRandom), square(side, fading), square(side, blocks)}) {
      const auto x = withoutMean(numbers.several(matrix.rows()));
      const auto found = solved(matrix, product(matrix, x), 1e-10);
      EXPECT_LE(found.solution.residual, 1e-10);
      EXPECT_LE(found.solution.iterations, 80u);
    }
  }
}

TEST(LaplacianSolver, ExtrasMakeItDefinite) {
  for (const std::uint32_t side : {few, many}) {
    Numbers numbers;
    auto matrix = evenSquare(side);
    for (std::size_t i = 0; i < matrix.rows(); ++i)
      matrix.extra.push_back(std::pow(10, 8 * numbers.next() - 4));
    const auto x = numbers.several(matrix.rows());
    const auto found = solved(matrix, product(matrix, x), 1e-12);
    EXPECT_LT(difference(found.x, x), 1e-9 * norm(x));
    // One extra, however small, says where x is.
    matrix.extra.assign(matrix.rows(), 0);
    matrix.extra[5] = 1e-3;
    EXPECT_LT(difference(solved(matrix, product(matrix, x), 1e-13).x, x), 1e-3 * norm(x));
  }
}

TEST(LaplacianSolver, RowsMayHaveVeryManyCouplings) {
  for (const std::uint32_t side : {few, many}) {
    std::vector<Edge> edges;
    for (std::uint32_t i = 1; i < side * side; ++i) edges.push_back({0, i, 1});
    for (std::uint32_t i = 2; i < side * side; ++i) edges.push_back({i - 1, i, 1});
    const auto matrix = matrixOf(side * side, edges);
    const auto x = withoutMean(Numbers().several(matrix.rows()));
    EXPECT_LT(difference(solved(matrix, product(matrix, x), 1e-12).x, x), 1e-9 * norm(x));
  }
}

TEST(LaplacianSolver, EndsWhereRoundingDoes) {
  for (const std::uint32_t side : {few, many}) {
    const auto matrix = evenSquare(side);
    const auto b = withoutMean(Numbers().several(matrix.rows()));
    const auto found = solved(matrix, b, 0);
    EXPECT_GT(found.solution.residual, 0);
    EXPECT_LE(found.solution.residual, 1e-12);
  }
}

TEST(LaplacianSolver, NothingLeavesNothing) {
  for (const std::uint32_t side : {few, many}) {
    const auto matrix = evenSquare(side);
    std::vector<double> x;
    // A constant is what no x leads to.
    for (const double constant : {0.0, 3.0}) {
      const auto solution =
          LaplacianSolver(1).solve(matrix, std::vector<double>(matrix.rows(), constant), 1e-8, x);
      ASSERT_TRUE(solution);
      EXPECT_EQ(solution->residual, 0);
      EXPECT_EQ(x, std::vector<double>(matrix.rows(), 0));
    }
    auto drops = matrixOf(matrix.rows(), {});
    drops.extra.assign(matrix.rows(), 4);
    EXPECT_EQ(solved(drops, std::vector<double>(matrix.rows(), 1), 1e-15).x[7], 0.25);
  }
  std::vector<double> x{1};
  EXPECT_TRUE(LaplacianSolver(1).solve({{0}, {}, {}, {}}, {}, 1e-8, x));
  EXPECT_TRUE(x.empty());
}

}  // namespace
}  // namespace vorpipe::moving
