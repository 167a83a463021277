// No proposal that lies passes the certificate of cells in space: each is refused, by the condition named
// here.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "space/cell_check.h"
#include "space/certify.h"
#include "space/exact_search.h"
#include "space/hidden.h"
#include "space/predicates.h"
#include "support/exact3.h"

namespace vorpipe::space {
namespace {

/// Four labels, ascending: the labels of a vertex.
using Quadruple = std::array<Label, 4>;

/// Whether the labels need an even number of exchanges to be in order, and those.
std::pair<Quadruple, int> ordered(Quadruple labels) {
  int sign = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j + 1 < 4 - i; ++j) {
      if (labels[j] <= labels[j + 1]) continue;
      std::swap(labels[j], labels[j + 1]);
      sign = -sign;
    }
  }
  return {labels, sign};
}

/// A complex as its oriented vertices.
using Complex = std::map<Quadruple, int>;

void add(Complex& complex, const Quadruple& labels, int sign = 1) {
  const auto [key, order] = ordered(labels);
  complex[key] = sign * order;
}

/// Sites and everything that certifies them.
struct Case {
  SiteBins bins;
  explicit Case(const Sites3& sites, const Box3& box = {0, 0, 0, 1, 1, 1},
                const std::vector<double>& weights = {})
      : bins(binSites(sites, box, 1, weights)) {}
  [[nodiscard]] std::size_t size() const { return bins.sites.size(); }
  /// In the order of labels, in the units of the input.
  [[nodiscard]] Sites3 unscaled() const {
    Sites3 sites;
    for (const Point3& p : bins.sites)
      sites.push_back({p.x / bins.scale, p.y / bins.scale, p.z / bins.scale});
    return sites;
  }
  /// The same; none if all are equal.
  [[nodiscard]] std::vector<double> unscaledWeights() const {
    std::vector<double> weights;
    for (const double weight : bins.weights) weights.push_back(weight / bins.scale / bins.scale);
    return weights;
  }
  /// The labels that the sites of another case have here.
  [[nodiscard]] std::map<Label, Label> namesOf(const Case& other) const {
    std::map<Point3, Label> name;
    const auto here = unscaled(), there = other.unscaled();
    for (std::size_t i = 0; i < here.size(); ++i) name[here[i]] = static_cast<Label>(i);
    std::map<Label, Label> names;
    for (std::size_t i = 0; i < there.size(); ++i) names[static_cast<Label>(i)] = name.at(there[i]);
    return names;
  }
};

/// The true complex, by exact cells, and the sites that are proved to have no cell.
Complex truth(const Case& of, std::vector<std::uint8_t>& hidden) {
  Complex complex;
  hidden.assign(of.size(), 0);
  ExactSearch search(of.bins);
  for (std::size_t i = 0; i < of.size(); ++i) {
    const auto site = static_cast<Label>(i);
    const ExactCell& cell = search.cellOf(site);
    hidden[i] = cell.empty() && leaveNothing(of.bins.places(), site, cell.emptiedBy()) ? 1 : 0;
    EXPECT_EQ(hidden[i] != 0, cell.empty());
    for (const auto& v : cell.vertices()) add(complex, {site, v[0], v[1], v[2]});
  }
  return complex;
}

/// Rows of a complex. None if some face has no single ring.
struct Proposal {
  Rows rows;
  RowArena arena;
  bool whole = true;
  Proposal(const Complex& complex, std::size_t sites) : rows(sites) {
    std::map<Label, std::vector<std::array<Label, 3>>> corners;
    for (const auto& [labels, sign] : complex) {
      for (std::size_t e = 0; e < 4; ++e) {
        if (isWallLabel(labels[e])) continue;
        std::array<Label, 3> others{};
        std::size_t n = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          if (k != e) others[n++] = labels[k];
        }
        if ((sign > 0) != (e % 2 == 0)) std::swap(others[0], others[1]);
        corners[labels[e]].push_back(others);
      }
    }
    for (const auto& [site, of_site] : corners) set(site, of_site);
  }

  void set(Label site, const std::vector<std::array<Label, 3>>& corners) {
    std::set<Label> names;
    for (const auto& corner : corners) names.insert(corner.begin(), corner.end());
    const std::vector<Label> neighbors(names.begin(), names.end());
    std::vector<std::array<std::uint32_t, 3>> vertices;
    for (const auto& corner : corners) {
      std::array<std::uint32_t, 3> faces{};
      for (std::size_t k = 0; k < 3; ++k) {
        faces[k] =
            static_cast<std::uint32_t>(std::ranges::lower_bound(neighbors, corner[k]) - neighbors.begin());
      }
      vertices.push_back(faces);
    }
    whole = rows.set(static_cast<std::size_t>(site), neighbors, vertices, arena) && whole;
  }
};

