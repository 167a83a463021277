#include "session/arithmetic.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "base/try.h"

namespace vorpipe::core {
namespace {

/// Pixels along a side of the view, pixels from one shape to the next, and shapes in a view.
constexpr int side = 512, pitch = 4, shapes = side / pitch;
/// Number of pixels by which an edge leans to the right from the bottom of the view to the top, 1/1024 per
/// row.
constexpr float lean = 0.5F;
/// Number of pixels by which the edge moves to the right from one shape to the next.
constexpr float shift = lean / side;
/// Number of views of shapes, through which the edge moves by 1/4 pixel each.
constexpr int grid_rounds = 2;

/// Returns the shapes from number `first` on, side by side, about 2 pixels wide and as high as the view. The
/// left side of each is a leaning edge. It passes the pixel centers of the shape's second column near the
/// middle of the view, lower for larger numbers.
CellBatch<float> shapesFrom(int first) {
  CellBatch<float> batch;
  const float slope = lean / side;
  const float length = std::sqrt(1.0F + slope * slope);
  for (int k = 0; k < shapes; k++) {
    const float at = -0.5F + shift * (static_cast<float>(first + k) - 0.5F * shapes * grid_rounds);
    batch.entries.push_back({static_cast<std::uint32_t>(k), 1, -1.75F, -0.5F * side, 1.25F, 0.5F * side,
                             /*reach=*/1e30F, /*shift=*/0});
    batch.lines.push_back({-1.0F / length, slope / length, -at / length, 0});
  }
  return batch;
}

std::vector<DrawMark> marksOf() {
  std::vector<DrawMark> marks;
  for (int k = 0; k < shapes; k++) {
    const float x = (static_cast<float>(pitch * k) + 2.0F) / (0.5F * side) - 1.0F;
    marks.push_back({x, 0, static_cast<std::uint32_t>(k), 0});
  }
  return marks;
}

/// Draws the shapes from number `first` on. Appends to `heights` the number of pixels that each covers in its
/// second column.
Result<void> drawShapes(Backend& backend, int first, std::vector<int>& heights) {
  const View view{{0, 0, side, side}, side, side, {}};
  VORPIPE_TRY(backend.begin(view));
  std::vector<CellStatus> status(shapes);
  VORPIPE_TRY(backend.draw(shapesFrom(first), marksOf(), Capacity::small, status));
  std::vector<std::uint32_t> rgba(std::size_t{side} * side), ids(rgba.size());
  VORPIPE_TRY(backend.read(rgba, ids));
  for (int k = 0; k < shapes; k++) {
    int height = 0;
    for (int row = 0; row < side; row++) {
      const auto pixel = static_cast<std::size_t>(row) * side + static_cast<std::size_t>(pitch * k + 1);
      height += ids[pixel] == static_cast<std::uint32_t>(k) ? 1 : 0;
    }
    heights.push_back(height);
  }
  return {};
}

}  // namespace

Result<std::optional<int>> measureSubpixelBits(Backend& backend) {
  if (backend.info().max_view < side) return std::nullopt;
  std::vector<int> heights;
  for (int round = 0; round < grid_rounds; round++) {
    VORPIPE_TRY(drawShapes(backend, round * shapes, heights));
  }
  std::vector<std::size_t> jumps;
  for (std::size_t k = 1; k < heights.size(); k++) {
    if (heights[k] > heights[k - 1]) return 0;
    if (heights[k] < heights[k - 1]) jumps.push_back(k);
  }
  if (jumps.size() < 2) return 0;
  const double step =
      shift * static_cast<double>(jumps.back() - jumps.front()) / static_cast<double>(jumps.size() - 1);
  return std::min(most_subpixel_bits, static_cast<int>(std::lround(-std::log2(step))));
}

namespace {

constexpr std::size_t rows_of_a_kind = 16384;
/// Operands lie between 2^-40 and 2^40, so that no result is too large or too small.
constexpr std::uint32_t least_float_exponent = 127 - 40, exponents = 80;

/// Random mantissa, exponent and sign.
float anyNumber(std::mt19937_64& random) {
  const std::uint64_t bits = random();
  const auto exponent = least_float_exponent + static_cast<std::uint32_t>((bits >> 32) % exponents);
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits & 0x807FFFFFu) | exponent << 23);
}

