/// What is refused before anything is computed, and what a run says that it did.
#include <gmock/gmock.h>

#include <cmath>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

using ::testing::HasSubstr;

/// What checkInput says, which is what a run says.
std::string refusalOf(const Sites& sites, const CellsOptions& options) {
  const auto checked = checkInput(sites, options);
  const auto cells = cpuSession().cells(sites, options);
  if (checked || cells) return checked && cells ? "accepted" : "only one accepted";
  EXPECT_EQ(checked.error().message, cells.error().message);
  EXPECT_EQ(checked.error().code, ErrorCode::input);
  return checked.error().message;
}

TEST(Input, IsRefusedAsByARun) {
  const Sites sites = mixedSites();
  EXPECT_EQ(refusalOf(sites, unit_cells), "accepted");
  EXPECT_THAT(refusalOf({}, unit_cells), HasSubstr("there are no sites"));
  EXPECT_THAT(refusalOf({{0, NAN}, {0, 0}, {}}, unit_cells), HasSubstr("site 1 is not finite"));
  EXPECT_THAT(refusalOf({{0, 1e200}, {0, 0}, {}}, unit_cells), HasSubstr("site 1 is too far"));
  EXPECT_THAT(refusalOf({{0, 1}, {0, 0}, {0, 1e300}}, unit_cells), HasSubstr("the weight of site 1"));
  CellsOptions options = unit_cells;
  options.domain.xmax = -1;
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("is not a rectangle"));
  options = unit_cells;
  options.density = {2, 2, {1, 2, 3}};
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("density: 3 values"));
  options.density = {1, 1, {1e281}};
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("density: its largest value is 1e+281"));
  options.density = {1, 1, {1e280}};
  EXPECT_EQ(refusalOf(sites, options), "accepted");
  options.domain = {0, 0, 1e15, 1e15};
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("1e-301 to 1e+301 times the domain's area"));
  options.domain = unit_cells.domain;
  for (const double none_or_little : {0.0, 1e-280}) {
    options.density = {1, 1, {none_or_little}};
    EXPECT_EQ(refusalOf(sites, options), "accepted");
  }
  options.density = {1, 1, {5e-324}};
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("density: its largest value is 5e-324"));
  options = unit_cells;
  options = inside(outlineOf({{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}}));
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("outline: "));
  options = unit_cells;
  options.periodic = Periodic::x;
  EXPECT_EQ(refusalOf(sites, options), "accepted");
  EXPECT_THAT(refusalOf({{0.5, 0x1p60}, {0, 0}, {}}, options),
              HasSubstr("too far from the domain to be wrapped"));
  options.search.neighbors = 2;
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("2 neighbors"));
}

TEST(Input, IsInARangeThatAreasHave) {
  const auto refusal = [](double size) {
    CellsOptions options{};
    options.domain = {0, 0, size, size};
    return refusalOf({{0.25 * size, 0.75 * size}, {0.5 * size, 0.5 * size}, {}}, options);
  };
  for (const double size : {1e-150, 1e-10, 1e150}) EXPECT_EQ(refusal(size), "accepted") << size;
  for (const double size : {1e-170, 1e160, 1e300}) {
    EXPECT_THAT(refusal(size), HasSubstr("lies between 1e-301 and 1e+301")) << size;
    RenderOptions picture{};
    picture.domain = {0, 0, size, size};
    picture.width = picture.height = 4;
    EXPECT_FALSE(cpuSession().render({{0.5 * size}, {0.5 * size}, {}}, picture)) << size;
  }
}

TEST(Input, HasNoDomainThatIsAllButALine) {
  const auto refusal = [](double width, double height) {
    CellsOptions options{};
    options.domain = {0, 0, width, height};
    return refusalOf({{width}, {0}, {}}, options);
  };
  for (const double side : {1.0, 1e-6, 1e-12}) {
    EXPECT_EQ(refusal(1, side), "accepted") << side;
    EXPECT_EQ(refusal(side * 1e100, 1e100), "accepted") << side;
  }
  for (const double side : {0.9e-12, 1e-14, 1e-30}) {
    EXPECT_THAT(refusal(1, side), HasSubstr("at least 1e-12 of the other")) << side;
    EXPECT_THAT(refusal(side * 1e100, 1e100), HasSubstr("at least 1e-12 of the other")) << side;
  }
}

