#include "geometry/curve_order.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "base/big_vector.h"
#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t curve_order_most = std::size_t{1} << 15;

/// A position on Hilbert's curve, and the site there.
struct OnCurve {
  std::uint64_t key;
  std::uint32_t site;
};

/// Hilbert's curve through a square of 2^32 by 2^32, four levels at a time: a table maps the curve's
/// direction in a square, and four digits of column and row, to its next eight digits and next direction.
class Curve {
 public:
  Curve() {
    for (std::uint32_t way = 0; way < 4; ++way) {
      for (std::uint32_t place = 0; place < 256; ++place) steps_[way][place] = stepsOf(way, place);
    }
  }

  [[nodiscard]] std::uint64_t keyOf(std::uint32_t column, std::uint32_t row) const {
    std::uint64_t key = 0;
    std::uint32_t way = 0;
    for (int digit = 28; digit >= 0; digit -= 4) {
      const auto& steps = steps_[way][((column >> digit) & 15) << 4 | ((row >> digit) & 15)];
      key = key << 8 | steps.digits;
      way = steps.way;
    }
    return key;
  }

 private:
  struct Steps {
    std::uint8_t digits, way;
  };
  struct Quarter {
    std::uint32_t column, row, way;
  };

  static Steps stepsOf(std::uint32_t way, std::uint32_t place) {
    static constexpr std::array<std::array<Quarter, 4>, 4> quarters{{
        {{{0, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 2}}},
        {{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 3}}},
        {{{1, 1, 3}, {0, 1, 2}, {0, 0, 2}, {1, 0, 0}}},
        {{{1, 1, 2}, {1, 0, 3}, {0, 0, 3}, {0, 1, 1}}},
    }};
    std::uint32_t digits = 0;
    for (int bit = 3; bit >= 0; --bit) {
      const auto column = (place >> (4 + bit)) & 1, row = (place >> bit) & 1;
      const auto& ways = quarters[way];
      const auto q = std::ranges::find_if(
          ways, [&](const Quarter& quarter) { return quarter.column == column && quarter.row == row; });
      digits = digits << 2 | static_cast<std::uint32_t>(q - ways.begin());
      way = q->way;
    }
    return {static_cast<std::uint8_t>(digits), static_cast<std::uint8_t>(way)};
  }

  std::array<std::array<Steps, 256>, 4> steps_{};
};

/// Around sites; indexOf(element) is the index of each.
template <class Elements, class IndexOf>
Box boxAround(const SiteSet& sites, const Elements& elements, const IndexOf& indexOf) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Box box{infinite, infinite, -infinite, -infinite};
  for (const auto& element : elements) {
    const std::uint32_t i = indexOf(element);
    box = {std::min(box.xmin, sites.x[i]), std::min(box.ymin, sites.y[i]), std::max(box.xmax, sites.x[i]),
           std::max(box.ymax, sites.y[i])};
  }
  return box;
}

/// Puts sites on the curve over a box.
void place(const SiteSet& sites, const Box& box, std::span<OnCurve> placed) {
  static const Curve curve;
  const double side = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
  const double scale = side > 0 ? 0x1.fffffffp31 / side : 0;
  for (auto& [key, i] : placed) {
    key = curve.keyOf(static_cast<std::uint32_t>((sites.x[i] - box.xmin) * scale),
                      static_cast<std::uint32_t>((sites.y[i] - box.ymin) * scale));
  }
}

/// Sorts by key and site; sorts sites that share a key along a curve of their own.
void sortFew(const SiteSet& sites, std::span<OnCurve> placed) {
  std::ranges::sort(placed, [](const OnCurve& a, const OnCurve& b) {
    return a.key != b.key ? a.key < b.key : a.site < b.site;
  });
  constexpr std::size_t already_near = 8;
  if (placed.size() <= already_near || placed.front().key != placed.back().key) {
    for (std::size_t i = 0; i < placed.size();) {
      auto j = i + 1;
      while (j < placed.size() && placed[j].key == placed[i].key) ++j;
      if (j - i > already_near) sortFew(sites, placed.subspan(i, j - i));
      i = j;
    }
    return;
  }
  const Box box = boxAround(sites, placed, [](const OnCurve& p) { return p.site; });
  place(sites, box, placed);
  if (!(box.xmax > box.xmin || box.ymax > box.ymin)) return;
  sortFew(sites, placed);
}