/// The conditions that rows break: "C1" to "C5", ascending.
std::set<std::string> broken(const Case& of, const Rows& rows, const std::vector<std::uint8_t>& hidden) {
  std::set<std::string> conditions;
  const Places places = of.bins.places();
  CellCheck check(places, rows);
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (rows[i].faces == 0) continue;
    switch (check.check(static_cast<Label>(i)).broken) {
      case Broken::nothing:
        break;
      case Broken::row:
      case Broken::rings:
      case Broken::glue:
        conditions.insert("C1");
        break;
      case Broken::orientation:
        conditions.insert("C2");
        break;
      case Broken::edge:
        conditions.insert("C3");
        break;
    }
  }
  if (cellsOfCorner(rows) != 1) conditions.insert("C4");
  if (forgetsSite(rows, hidden)) conditions.insert("C5");
  return conditions;
}
std::set<std::string> broken(const Case& of, const Complex& complex,
                             const std::vector<std::uint8_t>& hidden) {
  const Proposal proposal(complex, of.size());
  if (!proposal.whole) return {"C1"};
  return broken(of, proposal.rows, hidden);
}

using Conditions = std::set<std::string>;

/// The members of a complex among the subsets of five labels are replaced by the others: the boundary stays.
/// None if that is no flip.
std::optional<Complex> flipped(const Complex& complex, const std::array<Label, 5>& five) {
  std::vector<std::pair<Quadruple, int>> have, rest;
  for (std::size_t e = 0; e < 5; ++e) {
    Quadruple labels{};
    std::size_t n = 0;
    for (std::size_t k = 0; k < 5; ++k) {
      if (k != e) labels[n++] = five[k];
    }
    const auto [key, order] = ordered(labels);
    const std::pair<Quadruple, int> side{key, e % 2 == 0 ? order : -order};
    (complex.contains(key) ? have : rest).push_back(side);
  }
  if (have.empty() || rest.empty()) return std::nullopt;
  const int turn = complex.at(have[0].first) * have[0].second;
  for (const auto& [key, sign] : have) {
    if (complex.at(key) * sign != turn) return std::nullopt;
  }
  Complex other = complex;
  for (const auto& side : have) other.erase(side.first);
  for (const auto& [key, sign] : rest) {
    if (key[3] >= 0) other[key] = -turn * sign;
  }
  return other;
}

/// The five labels of each two vertices that share three.
std::vector<std::array<Label, 5>> pairsOf(const Complex& complex) {
  std::map<std::array<Label, 3>, std::vector<Quadruple>> by_triple;
  for (const auto& vertex : complex) {
    const Quadruple& q = vertex.first;
    for (std::size_t e = 0; e < 4; ++e) {
      std::array<Label, 3> triple{};
      std::size_t n = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k != e) triple[n++] = q[k];
      }
      by_triple[triple].push_back(q);
    }
  }
  std::set<std::array<Label, 5>> fives;
  for (const auto& [triple, vertices] : by_triple) {
    if (vertices.size() != 2) continue;
    std::set<Label> all(vertices[0].begin(), vertices[0].end());
    all.insert(vertices[1].begin(), vertices[1].end());
    std::array<Label, 5> five{};
    std::ranges::copy(all, five.begin());
    fives.insert(five);
  }
  return {fives.begin(), fives.end()};
}

