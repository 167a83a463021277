// Ties: what remains of the certified cells, against the definition by exact lengths, maps and loops.
#include "space/contraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "space/edge_length.h"
#include "space/ring_walk.h"
#include "space/short_edges.h"
#include "unit/space/proved_run.h"

namespace vorpipe::test {
namespace {

using space::RingStep;

constexpr double tie = 1e-6;

// Rings

std::vector<std::uint32_t> shortened(const std::vector<std::uint32_t>& ring,
                                     std::set<std::set<std::uint32_t>>* ones = nullptr) {
  std::vector<RingStep> steps;
  for (std::uint32_t k = 0; k < ring.size(); ++k) steps.push_back({k, ring[k]});
  space::shorten(steps, [&](const RingStep& a, const RingStep& b) {
    if (ones != nullptr) ones->insert({a.edge_end, b.edge_end});
  });
  std::vector<std::uint32_t> result;
  for (const auto& step : steps) result.push_back(step.to);
  return result;
}

std::vector<std::uint32_t> fromLeast(std::vector<std::uint32_t> ring) {
  std::ranges::rotate(ring, std::ranges::min_element(ring));
  return ring;
}

TEST(Ring, losesWhatGoesStraightBack) {
  EXPECT_EQ(shortened({1, 2, 3}), (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(shortened({}), std::vector<std::uint32_t>{});
  // A spur 3 - 4 - 3 in the ring 1 2 3; its two edges are one.
  std::set<std::set<std::uint32_t>> ones;
  EXPECT_EQ(fromLeast(shortened({1, 2, 3, 4, 3}, &ones)), (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(ones, (std::set<std::set<std::uint32_t>>{{3, 4}}));
  ones.clear();
  EXPECT_TRUE(shortened({1, 2}, &ones).empty());
  EXPECT_EQ(ones, (std::set<std::set<std::uint32_t>>{{0, 1}}));
  EXPECT_TRUE(shortened({1, 2, 3, 2}).empty()) << "a tree has no inside";
  EXPECT_EQ(fromLeast(shortened({5, 1, 6, 2, 5, 2})), (std::vector<std::uint32_t>{1, 6, 2, 5}));
  EXPECT_EQ(shortened({1, 2, 3, 1, 4, 5}).size(), 6U) << "it is pinched, and both parts remain";
}

TEST(Ring, losesTheSameWhereverItBeginsAndInBothDirections) {
  std::mt19937 random(11);
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::uint32_t> ring;
    const std::size_t size = 2 + random() % 9;
    while (ring.size() < size || ring.front() == ring.back()) {
      const auto next = static_cast<std::uint32_t>(random() % 5);
      if (ring.empty() || ring.back() != next) ring.push_back(next);
    }
    const auto once = shortened(ring);
    EXPECT_EQ(shortened(once), once);
    EXPECT_TRUE(once.empty() || once.size() >= 3);
    // A closed walk, whatever its start: all its rotations, of which the least stands for it.
    const auto canonical = [](std::vector<std::uint32_t> walk) {
      auto least = walk;
      for (std::size_t k = 0; k < walk.size(); ++k) {
        std::ranges::rotate(walk, walk.begin() + 1);
        least = std::min(least, walk);
      }
      return least;
    };
    for (std::size_t k = 0; k < ring.size(); ++k) {
      std::ranges::rotate(ring, ring.begin() + 1);
      EXPECT_EQ(canonical(shortened(ring)), canonical(once));
    }
    std::ranges::reverse(ring);
    auto back = shortened(ring);
    std::ranges::reverse(back);
    EXPECT_EQ(canonical(back), canonical(once));
  }
}

// Lengths

/// Each edge of a diagram once, as its labels and those of its ends, with its exact length.
template <class Each>
void forEdges(const ExactSpace& exact, const LabelRows& rows, const Each& each) {
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const auto i = static_cast<Label>(s);
    for (const auto& [j, ring] : rows[s]) {
      const std::size_t n = ring.size();
      for (std::size_t k = 0; k < n; ++k) {
        const Label a = ring[(k + n - 1) % n], b = ring[k], c = ring[(k + 1) % n];
        if (b < j || (j >= 0 && j < i) || (b >= 0 && b < i)) continue;
        const auto way = exact.place(i, j, b, c) - exact.place(i, j, a, b);
        each(i, j, b, a, c, static_cast<double>(sqrt(dot(way, way))));
      }
    }
  }
}

std::vector<Point3> latticeSites(int side, double noise, unsigned seed, bool centered) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> moved(-noise, noise);
  std::vector<Point3> sites;
  for (int a = 0; a < side; ++a) {
    for (int b = 0; b < side; ++b) {
      for (int c = 0; c < side; ++c) {
        for (int e = 0; e < (centered ? 2 : 1); ++e) {
          const double at = centered ? .25 + .5 * e : .5;
          sites.push_back({(a + at + moved(random)) / side, (b + at + moved(random)) / side,
                           (c + at + moved(random)) / side});
        }
      }
    }
  }
  return sites;
}

std::vector<Point3> sphereSites(std::size_t count, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> moved(-noise, noise);
  std::vector<Point3> sites;
  for (std::size_t k = 0; k < count; ++k) {
    const Point3 q{normal(random), normal(random), normal(random)};
    const double part = .3 / std::hypot(q.x, q.y, q.z);
    sites.push_back(
        {.5 + part * q.x + moved(random), .5 + part * q.y + moved(random), .5 + part * q.z + moved(random)});
  }
  return sites;
}

/// Pairs and triples of sites close to one another.
std::vector<Point3> closeSites(double apart, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> inside(.2, .8), moved(-apart, apart);
  std::vector<Point3> sites;
  for (int k = 0; k < 14; ++k) {
    const Point3 p{inside(random), inside(random), inside(random)};
    for (int copy = 0; copy < 1 + k % 3; ++copy)
      sites.push_back({p.x + moved(random), p.y + moved(random), p.z + moved(random)});
  }
  return sites;
}

struct Input {
  Input(std::string its_name, std::vector<Point3> its_sites)
      : name(std::move(its_name)), sites(std::move(its_sites)), exact(sites, unit_box), rows(rowsOf(exact)) {}
  std::string name;
  std::vector<Point3> sites;
  ExactSpace exact;
  LabelRows rows;
};

const std::vector<Input>& inputs() {
  static const std::vector<Input> inputs = [] {
    std::vector<Input> all;
    for (const double noise : {0., 1e-15, 1e-12, 1e-9, 3e-8, 3e-7, 1e-6, 3e-6}) {
      const std::string by = " with noise " + std::to_string(noise * 1e9) + "e-9";
      all.emplace_back("cubic" + by, latticeSites(3, noise, 21, false));
      all.emplace_back("body-centered" + by, latticeSites(2, noise, 22, true));
      all.emplace_back("sphere" + by, sphereSites(30, noise, 23));
    }
    for (const double apart : {1e-8, 1e-10, 1e-12, 1e-14})
      all.emplace_back("pairs " + std::to_string(apart * 1e14) + "e-14 apart", closeSites(apart, 24));
    std::mt19937_64 random(61);
    std::uniform_real_distribution<double> far(-6, 7);
    std::vector<Point3> outside(40);
    for (auto& p : outside) p = {far(random), far(random), far(random)};
    all.emplace_back("outside", outside);
    return all;
  }();
  return inputs;
}

TEST(EdgeLength, isRightToAMillionthHoweverShort) {
  for (const auto& [name, sites, exact, rows] : inputs()) {
    SCOPED_TRACE(name);
    const space::Places places{sites.data(), unit_box};
    forEdges(exact, rows, [&](Label i, Label j, Label k, Label l, Label m, double length) {
      const double fine = 1e-30;
      const double found = space::edgeLength(places, i, j, k, l, m, fine);
      EXPECT_NEAR(found, length, 2e-6 * std::max(length, fine));
      EXPECT_EQ(found == 0, length == 0) << found;
    });
  }
}

// The definition

/// The contracted cells, by the text of contraction.h.
class Contracted {
 public:
  using Vertex = std::array<Label, 4>;
  using Edge = std::array<Label, 3>;

  Contracted(const ExactSpace& exact, const LabelRows& rows, const std::vector<Point3>& sites)
      : rows_(rows), sites_(sites) {
    std::map<Edge, double> length;
    forEdges(exact, rows, [&](Label i, Label j, Label k, Label l, Label m, double far) {
      length[sorted<3>({i, j, k})] = far;
      ends_[sorted<3>({i, j, k})] = {sorted<4>({i, j, k, l}), sorted<4>({i, j, k, m})};
    });
    for (const auto& [edge, far] : length) {
      if (far <= 1e-3 * tieOf({edge.begin(), edge.end()})) unite(edge);
    }
    // Faces that vanish make their edges one.
    std::map<Edge, Edge> one;
    const auto rootOf = [&](Edge edge) {
      while (one.contains(edge) && one[edge] != edge) edge = one[edge];
      return edge;
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const auto& [j, ring] : rows[i]) {
        for (const auto& [a, b] : shorten(static_cast<Label>(i), j).second) {
          if (rootOf(a) != rootOf(b)) one[std::max(rootOf(a), rootOf(b))] = std::min(rootOf(a), rootOf(b));
        }
      }
    }
    std::map<Edge, std::set<Label>> around;
    for (const auto& [edge, far] : length) around[rootOf(edge)].insert(edge.begin(), edge.end());
    for (const auto& [edge, far] : length) {
      if (far <= tieOf(around[rootOf(edge)])) ties_.push_back(edge);
    }
    for (const auto& edge : ties_) unite(edge);
    dropStraight();
  }

  /// By face that remains: its ring.
  [[nodiscard]] std::map<Label, std::vector<Vertex>> cell(Label i) {
    std::map<Label, std::vector<Vertex>> faces;
    for (const auto& [j, ring] : rows_[static_cast<std::size_t>(i)]) {
      auto left = shorten(i, j).first;
      if (!left.empty()) faces[j] = std::move(left);
    }
    return faces;
  }

 private:
  template <std::size_t n>
  static std::array<Label, n> sorted(std::array<Label, n> labels) {
    std::ranges::sort(labels);
    return labels;
  }

  Vertex rootOf(Vertex v) {
    while (parent_.contains(v) && parent_[v] != v) v = parent_[v];
    return v;
  }
  void unite(const Edge& edge) {
    const Vertex a = rootOf(ends_[edge].first), b = rootOf(ends_[edge].second);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

  [[nodiscard]] double tieOf(const std::set<Label>& labels) const {
    double least = HUGE_VAL;
    for (const Label a : labels) {
      if (isWallLabel(a)) least = std::min(least, 1.0);
      for (const Label b : labels) {
        if (isWallLabel(a) || isWallLabel(b) || a == b) continue;
        const Point3 &p = sites_[static_cast<std::size_t>(a)], &q = sites_[static_cast<std::size_t>(b)];
        least = std::min(least, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
      }
    }
    return tie * least;
  }

  /// What remains of a ring, and pairs of edges that have become one.
  std::pair<std::vector<Vertex>, std::vector<std::pair<Edge, Edge>>> shorten(Label i, Label j) {
    const auto& ring = rows_[static_cast<std::size_t>(i)].at(j);
    std::vector<std::pair<Edge, Vertex>> steps;
    std::vector<std::pair<Edge, Edge>> ones;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Label next = ring[(k + 1) % ring.size()];
      const Vertex to = rootOf(sorted<4>({i, j, ring[k], next}));
      if (!dropped_.contains(to)) steps.emplace_back(sorted<3>({i, j, ring[k]}), to);
    }
    for (bool changed = true; changed && !steps.empty();) {
      changed = false;
      const std::size_t n = steps.size();
      for (std::size_t k = 0; k < n && !changed; ++k) {
        if (steps[k].second == steps[(k + n - 1) % n].second) {
          steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(k));
          changed = true;
        } else if (steps[(k + 1) % n].second == steps[(k + n - 1) % n].second) {
          ones.emplace_back(steps[k].first, steps[(k + 1) % n].first);
          const auto next = (k + 1) % n;
          steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(std::max(k, next)));
          steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(std::min(k, next)));
          changed = true;
        }
      }
    }
    std::vector<Vertex> left;
    for (const auto& step : steps) left.push_back(step.second);
    return {left, ones};
  }