/// Random number in [2^exponent, 2^(exponent + 1)).
float numberFrom(std::mt19937_64& random, int exponent) {
  const auto bits = static_cast<std::uint32_t>(random()) & 0x7FFFFFu;
  return std::ldexp(std::bit_cast<float>(0x3F800000u | bits), exponent);
}

/// Operands for expressions of one operation. c is minus the rounded product. So a b + c is its rounding
/// error if product and sum are fused into one operation, else 0.
std::vector<Operands> anyOperands(std::mt19937_64& random) {
  std::vector<Operands> rows(rows_of_a_kind);
  for (Operands& row : rows) {
    row.a = anyNumber(random);
    row.b = anyNumber(random);
    row.c = -(row.a * row.b);
    row.d = 0;
  }
  return rows;
}

/// Operands like high and low parts of coordinates: both differences are exact, if they are computed first.
std::vector<Operands> coordinates(std::mt19937_64& random) {
  std::vector<Operands> rows(rows_of_a_kind);
  for (Operands& row : rows) {
    row = {numberFrom(random, 0), numberFrom(random, 0), numberFrom(random, -25), numberFrom(random, -25)};
  }
  return rows;
}

/// A product of normal numbers and a sum of denormal ones, both of which are 2^-130.
constexpr Operands for_denormal_product{0x1p-100F, 0x1p-30F, 0, 0};
constexpr Operands for_denormal_sum{0x1p-131F, 0x1p-131F, 0, 0};

/// Returns how far `found` is from `exact`, in ULP; infinity if it is not a number.
double errorInUlp(float found, double exact) {
  if (exact == 0) return found == 0 ? 0 : HUGE_VAL;
  const double error = std::abs(found - exact);
  if (!std::isfinite(error)) return HUGE_VAL;
  return std::ldexp(error, 23 - std::ilogb(exact));
}

// Double has more than twice the digits of float: its rounded quotients, roots and sums are exact enough.
void compareOperations(const Operands& row, const Computed& found, Arithmetic& worst) {
  const double a = row.a, b = row.b, root = std::sqrt(std::abs(a));
  const auto take = [](double& most, double error) { most = std::max(most, error); };
  take(worst.quotient, errorInUlp(found.quotient, a / b));
  take(worst.root, errorInUlp(found.root, root));
  take(worst.inverse_root, errorInUlp(found.inverse_root, 1 / root));
  take(worst.product, errorInUlp(found.product, a * b));
  take(worst.sum, errorInUlp(found.sum, a + b));
  const bool product_is_rounded = a * b != -double{row.c};
  worst.fuses = worst.fuses || (product_is_rounded && found.product_sum != 0);
  worst.fuses_precise = worst.fuses_precise || (product_is_rounded && found.rounded_twice != 0);
}

}  // namespace

Result<Arithmetic> measureArithmetic(Backend& backend) {
  std::mt19937_64 random(1);
  std::vector<Operands> rows = anyOperands(random);
  std::vector<Computed> found(rows.size());
  Arithmetic measured;
  VORPIPE_TRY(backend.compute(rows, found));
  for (std::size_t i = 0; i < rows.size(); ++i) compareOperations(rows[i], found[i], measured);
  rows = coordinates(random);
  rows.push_back(for_denormal_product);
  rows.push_back(for_denormal_sum);
  found.resize(rows.size());
  VORPIPE_TRY(backend.compute(rows, found));
  for (std::size_t i = 0; i < rows_of_a_kind; ++i) {
    const auto [a, b, c, d] = rows[i];
    const double exact = (double{a} - b) + (double{c} - d);
    measured.offset = std::max(measured.offset, errorInUlp(found[i].offset, exact));
  }
  measured.keeps_denormals =
      found[rows_of_a_kind].product == 0x1p-130F && found[rows_of_a_kind + 1].sum == 0x1p-130F;
  if (backend.info().has_vertices) {
    VORPIPE_LET(bits, measureSubpixelBits(backend));
    measured.subpixel_bits = bits;
  }
  const DeviceInfo& device = backend.info().device;
  measured.report.backend = device.backend;
  measured.report.device = device.name;
  measured.report.driver = device.driver;
  measured.report.validation_messages = backend.validationMessages();
  return measured;
}

}  // namespace vorpipe::core
