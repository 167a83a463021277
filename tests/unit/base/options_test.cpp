#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

#include "base/option_rows.h"
#include "base/words.h"

namespace vorpipe::test {
namespace {

TEST(OptionNames, AreThoseOfTheirValues) {
  EXPECT_EQ(nameOf(Periodic::xy), "xy");
  EXPECT_EQ(nameOf(Surface::free), "free");
  EXPECT_EQ(nameOf(Detail::everything), "all");
  EXPECT_EQ(nameOf(Search::flann), "flann");
  EXPECT_EQ(nameOf(ColorBy::neighbors), "neighbors");
  EXPECT_EQ(nameOf(ColorScale::quantile), "quantile");
  EXPECT_EQ(nameOf(Fit::letterbox), "letterbox");
  EXPECT_EQ(nameOf(RelaxMethod::lloyd), "lloyd");
  EXPECT_EQ(nameOf(RelaxEnd::cancelled), "cancelled");
  EXPECT_EQ(nameOf(TransportEnd::cancelled), "cancelled");
  EXPECT_EQ(nameOf(FluidScheme::projection), "projection");
  EXPECT_EQ(nameOf(FluidEnd::cancelled), "cancelled");
}

TEST(OptionNames, LeadBackToTheirValues) {
  for (const std::string_view name : names_of<ColorScale>) {
    ASSERT_TRUE(valueNamed<ColorScale>(name)) << name;
    EXPECT_EQ(nameOf(*valueNamed<ColorScale>(name)), name);
  }
  EXPECT_FALSE(valueNamed<ColorScale>("automatic", ColorScale::linear)) << "it is not offered";
  EXPECT_FALSE(valueNamed<ColorScale>("Linear"));
  EXPECT_EQ(namesFrom(Periodic::x), (std::vector<std::string>{"x", "y", "xy"}));
}

/// Checks that no two rows have one name, and that each default of a number is in its range.
template <class Struct, class Rows>
void checkRows(const Rows& rows) {
  std::set<std::string> flags;
  forEachRow(rows, [&](const auto& row) {
    EXPECT_TRUE(flags.insert(flagOf(row)).second) << row.name;
    if constexpr (requires { row.least; }) {
      const auto usual = Struct{}.*row.member;
      EXPECT_TRUE((usual >= row.least && usual <= row.most) || usual == 0) << row.name << ": " << usual;
      EXPECT_GE(row.least_given, row.least) << row.name;
    }
  });
}

TEST(OptionRows, HaveDefaultsInTheirRanges) {
  checkRows<RenderOptions>(picture_rows);
  checkRows<RelaxOptions>(relax_rows);
  checkRows<TransportOptions>(transport_rows);
  checkRows<FluidOptions>(fluid_rows);
  EXPECT_EQ(flagOf(std::get<0>(fluid_rows)), "--time") << "of the member until";
  EXPECT_EQ(flagOf(label_size_row), "--label-size");
}

TEST(Words, AreWholeNumbersOrNot) {
  EXPECT_EQ(wholeNumber<int>("-12"), -12);
  EXPECT_EQ(wholeNumber<std::uint64_t>("18446744073709551615"), UINT64_MAX);
  for (const std::string_view text : {"", " 1", "1 ", "1.0", "+1", "-1", "18446744073709551616", "x"}) {
    EXPECT_FALSE(wholeNumber<std::uint64_t>(text)) << text;
  }
  EXPECT_TRUE(isPartOf("LLVM", "llvmpipe (256 bits)"));
  EXPECT_TRUE(isPartOf("", "any"));
  EXPECT_FALSE(isPartOf("llvmpipe2", "llvmpipe"));
}

}  // namespace
}  // namespace vorpipe::test