  void dropStraight() {
    for (;;) {
      std::map<Vertex, std::size_t> most;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        std::map<Vertex, std::size_t> visits;
        for (const auto& [j, ring] : cell(static_cast<Label>(i))) {
          for (const auto& v : ring) ++visits[v];
        }
        for (const auto& [v, count] : visits) most[v] = std::max(most[v], count);
      }
      const std::size_t before = dropped_.size();
      for (const auto& [v, count] : most) {
        if (count < 3) dropped_.insert(v);
      }
      if (dropped_.size() == before) return;
    }
  }

  const LabelRows& rows_;
  const std::vector<Point3>& sites_;
  std::map<Edge, std::pair<Vertex, Vertex>> ends_;
  std::map<Vertex, Vertex> parent_;
  std::vector<Edge> ties_;
  std::set<Vertex> dropped_;
};

Label labelOf(std::int64_t neighbor) {
  for (int wall = 0; wall < space::walls; ++wall) {
    constexpr std::int64_t number[] = {-1, -2, -3, -4, -6, -7};
    if (neighbor == number[wall]) return space::labelOfWall(wall);
  }
  return static_cast<Label>(neighbor);
}

TEST(Contraction, isItsDefinition) {
  std::size_t ties = 0, straight = 0;
  for (const auto& [name, sites, exact, rows] : inputs()) {
    SCOPED_TRACE(name);
    Contracted expected(exact, rows, sites);
    const auto [d, counts] = diagramOf(sites, unit_box, {.threads = 2});
    expectWhole(d);
    ties += counts.edges;
    straight += counts.straight;
    if (counts.finer > 0) continue;
    std::map<std::uint32_t, Contracted::Vertex> vertex_of;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const auto cell = expected.cell(static_cast<Label>(i));
      ASSERT_EQ(cell.size(), d.face_offsets[i + 1] - d.face_offsets[i]) << "cell " << i;
      for (auto f = d.face_offsets[i]; f < d.face_offsets[i + 1]; ++f) {
        const auto found = cell.find(labelOf(d.neighbors[f]));
        ASSERT_NE(found, cell.end()) << "cell " << i << " with " << d.neighbors[f];
        const auto& ring = found->second;
        const auto shown = ringOf(d, f);
        ASSERT_EQ(ring.size(), shown.size()) << "cell " << i << " with " << d.neighbors[f];
        // One of the rotations gives each number the same vertex as in all other rings.
        bool fits = false;
        for (std::size_t turn = 0; turn < ring.size() && !fits; ++turn) {
          fits = true;
          for (std::size_t k = 0; k < ring.size(); ++k) {
            const auto known = vertex_of.find(shown[k]);
            fits = fits && (known == vertex_of.end() || known->second == ring[(k + turn) % ring.size()]);
          }
          for (std::size_t k = 0; fits && k < ring.size(); ++k)
            vertex_of.emplace(shown[k], ring[(k + turn) % ring.size()]);
        }
        EXPECT_TRUE(fits) << "cell " << i << " with " << d.neighbors[f];
      }
    }
  }
  EXPECT_GT(ties, 500U);
  EXPECT_GT(straight, 20U);
}