Complex renamed(const Complex& complex, const std::map<Label, Label>& names) {
  Complex other;
  for (const auto& [labels, sign] : complex) {
    Quadruple to{};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto name = names.find(labels[k]);
      to[k] = name == names.end() ? labels[k] : name->second;
    }
    add(other, to, sign);
  }
  return other;
}

Sites3 randomSites(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Sites3 sites(count);
  for (Point3& p : sites) p = {uniform(random), uniform(random), uniform(random)};
  return sites;
}

Sites3 lattice() {
  Sites3 sites;
  for (int k = 0; k < 18; ++k)
    sites.push_back({(2 * (k % 3) + 1) / 8.0, (2 * (k / 3 % 3) + 1) / 8.0, (2 * (k / 9) + 1) / 8.0});
  return sites;
}

class Lies : public testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    std::mt19937_64 random(GetParam());
    const Sites3 sites = GetParam() % 4 == 3 ? lattice() : randomSites(random, 8 + random() % 20);
    std::vector<double> weights;
    if (GetParam() >= 16) {
      for (std::size_t i = 0; i < sites.size(); ++i)
        weights.push_back(static_cast<double>(random() % 9) / 128);
    }
    of_.emplace(sites, Box3{0, 0, 0, 1, 1, 1}, weights);
    complex_ = truth(*of_, hidden_);
    random_ = random;
    RecordProperty("seed", std::to_string(GetParam()));
  }
  [[nodiscard]] Conditions brokenBy(const Complex& complex) const { return broken(*of_, complex, hidden_); }

  std::optional<Case> of_;
  Complex complex_;
  std::vector<std::uint8_t> hidden_;
  std::mt19937_64 random_;
};

// From 16 on with weights.
INSTANTIATE_TEST_SUITE_P(Seeds, Lies, testing::Range<std::uint64_t>(0, 32));

TEST_P(Lies, TheTruthPasses) { EXPECT_EQ(brokenBy(complex_), Conditions{}); }

TEST_P(Lies, FlipsInAllCellsAreRefused) {
  int flips = 0;
  for (const auto& five : pairsOf(complex_)) {
    const auto other = flipped(complex_, five);
    if (!other) continue;
    ++flips;
    const Conditions conditions = brokenBy(*other);
    EXPECT_FALSE(conditions.empty()) << five[0] << ' ' << five[1] << ' ' << five[2] << ' ' << five[3] << ' '
                                     << five[4];
  }
  EXPECT_GT(flips, 20);
}

TEST_P(Lies, SequencesOfFlipsAreRefused) {
  for (int repeat = 0; repeat < 6; ++repeat) {
    Complex other = complex_;
    for (std::uint64_t left = 2 + random_() % 7, tries = 0; left > 0 && tries < 100; ++tries) {
      const auto fives = pairsOf(other);
      const auto next = flipped(other, fives[random_() % fives.size()]);
      // Those that leave orientations right are the hard ones.
      if (!next || (brokenBy(*next).contains("C2") && random_() % 8 != 0)) continue;
      other = *next;
      --left;
    }
    if (other != complex_) {
      EXPECT_NE(brokenBy(other), Conditions{});
    }
  }
}

TEST_P(Lies, LabelsExchangedEverywhereAreRefused) {
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto a = static_cast<Label>(random_() % of_->size()),
               b = static_cast<Label>(random_() % of_->size());
    const auto isHidden = [this](Label site) { return hidden_[static_cast<std::size_t>(site)] != 0; };
    if (a == b || (isHidden(a) && isHidden(b))) continue;
    EXPECT_NE(brokenBy(renamed(complex_, {{a, b}, {b, a}})), Conditions{}) << a << ' ' << b;
  }
  EXPECT_TRUE(brokenBy(renamed(complex_, {{-1, -2}, {-2, -1}})).contains("C2"));
}

TEST_P(Lies, AMirrorImageIsRefusedByOrientation) {
  Complex other = complex_;
  for (auto& vertex : other) vertex.second = -vertex.second;
  EXPECT_TRUE(brokenBy(other).contains("C2"));
}

