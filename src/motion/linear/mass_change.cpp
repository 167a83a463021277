#include "motion/linear/mass_change.h"

#include <numeric>

#include "base/block_sums.h"
#include "motion/linear/conjugate_gradients.h"

namespace vorpipe::moving {
namespace {

/// Calls each(k) for the entries of a cell's neighbors, except walls and images of its own site.
template <class Each>
void forOthers(const CellsThatMeet& meet, std::size_t i, const Each& each) {
  for (auto k = meet.offsets[i]; k < meet.offsets[i + 1]; ++k) {
    if (!isWall(meet.neighbors[k]) && static_cast<std::size_t>(meet.neighbors[k]) != i) each(k);
  }
}

/// Sets the start offset of each row; row i has an entry for each call that forRow(i, each) makes.
template <class ForRow>
void setOffsets(std::size_t rows, int threads, const ForRow& forRow, std::vector<std::uint64_t>& offsets) {
  offsets.resize(rows + 1);
  offsets[0] = 0;
  forAll(rows, threads, [&](std::size_t i) {
    std::uint64_t entries = 0;
    forRow(i, [&](std::uint64_t) { ++entries; });
    offsets[i + 1] = entries;
  });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
}

}  // namespace

void massMatrix(const CellsThatMeet& meet, const EdgesOfCells& edges, int threads, Laplacian& matrix) {
  const std::size_t rows = meet.offsets.size() - 1;
  const auto forRow = [&](std::size_t i, const auto& each) { forOthers(meet, i, each); };
  setOffsets(rows, threads, forRow, matrix.offsets);
  matrix.columns.resize(matrix.offsets[rows]);
  matrix.coupling.resize(matrix.offsets[rows]);
  forAll(rows, threads, [&](std::size_t i) {
    auto out = matrix.offsets[i];
    forRow(i, [&](std::uint64_t k) {
      matrix.columns[out] = static_cast<std::uint32_t>(meet.neighbors[k]);
      matrix.coupling[out++] = edges.coupling[k];
    });
  });
  matrix.extra.resize(edges.arc.size());
  forAll(edges.arc.size(), threads, [&](std::size_t i) { matrix.extra[i] = edges.arc[i] / 2; });
}

MassChange::MassChange(const MovingCells& cells, const Sites& sites, const Box& domain, int threads)
    : threads_(threads) {
  const CellsThatMeet& meet = cells.neighbors();
  const EdgesOfCells& edges = cells.edges();
  const std::size_t count = sites.size();
  const auto forCell = [&](std::size_t i, const auto& each) {
    forOthers(meet, i, [&](std::uint64_t k) {
      if (edges.coupling[k] > 0) each(k);
    });
  };
  setOffsets(count, threads, forCell, offsets_);
  entries_.resize(offsets_[count]);
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  forAll(count, threads, [&](std::size_t i) {
    auto out = offsets_[i];
    forCell(i, [&](std::uint64_t k) {
      const auto j = static_cast<std::uint32_t>(meet.neighbors[k]);
      Point other{sites.x[j], sites.y[j]};
      if (!meet.shifts.empty()) {
        other.x += meet.shifts[k][0] * width;
        other.y += meet.shifts[k][1] * height;
      }
      const double c = 2 * edges.coupling[k];
      const Point b = edges.middle[k];
      entries_[out++] = {
          j, {c * (other.x - b.x), c * (other.y - b.y)}, {c * (sites.x[i] - b.x), c * (sites.y[i] - b.y)}};
    });
  });
}

void MassChange::apply(std::span<const Point> velocity, std::vector<double>& change) const {
  change.resize(velocity.size());
  forAll(velocity.size(), threads_, [&](std::size_t i) {
    double sum = 0;
    const Point own = velocity[i];
    for (auto k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const Entry& e = entries_[k];
      const Point other = velocity[e.other];
      sum += e.from_other.x * other.x + e.from_other.y * other.y;
      sum -= e.from_own.x * own.x + e.from_own.y * own.y;
    }
    change[i] = sum;
  });
}

void MassChange::push(std::span<const double> pressure, std::span<const double> inertia,
                      std::vector<Point>& result) const {
  result.resize(pressure.size());
  forAll(pressure.size(), threads_, [&](std::size_t i) {
    Point sum{0, 0};
    for (auto k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const Entry& e = entries_[k];
      const double rise = pressure[e.other] - pressure[i];
      sum.x += e.from_own.x * rise;
      sum.y += e.from_own.y * rise;
    }
    result[i] = {sum.x / inertia[i], sum.y / inertia[i]};
  });
}

std::vector<double> MassChange::diagonal(std::span<const double> inertia) const {
  std::vector<double> diagonal(inertia.size());
  forAll(inertia.size(), threads_, [&](std::size_t i) {
    Point own{0, 0};
    double sum = 0;
    for (auto k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const Entry& e = entries_[k];
      sum += (e.from_other.x * e.from_other.x + e.from_other.y * e.from_other.y) / inertia[e.other];
      own.x += e.from_own.x;
      own.y += e.from_own.y;
    }
    diagonal[i] = sum + (own.x * own.x + own.y * own.y) / inertia[i];
  });
  return diagonal;
}

std::uint64_t solvePressure(const MassChange& change, std::span<const double> inertia,
                            std::span<const double> wanted, double least, int threads,
                            std::vector<double>& pressure, const std::function<bool()>& continues) {
  const std::size_t count = inertia.size();
  if (pressure.size() != count) pressure.assign(count, 0.0);
  const std::vector<double> diagonal = change.diagonal(inertia);
  std::vector<double> rest(wanted.begin(), wanted.end()), answer;
  std::vector<Point> pushed;
  const auto multiply = [&](const std::vector<double>& way, std::vector<double>& image) {
    change.push(way, inertia, pushed);
    change.apply(pushed, image);
  };
  multiply(pressure, answer);
  forAll(count, threads, [&](std::size_t i) { rest[i] -= answer[i]; });
  const auto scale = [&](double value, std::size_t i) { return diagonal[i] > 0 ? value / diagonal[i] : 0; };
  return conjugateGradients(pressure, rest, least, threads, multiply, scale, continues);
}

}  // namespace vorpipe::moving