TEST(Contraction, namesEachShortEdgeOnce) {
  for (const auto& [name, sites, exact, rows] : inputs()) {
    SCOPED_TRACE(name);
    const StoredRows stored(rows);
    const space::Places places{sites.data(), unit_box};
    std::map<std::array<Label, 3>, double> expected;
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < sites.size(); ++i) all.push_back(i);
    forEdges(exact, rows, [&](Label i, Label j, Label k, Label, Label, double length) {
      std::array<Label, 3> labels{i, j, k};
      std::ranges::sort(labels);
      const double part = length / space::tieOf(places, labels);
      if (part <= 1) expected[labels] = part;
    });
    const auto edges = space::shortEdges(places, stored.rows(), all, 2);
    EXPECT_EQ(edges.size(), expected.size());
    for (const auto& edge : edges) {
      const auto row = stored.rows()[static_cast<std::size_t>(edge.site)];
      const auto around = space::edgeAround(row, edge.edge_end);
      std::array<Label, 3> labels{edge.site, row.neighbor[around.face], row.neighbor[around.other]};
      std::ranges::sort(labels);
      ASSERT_TRUE(expected.contains(labels));
      EXPECT_NEAR(edge.part, expected[labels], 1e-4 * 1e-3 + 3e-6 * edge.part);
    }
  }
}