/// Sorts by the first digits of keys, stably: the last of these digits first, eleven bits at a time.
class RadixSort {
 public:
  static constexpr int passes = 3, bits = 11, low = 64 - passes * bits;

  RadixSort(BigVector<OnCurve>& placed, int threads)
      : placed_(placed),
        other_(placed.size()),
        blocks_(std::clamp<std::size_t>(placed.size() / curve_order_most, 1,
                                        static_cast<std::size_t>(threadCount(threads)))),
        size_((placed.size() + blocks_ - 1) / blocks_),
        count_(blocks_),
        threads_(threads) {}

  void run() {
    for (int pass = 0; pass < passes; ++pass) sortBy(low + bits * pass);
  }

 private:
  static constexpr std::size_t values = std::size_t{1} << bits;

  template <class Work>
  void forBlocks(const Work& work) {
    parallelFor(placed_.size(), size_, threads_,
                [&](std::size_t begin, std::size_t end) { work(begin / size_, begin, end); });
  }

  void sortBy(int shift) {
    const auto digit = [shift](const OnCurve& p) { return (p.key >> shift) & (values - 1); };
    forBlocks([&](std::size_t block, std::size_t begin, std::size_t end) {
      count_[block].assign(values, 0);
      for (auto k = begin; k < end; ++k) ++count_[block][digit(placed_[k])];
    });
    std::size_t first = 0;
    for (std::size_t value = 0; value < values; ++value) {
      for (auto& count : count_) first += std::exchange(count[value], first);
    }
    forBlocks([&](std::size_t block, std::size_t begin, std::size_t end) {
      auto& next = count_[block];
      for (auto k = begin; k < end; ++k) other_[next[digit(placed_[k])]++] = placed_[k];
    });
    std::swap(placed_, other_);
  }

  BigVector<OnCurve>& placed_;
  BigVector<OnCurve> other_;
  std::size_t blocks_, size_;
  std::vector<std::vector<std::size_t>> count_;  ///< by block and value of the digit
  int threads_;
};

}  // namespace

void sortAlongCurve(const SiteSet& sites, std::vector<std::uint32_t>& which, int threads) {
  if (which.empty()) return;
  BigVector<OnCurve> placed(which.size());
  const Box box = boxAround(sites, which, [](std::uint32_t i) { return i; });
  const auto grain = grainFor(placed.size(), curve_order_most);
  threads = threadsForSteps(placed.size(), threads);
  parallelFor(placed.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) placed[k] = {0, which[k]};
    place(sites, box, std::span(placed).subspan(begin, end - begin));
  });
  RadixSort(placed, threads).run();
  // Ranges end where the sorted digits do: what shares these is sorted by one thread.
  const auto endsAt = [&](std::size_t k) {
    return k == placed.size() || placed[k - 1].key >> RadixSort::low != placed[k].key >> RadixSort::low;
  };
  std::vector<std::size_t> bounds{0};
  while (bounds.back() < placed.size()) {
    auto end = std::min(bounds.back() + grain, placed.size());
    while (!endsAt(end)) ++end;
    bounds.push_back(end);
  }
  parallelFor(bounds.size() - 1, 1, threads, [&](std::size_t range, std::size_t) {
    const auto end = bounds[range + 1];
    for (auto i = bounds[range]; i < end;) {
      auto j = i + 1;
      while (j < end && !endsAt(j)) ++j;
      if (j - i > 1) sortFew(sites, std::span(placed).subspan(i, j - i));
      i = j;
    }
    for (auto k = bounds[range]; k < end; ++k) which[k] = placed[k].site;
  });
}

}  // namespace vorpipe::core