TEST_P(Lies, ASiteLeftOutEverywhereIsForgotten) {
  Sites3 sites = of_->unscaled();
  std::vector<double> weights = of_->unscaledWeights();
  std::size_t left_out = 0;
  do left_out = random_() % sites.size();
  while (hidden_[left_out] != 0);
  sites.erase(sites.begin() + static_cast<std::ptrdiff_t>(left_out));
  if (!weights.empty()) weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(left_out));
  const Case fewer(sites, {0, 0, 0, 1, 1, 1}, weights);
  std::vector<std::uint8_t> hidden;
  EXPECT_EQ(brokenBy(renamed(truth(fewer, hidden), of_->namesOf(fewer))), Conditions{"C5"});
}

// A wall is forgotten, or stands elsewhere: cells as they would be if the box reached further there.
TEST_P(Lies, CellsThatReachBeyondAWallAreRefused) {
  int different = 0;
  for (const Box3& wider : {Box3{0, 0, 0, 8, 1, 1}, Box3{0, -8, 0, 1, 1, 1}, Box3{0, 0, -0.5, 1, 1, 1.5}}) {
    const Case beyond(of_->unscaled(), wider, of_->unscaledWeights());
    std::vector<std::uint8_t> hidden;
    const Complex other = renamed(truth(beyond, hidden), of_->namesOf(beyond));
    if (other == complex_) continue;
    ++different;
    EXPECT_EQ(brokenBy(other), Conditions{"C3"});
  }
  // Those of the lattice are longer there, and have the same neighbors.
  EXPECT_EQ(different > 0, GetParam() % 4 != 3);
  Complex without = complex_;
  std::erase_if(without, [](const auto& vertex) { return std::ranges::count(vertex.first, -2) > 0; });
  EXPECT_EQ(brokenBy(without), Conditions{"C1"});
}

TEST_P(Lies, TwoSheetsAreRefusedByTheCorner) {
  Complex both;
  const Sites3 sites = of_->unscaled();
  const std::vector<double> weights = of_->unscaledWeights();
  for (const std::size_t half : {0U, 1U}) {
    Sites3 of_half;
    std::vector<double> its_weights;
    for (std::size_t i = half; i < sites.size(); i += 2) {
      of_half.push_back(sites[i]);
      if (!weights.empty()) its_weights.push_back(weights[i]);
    }
    const Case sheet(of_half, {0, 0, 0, 1, 1, 1}, its_weights);
    std::vector<std::uint8_t> hidden;
    both.merge(renamed(truth(sheet, hidden), of_->namesOf(sheet)));
  }
  EXPECT_EQ(brokenBy(both), Conditions{"C4"});
}

TEST_P(Lies, RowsThatDisagreeAreRefused) {
  for (int repeat = 0; repeat < 4; ++repeat) {
    // One vertex is another in one of its cells; a row is gone, but not for its neighbors.
    Proposal proposal(complex_, of_->size());
    ASSERT_TRUE(proposal.whole);
    std::size_t site = 0;
    do site = random_() % of_->size();
    while (hidden_[site] != 0);
    proposal.rows.clear(site);
    EXPECT_TRUE(broken(*of_, proposal.rows, hidden_).contains("C1"));
    // Two thirds are exchanged in the cell of one site alone.
    std::vector<std::array<Label, 3>> corners;
    ExactSearch search(of_->bins);
    const ExactCell& cell = search.cellOf(static_cast<Label>(site));
    corners.assign(cell.vertices().begin(), cell.vertices().end());
    const Label a = corners[0][0], b = corners[1 + random_() % (corners.size() - 1)][1];
    if (a == b) continue;
    for (auto& corner : corners) {
      for (Label& label : corner) label = label == a ? b : label == b ? a : label;
    }
    Proposal exchanged(complex_, of_->size());
    exchanged.set(static_cast<Label>(site), corners);
    if (exchanged.whole) {
      EXPECT_TRUE(broken(*of_, exchanged.rows, hidden_).contains("C1"));
    }
  }
}