// Where the threshold matters

/// Sites whose labels around the edge along z are a, b, c, d, on a circle; the edge is `length` long. b c and
/// c d are 0.1 apart, b d 0.2, the others about 1. `out` moves c off the circle, less than a tie, so that a c
/// or b d are neighbors in the simple complex.
std::vector<Point3> fourAround(double length, double out) {
  const double radius = .6;
  const auto onCircle = [&](double degrees, double moved = 0) {
    const double t = degrees * 3.14159265358979 / 180;
    return Point3{(radius + moved) * std::cos(t), (radius + moved) * std::sin(t), 0};
  };
  const double step = 2 * std::asin(.05 / radius) * 180 / 3.14159265358979;
  std::vector<Point3> sites{onCircle(190), onCircle(20 - step), onCircle(20, out), onCircle(20 + step)};
  const double h = length / 2, far = std::hypot(radius, h);
  sites.push_back({.1, .05, h + std::sqrt(far * far - .0125)});
  sites.push_back({-.1, .03, -h - std::sqrt(far * far - .0109)});
  return sites;
}

/// By site and neighbor, with names that the symmetry keeps: the sizes of rings; and the sites of vertices.
std::pair<std::set<std::vector<std::int64_t>>, std::set<std::vector<std::int64_t>>> namesOf(
    const Diagram3& d, const std::vector<std::int64_t>& name,
    const std::map<std::int64_t, std::int64_t>& wall) {
  const auto named = [&](std::int64_t label) {
    return isWall(label) ? wall.at(label) : name[static_cast<std::size_t>(label)];
  };
  std::set<std::vector<std::int64_t>> faces, vertices;
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (auto f = d.face_offsets[i]; f < d.face_offsets[i + 1]; ++f)
      faces.insert({name[i], named(d.neighbors[f]), static_cast<std::int64_t>(ringOf(d, f).size())});
  }
  for (std::size_t v = 0; v < d.vertices.size(); ++v) {
    std::vector<std::int64_t> sites;
    for (auto s = d.vertex_site_offsets[v]; s < d.vertex_site_offsets[v + 1]; ++s)
      sites.push_back(named(d.vertex_sites[s]));
    std::ranges::sort(sites);
    vertices.insert(std::move(sites));
  }
  return {faces, vertices};
}

