/// The measured arithmetic of a device is the one that it computes with.
#include "session/arithmetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "backend/registry/registry.h"
#include "unit/fixtures/changed_cpu.h"

namespace vorpipe::test {

using namespace core;

namespace {

/// Computes as the host does, but each result is passed through `change`.
class InexactDevice final : public ChangedCpu {
 public:
  using Change = std::function<void(const Operands&, Computed&)>;
  explicit InexactDevice(Change change) : ChangedCpu(1), change_(std::move(change)) {}

  Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) override {
    auto done = ChangedCpu::compute(operands, out);
    for (std::size_t i = 0; i < operands.size(); ++i) change_(operands[i], out[i]);
    return done;
  }

 private:
  Change change_;
};

Arithmetic measured(const InexactDevice::Change& change) {
  InexactDevice backend(change);
  const auto result = measureArithmetic(backend);
  EXPECT_TRUE(result) << result.error().message;
  return result.value_or(Arithmetic{});
}

/// `exact`, moved away from zero by `ulp` units in the last place.
float off(float exact, int ulp) {
  for (int i = 0; i < ulp; ++i) exact = std::nextafter(exact, std::copysign(HUGE_VALF, exact));
  return exact;
}

TEST(Arithmetic, OfTheHostIsRoundedExactly) {
  const auto numbers = measured([](const Operands&, Computed&) {});
  for (const double error : {numbers.quotient, numbers.root, numbers.product, numbers.sum, numbers.offset}) {
    EXPECT_GT(error, 0.4);
    EXPECT_LE(error, 0.5);
  }
  EXPECT_LE(numbers.inverse_root, 1.5);
  EXPECT_FALSE(numbers.fuses);
  EXPECT_FALSE(numbers.fuses_precise);
  EXPECT_TRUE(numbers.keeps_denormals);
  EXPECT_FALSE(numbers.subpixel_bits.has_value());
}

TEST(Arithmetic, FindsEachOperationThatIsOff) {
  struct Case {
    float Computed::*result;
    double Arithmetic::*error;
  };
  for (const auto& [result, error] :
       {Case{&Computed::quotient, &Arithmetic::quotient}, Case{&Computed::root, &Arithmetic::root},
        Case{&Computed::inverse_root, &Arithmetic::inverse_root},
        Case{&Computed::product, &Arithmetic::product}, Case{&Computed::sum, &Arithmetic::sum},
        Case{&Computed::offset, &Arithmetic::offset}}) {
    const auto numbers =
        measured([&](const Operands&, Computed& found) { found.*result = off(found.*result, 3); });
    EXPECT_GE(numbers.*error, 2.9);
    EXPECT_LE(numbers.*error, 5);
    const auto broken = measured(
        [&](const Operands&, Computed& found) { found.*result = std::numeric_limits<float>::quiet_NaN(); });
    EXPECT_EQ(broken.*error, HUGE_VAL);
  }
}

TEST(Arithmetic, FindsDifferencesThatAreRearranged) {
  const auto numbers =
      measured([](const Operands& n, Computed& found) { found.offset = (n.a + n.c) - (n.b + n.d); });
  EXPECT_GT(numbers.offset, 1);
}

TEST(Arithmetic, FindsFusedProducts) {
  const auto where_allowed =
      measured([](const Operands& n, Computed& found) { found.product_sum = std::fma(n.a, n.b, n.c); });
  EXPECT_TRUE(where_allowed.fuses);
  EXPECT_FALSE(where_allowed.fuses_precise);
  const auto everywhere =
      measured([](const Operands& n, Computed& found) { found.rounded_twice = std::fma(n.a, n.b, n.c); });
  EXPECT_TRUE(everywhere.fuses_precise);
}

TEST(Arithmetic, FindsFlushedNumbers) {
  const auto flushed = [](float number) {
    return std::abs(number) < std::numeric_limits<float>::min() ? 0.0F : number;
  };
  EXPECT_FALSE(measured([&](const Operands&, Computed& found) {
                 found.product = flushed(found.product);
               }).keeps_denormals);
  EXPECT_FALSE(
      measured([&](const Operands&, Computed& found) { found.sum = flushed(found.sum); }).keeps_denormals);
}

TEST(Arithmetic, SaysWhatFailed) {
  class FailingDevice final : public ChangedCpu {
   public:
    FailingDevice() : ChangedCpu(1) {}
    Result<void> compute(std::span<const Operands>, std::span<Computed>) override {
      return tl::unexpected(Error{ErrorCode::device, "it is gone"});
    }
  } failing;
  const auto result = measureArithmetic(failing);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "it is gone");
}