TEST_P(Lies, ARingThatIsEmptiedMakesNoRow) {
  ExactSearch search(of_->bins);
  Label site = 0;
  do site = static_cast<Label>(random_() % of_->size());
  while (hidden_[static_cast<std::size_t>(site)] != 0);
  const auto all = search.cellOf(site).vertices();
  const std::vector<std::array<Label, 3>> corners(all.begin(), all.end());
  Proposal whole(complex_, of_->size());
  whole.set(site, corners);
  EXPECT_TRUE(whole.whole);
  const Label emptied = corners[random_() % corners.size()][0];
  std::vector<std::array<Label, 3>> others;
  for (const auto& corner : corners) {
    if (std::ranges::count(corner, emptied) == 0) others.push_back(corner);
  }
  Proposal proposal(complex_, of_->size());
  proposal.set(site, others);
  EXPECT_FALSE(proposal.whole);
  EXPECT_TRUE(broken(*of_, proposal.rows, hidden_).contains("C1"));
}

// Sites beyond the box have no cell. Each is put into each vertex, in all cells that have it: a flip of one
// to four.
TEST(Certificate, CellsOfSitesWithoutAnyAreRefused) {
  int inserted = 0, by_regularity_alone = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    std::mt19937_64 random(seed);
    Sites3 sites = randomSites(random, 15);
    for (const double far : {-1.5, -0.6, 1.7, 2.6}) sites.push_back({far, 0.3 + 0.1 * far, 0.5});
    const Case of(sites);
    std::vector<std::uint8_t> hidden;
    const Complex complex = truth(of, hidden);
    EXPECT_EQ(broken(of, complex, hidden), Conditions{});
    EXPECT_GT(std::ranges::count(hidden, 1), 0);
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (hidden[i] == 0) continue;
      for (const auto& vertex : complex) {
        const Quadruple& q = vertex.first;
        const auto other = flipped(complex, {q[0], q[1], q[2], q[3], static_cast<Label>(i)});
        ASSERT_TRUE(other.has_value());
        ++inserted;
        const Conditions conditions = broken(of, *other, hidden);
        EXPECT_FALSE(conditions.empty()) << "seed " << seed << ", site " << i;
        by_regularity_alone += conditions == Conditions{"C3"} ? 1 : 0;
      }
    }
  }
  EXPECT_GT(inserted, 500);
  EXPECT_GT(by_regularity_alone, 0);
}

// Each condition is needed: some lie is refused by it alone. (C1, C4 and C5 alone refuse lies above and
// below.)
TEST(Certificate, FlipsNeedOrientationAndRegularity) {
  std::set<Conditions> alone;
  for (std::uint64_t seed = 0; seed < 40 && alone.size() < 2; ++seed) {
    std::mt19937_64 random(seed);
    const Case of(randomSites(random, 20));
    std::vector<std::uint8_t> hidden;
    const Complex complex = truth(of, hidden);
    for (const auto& five : pairsOf(complex)) {
      const auto other = flipped(complex, five);
      if (!other) continue;
      const Conditions conditions = broken(of, *other, hidden);
      if (conditions == Conditions{"C2"} || conditions == Conditions{"C3"}) alone.insert(conditions);
    }
  }
  EXPECT_EQ(alone.size(), 2U);
}