/// Expects the same cells for symmetries of the cube (each `step`-th of 48), and for other orders of the
/// sites.
void expectSymmetric(const std::vector<Point3>& sites, const Box3& box, int step = 1) {
  constexpr std::int64_t walls[] = {-1, -2, -3, -4, -6, -7};
  std::pair<std::set<std::vector<std::int64_t>>, std::set<std::vector<std::int64_t>>> first;
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::mt19937 random(31);
  int turn = 0;
  do {
    for (int mirrored = 0; mirrored < 8; ++mirrored, ++turn) {
      if (turn % step != 0) continue;
      const auto turned = [&](const std::array<double, 3>& p) {
        std::array<double, 3> q{};
        for (std::size_t e = 0; e < 3; ++e) q[e] = (mirrored >> e & 1) != 0 ? -p[axes[e]] : p[axes[e]];
        return q;
      };
      std::vector<std::int64_t> name(sites.size());
      std::iota(name.begin(), name.end(), 0);
      std::shuffle(name.begin(), name.end(), random);
      std::vector<Point3> placed;
      for (const auto i : name) {
        const Point3& p = sites[static_cast<std::size_t>(i)];
        const auto q = turned({p.x, p.y, p.z});
        placed.push_back({q[0], q[1], q[2]});
      }
      const auto a = turned({box.xmin, box.ymin, box.zmin}), b = turned({box.xmax, box.ymax, box.zmax});
      std::map<std::int64_t, std::int64_t> wall;
      for (std::size_t e = 0; e < 3; ++e) {
        const bool is_mirrored = (mirrored >> e & 1) != 0;
        wall[walls[2 * e]] = walls[2 * axes[e] + (is_mirrored ? 1 : 0)];
        wall[walls[2 * e + 1]] = walls[2 * axes[e] + (is_mirrored ? 0 : 1)];
      }
      const Box3 placed_box{std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2]),
                            std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
      const auto names =
          namesOf(diagramOf(placed, placed_box, {.order = static_cast<unsigned>(turn)}).diagram, name, wall);
      if (turn == 0) {
        first = names;
      } else {
        EXPECT_EQ(names, first) << "turn " << turn;
      }
    }
  } while (std::ranges::next_permutation(axes).found);
}