/// Draws the shapes of measureSubpixelBits, as a rasterizer that snaps vertices to a grid.
class CoarseRasterizer final : public ChangedCpu {
 public:
  CoarseRasterizer(double step, double outset) : ChangedCpu(1), step_(step), outset_(outset) {
    info_ = ChangedCpu::info();
    info_.has_vertices = true;
  }

  BackendInfo& limits() { return info_; }
  const BackendInfo& info() const override { return info_; }
  Result<void> begin(const View& view) override {
    side_ = view.width;
    ids_.assign(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height), no_site);
    return {};
  }
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity,
                    std::span<CellStatus> status) override {
    for (std::size_t e = 0; e < batch.entries.size(); ++e) {
      const auto& entry = batch.entries[e];
      const auto& line = batch.lines[entry.first];
      const double x = 0.5 * side_ * (marks[e].x + 1), y = 0.5 * side_ * (marks[e].y + 1);
      const auto edge_at = [&](double height) {
        return snapped(x + (line.h - line.ny * height) / line.nx - outset_);
      };
      const double low = edge_at(entry.south), high = edge_at(entry.north), right = x + entry.east;
      for (int row = 0; row < side_; ++row) {
        const double part = (row + 0.5 - (y + entry.south)) / (entry.north - entry.south);
        const double left = low + part * (high - low);
        for (int column = static_cast<int>(x) - 2; column < x + 2; ++column) {
          if (column + 0.5 < left || column + 0.5 > right) continue;
          ids_[static_cast<std::size_t>(row * side_ + column)] = marks[e].id;
        }
      }
      status[e] = CellStatus::certified;
    }
    return {};
  }
  Result<void> read(std::span<std::uint32_t>, std::span<std::uint32_t> ids) override {
    std::ranges::copy(ids_, ids.begin());
    return {};
  }

 private:
  [[nodiscard]] double snapped(double x) const { return step_ > 0 ? std::round(x / step_) * step_ : x; }

  double step_, outset_;
  BackendInfo info_;
  int side_ = 0;
  std::vector<std::uint32_t> ids_;
};

TEST(SubpixelGrid, IsAsFineAsItIs) {
  for (const int bits : {3, 4, 5, 6, 8, 9}) {
    const double step = std::ldexp(1.0, -bits);
    for (const double outset : {0.0, std::min(step / 2, 1.0 / 32), 0.0317}) {
      CoarseRasterizer device(step, outset);
      EXPECT_EQ(*measureSubpixelBits(device), bits) << outset;
    }
  }
  CoarseRasterizer without_grid(0, 0);
  EXPECT_EQ(*measureSubpixelBits(without_grid), most_subpixel_bits);
}

TEST(SubpixelGrid, IsNotKnownOfViewsThatAreTooSmall) {
  CoarseRasterizer device(1.0 / 256, 0);
  device.limits().max_view = 100;
  const auto bits = measureSubpixelBits(device);
  ASSERT_TRUE(bits);
  EXPECT_FALSE(bits->has_value());
}

TEST(SubpixelGrid, MakesNoSenseWhereNothingIsDrawn) {
  class Empty final : public ChangedCpu {
   public:
    Empty() : ChangedCpu(1) {}
    Result<void> draw(const CellBatch<float>&, std::span<const DrawMark>, Capacity,
                      std::span<CellStatus>) override {
      return {};
    }
    Result<void> read(std::span<std::uint32_t>, std::span<std::uint32_t> ids) override {
      std::ranges::fill(ids, no_site);
      return {};
    }
  } device;
  EXPECT_EQ(*measureSubpixelBits(device), 0);
}

}  // namespace
}  // namespace vorpipe::test