// A connected cover of the box, twice: two sites on an axis, and five at steps of 144 degrees around it. The
// cells of the axis are prisms over a pentagram: closed, oriented, regular everywhere.
TEST(Certificate, OnlyTheCornerRefusesAStar) {
  constexpr double size = 1.0 / 8;
  Sites3 sites{{0, 0, -size / 20}, {0, 0, size / 20}};
  for (int k = 0; k < 5; ++k) {
    const double angle = 144 * k * std::numbers::pi / 180;
    sites.push_back({size * std::cos(angle), size * std::sin(angle), 0});
  }
  const double h = 3 * size;
  const Case of(sites, {-h, -h, -h, h, h, h});
  std::map<Point3, Label> name;
  for (std::size_t i = 0; i < of.size(); ++i) name[of.bins.sites[i]] = static_cast<Label>(i);
  const Places places = of.bins.places();
  Complex complex;
  const auto put = [&](Quadruple labels) {
    for (Label& label : labels) {
      if (label >= 0) {
        const Point3& p = sites[static_cast<std::size_t>(label)];
        label = name.at({p.x * of.bins.scale, p.y * of.bins.scale, p.z * of.bins.scale});
      }
    }
    const int turn = orientation(places, labels[0], labels[1], labels[2], labels[3]);
    ASSERT_NE(turn, 0);
    add(complex, labels, turn);
  };
  constexpr Label x0 = -1, x1 = -2, y0 = -3, y1 = -4, z0 = -5, z1 = -6;
  const std::array<Label, 5> wall{y1, x0, x1, x0, y0};
  const std::array<std::vector<std::array<Label, 2>>, 5> corners{
      {{{y0, x1}, {x1, y1}}, {{y1, x0}}, {{x0, y0}, {y0, x1}}, {{x1, y1}, {y1, x0}}, {{x0, y0}}}};
  for (std::size_t k = 0; k < 5; ++k) {
    const auto s = static_cast<Label>(2 + k), t = static_cast<Label>(2 + (k + 1) % 5);
    put({0, 1, s, t});
    put({0, s, t, z0});
    put({1, s, t, z1});
    put({s, t, z0, wall[k]});
    put({s, t, z1, wall[k]});
    for (const auto& corner : corners[k]) {
      put({s, corner[0], corner[1], z0});
      put({s, corner[0], corner[1], z1});
    }
  }
  EXPECT_EQ(complex.size(), 41U);
  EXPECT_EQ(broken(of, complex, std::vector<std::uint8_t>(of.size(), 0)), Conditions{"C4"});
}

TEST(Certificate, AMirroredCellOfOneSiteIsRefused) {
  const Case of({{0.3, 0.4, 0.6}});
  std::vector<std::uint8_t> hidden;
  Complex complex = truth(of, hidden);
  EXPECT_EQ(broken(of, complex, hidden), Conditions{});
  for (auto& vertex : complex) vertex.second = -vertex.second;
  EXPECT_EQ(broken(of, complex, hidden), Conditions{"C2"});
}

// Edges that the distances of sites would prove (corrections of 1.8): the error grows with the radius.
TEST(Certificate, NearSitesHaveNoEdgeOfTheWrongSign) {
  const Sites3 five{{0.750813438963927, 0.6426689233250775, 0.5964801970410043},
                    {0.7508134390051346, 0.6426689233211534, 0.5964801969499739},
                    {0.5822093319589013, 0.7140066664813968, 0.6601020482958477},
                    {0.6387159488226736, 0.6885049167784874, 0.6731076463546524},
                    {0.6077779060509136, 0.4492690757518062, 0.5354922850339192}};
  const Case of(five);
  std::vector<std::uint8_t> hidden;
  const Complex complex = truth(of, hidden);
  EXPECT_EQ(broken(of, complex, hidden), Conditions{});
  for (const auto& labels : pairsOf(complex)) {
    if (const auto other = flipped(complex, labels)) {
      EXPECT_NE(broken(of, *other, hidden), Conditions{});
    }
  }
}

// What proves that a site has no cell: with each of its labels exchanged for another it proves no longer, or
// still does so rightly; and of sites with a cell nothing does.
TEST(Certificate, OnlyHiddenSitesAreProvedToHaveNoCell) {
  int hidden_sites = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    std::mt19937_64 random(seed);
    const Sites3 sites = seed % 3 == 2 ? lattice() : randomSites(random, 25);
    std::vector<double> weights;
    for (std::size_t i = 0; i < sites.size(); ++i) weights.push_back(static_cast<double>(random() % 9) / 64);
    const Case of(sites, {0, 0, 0, 1, 1, 1}, weights);
    const Places places = of.bins.places();
    std::vector<NoCell> reasons;
    std::vector<std::uint8_t> hidden;
    truth(of, hidden);
    ExactSearch search(of.bins);
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (!search.cellOf(static_cast<Label>(i)).empty()) continue;
      ++hidden_sites;
      reasons.push_back(search.emptiedBy());
      for (int change = 0; change < 20; ++change) {
        NoCell other = search.emptiedBy();
        other[random() % 4] = static_cast<Label>(random() % (of.size() + walls)) - walls;
        refused += leaveNothing(places, static_cast<Label>(i), other) ? 0 : 1;
      }
    }
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (hidden[i] != 0) continue;
      for (const NoCell& reason : reasons) EXPECT_FALSE(leaveNothing(places, static_cast<Label>(i), reason));
      for (int any = 0; any < 200; ++any) {
        NoCell reason{};
        for (Label& label : reason) label = static_cast<Label>(random() % (of.size() + walls)) - walls;
        EXPECT_FALSE(leaveNothing(places, static_cast<Label>(i), reason));
      }
    }
  }
  EXPECT_GT(hidden_sites, 30);
  EXPECT_GT(refused, 100);
}

