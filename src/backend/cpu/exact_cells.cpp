#include "backend/cpu/exact_cells.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "backend/collect.h"
#include "backend/cpu/double_double.h"
#include "backend/cpu/tree_cells.h"

namespace vorpipe::cpu {

namespace multiprecision = boost::multiprecision;

/// With exponents that hold products of any doubles.
template <unsigned Bits>
using LongReal =
    multiprecision::number<multiprecision::cpp_bin_float<Bits, multiprecision::digit_base_2, void,
                                                         std::int32_t, -(1 << 20), (1 << 20)>,
                           multiprecision::et_off>;

template <unsigned Bits>
struct Number<LongReal<Bits>> {
  using Real = LongReal<Bits>;
  static Real power(int exponent) { return ldexp(Real(1.0), exponent); }
  static const Real& rounding() {
    static const Real value = power(-static_cast<int>(Bits));
    return value;
  }
  static const Real& far() {
    static const Real value = power(1 << 15);
    return value;
  }
  static const Real& nowhere() {
    static const Real value = power(-(1 << 17));
    return value;
  }
  static const Real& same() {
    static const Real value = power(-(1 << 16));
    return value;
  }
};

namespace {

/// Tries numbers of more and more bits.
class ExactFinder {
 public:
  ExactFinder(const SiteSet& sites, const SiteTree& tree) : sites_(sites), tree_(tree) {}

  CellStatus find(std::uint32_t site, std::vector<std::int32_t>& neighbors) {
    auto status = findWith(short_, site, neighbors, false);
    if (status == CellStatus::open) status = findWith(long_, site, neighbors, false);
    if (status == CellStatus::open) status = findWith(longest_, site, neighbors, true);
    return status;
  }

 private:
  template <class Real>
  using Made = std::unique_ptr<CellFinder<Real>>;

  template <class Real>
  CellStatus findWith(Made<Real>& finder, std::uint32_t site, std::vector<std::int32_t>& neighbors,
                      bool decide) {
    if (!finder) finder = std::make_unique<CellFinder<Real>>(sites_, tree_);
    return finder->find(site, neighbors, decide);
  }

  const SiteSet& sites_;
  const SiteTree& tree_;
  Made<DoubleDouble> short_;
  Made<LongReal<320>> long_;
  Made<LongReal<1280>> longest_;
};

}  // namespace

void findExactly(const SiteSet& sites, const SiteTree& tree, std::span<const std::uint32_t> which,
                 int threads, CellNeighbors& out) {
  collect(which.size(), threads, out, [&] {
    return [&, finder = std::make_unique<ExactFinder>(sites, tree)](std::size_t e,
                                                                    std::vector<std::int32_t>& neighbors) {
      return finder->find(which[e], neighbors);
    };
  });
}

}  // namespace vorpipe::cpu