TEST(Contraction, takesTheLeastDistanceOfAllSitesAroundAnEdge) {
  constexpr Box3 box{-1, -1, -1, 1, 1, 1};
  // By the three sites of b d's triangles alone an edge of 1.5e-7 would be a tie, by those of a c's it would
  // not.
  for (const double out : {1e-13, -1e-13}) {
    for (const auto& [length, vertices] :
         {std::pair(.5e-7, 1), {.9e-7, 1}, {1.1e-7, 2}, {1.5e-7, 2}, {2.5e-7, 2}}) {
      SCOPED_TRACE(std::to_string(length * 1e7) + "e-7, " + std::to_string(out * 1e13));
      const auto sites = fourAround(length, out);
      const auto d = diagramOf(sites, box).diagram;
      expectWhole(d);
      int near = 0;
      for (const auto& p : d.vertices) near += std::hypot(p.x, p.y, p.z) < 1e-3;
      EXPECT_EQ(near, vertices);
      if (length == 1.5e-7) expectSymmetric(sites, box);
    }
  }
}

TEST(Contraction, fromWallToWallIsOnTheEdgeOfTheBox) {
  // The bisectors of three sites outside meet in a line that cuts an edge of the box off, by 3.5e-8.
  const double off = 3.5e-8 / std::sqrt(2.), r = 3, turn = .01;
  const auto site = [&](double along, double z) {
    return Point3{(off + along) / std::sqrt(2.), (off + along) / std::sqrt(2.), .5 + z};
  };
  const std::vector<Point3> sites{site(-r, 0), site(r * std::cos(turn), r * std::sin(turn)),
                                  site(r * std::cos(turn), -r * std::sin(turn))};
  const auto d = diagramOf(sites, unit_box).diagram;
  expectWhole(d);
  std::size_t found = 0;
  for (std::size_t v = 0; v < d.vertices.size(); ++v) {
    const std::vector<std::int64_t> labels(
        d.vertex_sites.begin() + static_cast<std::ptrdiff_t>(d.vertex_site_offsets[v]),
        d.vertex_sites.begin() + static_cast<std::ptrdiff_t>(d.vertex_site_offsets[v + 1]));
    if (labels != std::vector<std::int64_t>{wall_ymin, wall_xmin, 1, 2}) continue;
    ++found;
    EXPECT_EQ(d.vertices[v].x, 0);
    EXPECT_EQ(d.vertices[v].y, 0);
    EXPECT_NEAR(d.vertices[v].z, .5, 1e-12);
  }
  EXPECT_EQ(found, 1U);
  EXPECT_EQ(d.status[0], Status::empty) << "of its faces none has an inside";
}