// Cells of equal surroundings are computed once: no site, wall, weight or rounded coordinate more or less
// passes for equal.
void expectTheSameCellsAgain(bool weighs) {
  constexpr int n = 9;
  for (const double cell_size : {1.0 / 8, 1.0 / n}) {
    Sites3 sites;
    std::vector<double> weights;
    for (int x = 0; x < n; ++x) {
      for (int y = 0; y < n; ++y) {
        for (int z = 0; z < n; ++z) {
          // A vacancy, and a site that is moved by a hair.
          if (x == 4 && y == 3 && z == 5) continue;
          const double moved = x == 2 && y == 6 && z == 3 ? 0x1p-50 : 0;
          sites.push_back({(x + 0.4) * cell_size + moved, (y + 0.4) * cell_size, (z + 0.4) * cell_size});
          const double more = x == 6 && y == 2 && z == 6 ? 0x1p-50 : 0;
          if (weighs) weights.push_back((x + y + z) % 2 == 0 ? 0 : 0x1p-8 + more);
        }
      }
    }
    const Case of(sites, {0, 0, 0, n * cell_size, n * cell_size, n * cell_size}, weights);
    ExactSearch remembers(of.bins);
    for (std::size_t i = 0; i < of.size(); ++i) {
      const auto site = static_cast<Label>(i);
      ExactSearch search(of.bins);
      ExactRow row;
      row.set(search.cellOf(site).vertices());
      const auto cornersOf = [](const ExactRow& of_site) {
        std::vector<std::array<Label, 3>> corners;
        for (const auto& [a, b, c] : of_site.vertices) {
          auto& corner = corners.emplace_back(
              std::array{of_site.neighbors[a], of_site.neighbors[b], of_site.neighbors[c]});
          std::ranges::rotate(corner, std::ranges::min_element(corner));
        }
        std::ranges::sort(corners);
        return corners;
      };
      EXPECT_EQ(cornersOf(remembers.rowOf(site)), cornersOf(row)) << i;
    }
    EXPECT_GT(remembers.known(), of.size() / 8);
  }
}
TEST(ExactSearch, FindsTheSameCellsAgain) { expectTheSameCellsAgain(false); }
TEST(ExactSearch, FindsTheSameWeighedCellsAgain) { expectTheSameCellsAgain(true); }