TEST(Input, SaysWhatOfItIsWrong) {
  const auto subject = [](const Sites& sites, const CellsOptions& options) {
    const auto checked = checkInput(sites, options);
    return checked ? Subject::none : checked.error().subject;
  };
  const Sites sites{{0.25, 0.75}, {0.5, 0.5}, {}};
  EXPECT_EQ(subject(sites, unit_cells), Subject::none);
  EXPECT_EQ(subject({{0.25, NAN}, {0.5, 0.5}, {}}, unit_cells), Subject::sites);
  EXPECT_EQ(subject({{0.25, 0.75}, {0.5, 0.5}, {1, NAN}}, unit_cells), Subject::weights);
  CellsOptions options = unit_cells;
  options.domain = {0, 0, 0, 1};
  EXPECT_EQ(subject(sites, options), Subject::domain);
  options = unit_cells;
  options.search.neighbors = 2;
  EXPECT_EQ(subject(sites, options), Subject::search);
  options = unit_cells;
  options.density = {2, 2, {1, 1, -1, 1}};
  EXPECT_EQ(subject(sites, options), Subject::density);
  options = unit_cells;
  options.outline = {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {0, 4}, {0, 1}};
  EXPECT_EQ(subject(sites, options), Subject::outline);
}

TEST(Input, FlannTakesNoWeights) {
  Sites sites = mixedSites();
  CellsOptions options = unit_cells;
  options.search.method = Search::flann;
  sites.weight.assign(sites.size(), 3);
  EXPECT_EQ(refusalOf(sites, options), "accepted");
  sites.weight[5] = 4;
  EXPECT_THAT(refusalOf(sites, options), HasSubstr("search: of sites with weights"));
}

RenderOptions pictureOf(const CellsOptions& cells) {
  RenderOptions picture{};
  picture.domain = cells.domain;
  picture.outline = cells.outline;
  picture.periodic = cells.periodic;
  picture.width = picture.height = 20;
  return picture;
}

Sites weightedSites() {
  Sites sites = generate(Pattern::random, 400, 1);
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(0.01 * static_cast<double>(i % 7));
  return sites;
}

TEST(Report, CountsHiddenSites) {
  const Sites sites = weightedSites();
  for (const auto periodic : {Periodic::none, Periodic::x, Periodic::xy}) {
    CellsOptions options = unit_cells;
    options.periodic = periodic;
    const auto cells = cpuSession().cells(sites, options);
    const auto picture = cpuSession().render(sites, pictureOf(options));
    ASSERT_TRUE(cells && picture);
    EXPECT_GT(cells->report.hidden, 100u);
    EXPECT_EQ(cells->report.hidden, cells->report.empty);
    EXPECT_EQ(picture->report.hidden, cells->report.hidden);
    EXPECT_EQ(cells->report.ok + cells->report.empty, 400u);
  }
  EXPECT_EQ(cellsOf(mixedSites(), unit_cells).report.hidden, 0u);
}

TEST(Report, TellsHiddenSitesFromThoseBesideAnOutline) {
  const Sites sites = weightedSites();
  const auto in_box = cellsOf(sites, unit_cells).report;
  const auto clipped = cellsOf(sites, inside(outlineOf({{rectangle(0, 0, 0.5, 1)}}))).report;
  EXPECT_EQ(clipped.hidden, in_box.hidden);
  EXPECT_GT(clipped.empty, clipped.hidden);
}

TEST(Report, OfAPictureHasWhatItsCellsTook) {
  const Sites sites = weightedSites();
  const auto cells = cellsOf(sites, unit_cells).report;
  const auto picture = cpuSession().render(sites, pictureOf(unit_cells));
  ASSERT_TRUE(picture);
  EXPECT_GT(cells.retried + cells.in_double, 0u);
  EXPECT_GE(picture->report.retried + picture->report.in_double, cells.retried + cells.in_double);
  EXPECT_GT(picture->report.time_ms.cells, 0);
}

TEST(Report, OfAPictureInAnOutlineTellsWhetherCellsWereNeeded) {
  const auto picture = pictureOf(inside(outlineOf({{rectangle(0, 0, 0.5, 1)}})));
  Sites sites = generate(Pattern::random, 50, 2);
  for (double& x : sites.x) x /= 2;
  const auto all_inside = cpuSession().render(sites, picture);
  ASSERT_TRUE(all_inside);
  EXPECT_LT(all_inside->report.time_ms.cells, 0);
  EXPECT_EQ(all_inside->report.ok, 50u);
  sites.x[3] = 0.9;
  sites.y[3] = sites.y[4];
  const auto one_outside = cpuSession().render(sites, picture);
  ASSERT_TRUE(one_outside);
  EXPECT_GT(one_outside->report.time_ms.cells, 0);
  EXPECT_EQ(one_outside->status, cellsOf(sites, inside(picture.outline)).status);
}

}  // namespace
}  // namespace vorpipe::test