TEST(Contraction, isTheSameForMirrorsAndOrders) {
  const auto centered = [](std::vector<Point3> sites) {
    for (auto& p : sites) p = {p.x - .5, p.y - .5, p.z - .5};
    return sites;
  };
  constexpr Box3 box{-.5, -.5, -.5, .5, .5, .5};
  expectSymmetric(centered(latticeSites(2, 0, 41, true)), box, 5);
  expectSymmetric(centered(latticeSites(2, 2e-7, 42, true)), box, 5);
  expectSymmetric(centered(latticeSites(3, 1e-15, 43, false)), box, 5);
  expectSymmetric(centered(sphereSites(16, 0, 44)), box, 5);
  expectSymmetric(centered(sphereSites(16, 3e-7, 45)), box, 5);
}

TEST(Contraction, ofASphereAtTheThresholdHasNoRingTwiceAtAVertex) {
  // Noise of a tie about the center of a sphere: where only lengths are looked at, rings visit vertices
  // twice.
  std::uint64_t finer = 0;
  for (unsigned seed = 121; seed < 133; ++seed) {
    SCOPED_TRACE(seed);
    const auto [d, counts] = diagramOf(sphereSites(40, 3e-7, seed), unit_box);
    expectWhole(d);
    finer += counts.finer;
  }
  EXPECT_GT(finer, 0U) << "vertices as wide as the noise are made narrower";
}

TEST(Contraction, ofAStackLeavesAFlatCellWithItsNeighbors) {
  // Three sites on a line, 0.9e-6 of the distance of the others apart.
  auto sites = latticeSites(3, 1e-2, 51, false);
  const Point3 middle = sites[13];
  sites.push_back({middle.x - .3e-6, middle.y, middle.z});
  sites.push_back({middle.x + .3e-6, middle.y, middle.z});
  const auto [d, counts] = diagramOf(sites, unit_box);
  expectWhole(d);
  EXPECT_EQ(counts.flat, 1U);
  EXPECT_EQ(d.flat, 1U);
  EXPECT_EQ(d.status[13], Status::ok);
  EXPECT_EQ(neighborsOf(d, 13), (std::vector<std::int64_t>{27, 28}));
  EXPECT_GT(d.volume[13], 0);
  EXPECT_GE(neighborsOf(d, 27).size(), 4U);
  expectSymmetric(sites, unit_box, 11);
}

// Measures

TEST(Measures, areExactHoweverBadlyConditionedTheVerticesAre) {
  for (const auto& [name, sites, exact, rows] : inputs()) {
    SCOPED_TRACE(name);
    const StoredRows stored(rows);
    const space::Places places{sites.data(), unit_box};
    space::CarefulMeasures careful(places);
    double sum = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (rows[i].empty()) continue;
      careful.measure(static_cast<Label>(i), stored.rows()[i]);
      const auto expected = exactMeasures(exact, static_cast<Label>(i), rows[i]);
      const auto& found = careful.measures();
      sum += found.volume;
      EXPECT_NEAR(found.volume, static_cast<double>(expected.volume), 1e-14);
      EXPECT_NEAR(found.surface, static_cast<double>(expected.surface), 1e-13);
      std::size_t face = 0;
      for (const auto& [neighbor, area] : expected.area)
        EXPECT_NEAR(careful.areas()[face++], static_cast<double>(area), 1e-13);
      for (std::size_t e = 0; e < 6; ++e)
        EXPECT_NEAR(careful.secondMoments()[e], static_cast<double>(expected.moments[e]), 1e-14);
      if (expected.volume < 1e-3) continue;
      EXPECT_NEAR(found.centroid.x, static_cast<double>(expected.centroid[0]), 1e-13);
      EXPECT_NEAR(found.centroid.y, static_cast<double>(expected.centroid[1]), 1e-13);
      EXPECT_NEAR(found.centroid.z, static_cast<double>(expected.centroid[2]), 1e-13);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

}  // namespace
}  // namespace vorpipe::test