// By integers alone, of a thousand sites each: the rows that are certified fulfil C1 to C4, and those who
// have none cut no vertex of them.
TEST(Certificate, RowsWithWeightsAreRightByIntegers) {
  std::mt19937_64 random(20271203);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto u = [&] { return uniform(random); };
  constexpr std::size_t n = 1000;
  struct Input {
    const char* name;
    Sites3 sites;
    std::vector<double> weights;
  };
  std::vector<Input> inputs;
  const auto add = [&](const char* name, const auto& place, const auto& weight) {
    Input& input = inputs.emplace_back(Input{name, {}, {}});
    for (std::size_t i = 0; i < n; ++i) {
      input.sites.push_back(place(i));
      input.weights.push_back(weight(input.sites.back()));
    }
  };
  const auto anywhere = [&](std::size_t) {
    const double x = u(), y = u();
    return Point3{x, y, u()};
  };
  const auto in_lattice = [](std::size_t i) {
    const auto k = static_cast<double>(i);
    return Point3{(std::fmod(k, 10) + 0.5) / 10, (std::fmod(std::floor(k / 10), 10) + 0.5) / 10,
                  (std::floor(k / 100) + 0.5) / 10};
  };
  const auto decimal = [&](std::size_t i) {
    const Point3 p = anywhere(i);
    return Point3{std::round(p.x * 30) / 30, std::round(p.y * 30) / 30, std::round(p.z * 30) / 30};
  };
  const auto near_lattice = [&](std::size_t i) {
    const Point3 p = in_lattice(i);
    return Point3{p.x + 1e-9 * u(), p.y + 1e-9 * u(), p.z + 1e-9 * u()};
  };
  add("moderate", anywhere, [&](const Point3&) { return 0.01 * u(); });
  add("six decades", anywhere, [&](const Point3&) { return 1e-2 * std::pow(10, 6 * u() - 6); });
  add("lattice, few weights", in_lattice, [&](const Point3&) { return std::floor(3 * u()) / 512; });
  add("lattice and noise", near_lattice, [&](const Point3&) { return std::floor(3 * u()) / 512; });
  add("decimals", decimal, [&](const Point3&) { return std::floor(3 * u()) / 900; });
  add("all alike at a point", anywhere, [](const Point3& p) {
    return std::pow(p.x - 0.5, 2) + std::pow(p.y - 0.5, 2) + std::pow(p.z - 0.5, 2);
  });
  for (const Input& input : inputs) {
    SCOPED_TRACE(input.name);
    const Case of(input.sites, {0, 0, 0, 1, 1, 1}, input.weights);
    Diagram3 diagram;
    Records records(of.bins.places(), 1, of.bins.input, input.sites, Detail3::measures, 1, diagram);
    const auto found = certify(of.bins, records, {}, 1);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    const test::ExactSpace exact(of.bins.sites, of.bins.box, of.bins.weights);
    test::LabelRows rows(of.size());
    std::vector<Quadruple> vertices;
    std::vector<Label> without;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Row row = found->rows[i];
      const auto site = static_cast<Label>(i);
      if (row.faces == 0) without.push_back(site);
      for (std::size_t f = 0; f < row.faces; ++f) {
        const Ring ring = row.ring(f);
        for (std::size_t k = 0; k < ring.size(); ++k) {
          rows[i][row.neighbor[f]].push_back(row.neighbor[ring[k]]);
          const Label a = row.neighbor[ring[k]], b = row.neighbor[ring[k + 1 == ring.size() ? 0 : k + 1]];
          if (row.neighbor[f] < a && row.neighbor[f] < b) vertices.push_back({site, row.neighbor[f], a, b});
        }
      }
    }
    EXPECT_EQ(test::brokenConditions(exact, rows), Conditions{});
    constexpr std::size_t most = 12;
    std::ranges::shuffle(without, random);
    if (without.size() > most) without.resize(most);
    for (const Label site : without) {
      for (const auto& [i, j, k, l] : vertices) ASSERT_FALSE(exact.cuts(i, j, k, l, site)) << site;
    }
    if (input.name == std::string("moderate")) {
      EXPECT_EQ(without.size(), most);
    }
  }
}

TEST(SiteBins, OfPlacesFarAwayAreTheLast) {
  Sites3 sites = generate(Pattern3::random, 1000, 1);
  for (Point3& p : sites) p = {1e-12 * p.x, 1e-12 * p.y, 1e-12 * p.z};
  const SiteBins bins = binSites(sites, {-1, -1, -1, 1, 1, 1}, 1);
  EXPECT_GT(bins.count[0], 4);
  EXPECT_EQ(bins.binOf({1, -1, 1e100}), (std::array{bins.count[0] - 1, 0, bins.count[2] - 1}));
}

// The product of such extents is less than any double.
TEST(SiteBins, AreManyAlongAThinLine) {
  Sites3 sites;
  for (int k = 0; k < 1000; ++k) sites.push_back({k / 1000.0, 1e-200 * (k % 7), 1e-190 * (k % 3)});
  EXPECT_GT(binSites(sites, {0, 0, 0, 1, 1, 1}, 1).bins(), 200U);
}

}  // namespace
}  // namespace vorpipe::space
