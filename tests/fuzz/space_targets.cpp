/// Sites in space: whole runs beside the checks and beside another order of the sites; and their files.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "byte_stream.h"
#include "io/sites/space_source.h"
#include "session.h"
#include "target.h"

namespace vorpipe::fuzz {
namespace {

constexpr std::size_t most_sites_in_space = 24;
constexpr Point3 middle{0.5, 0.5, 0.5};

/// A few steps of a double, or a part of the whole: what rounding makes of coordinates.
double hairOf(ByteStream& stream) {
  constexpr std::array<double, 4> steps{0x1p-53, 0x1p-43, 0x1p-30, 0x1p-70};
  const double step = steps[stream.choice(steps.size())];
  return stream.take<std::int8_t>() * step;
}

Point3 nextTo(const Point3& p, ByteStream& stream) {
  const double dx = hairOf(stream), dy = hairOf(stream);
  return {p.x + dx, p.y + dy, p.z + hairOf(stream)};
}

/// A site, often one that has ties with those before: at the same place or beside it, on a wall, or at the
/// same distance from the middle.
Point3 siteIn(ByteStream& stream, const Sites3& before) {
  const std::size_t kind = stream.choice(16);
  if (before.empty() || kind < 6) {
    const double x = stream.number(), y = stream.number();
    return {x, y, stream.number()};
  }
  const Point3 p = before[stream.choice(before.size())];
  if (kind == 6) return p;
  if (kind < 9) return nextTo(p, stream);
  if (kind < 11) {
    std::array<double, 3> to{p.x, p.y, p.z};
    to[stream.choice(to.size())] = stream.flag() ? 1 : 0;
    return {to[0], to[1], to[2]};
  }
  const std::size_t how = stream.choice(48);
  std::array<double, 3> from{p.x - middle.x, p.y - middle.y, p.z - middle.z};
  for (std::size_t axis = 0; axis < from.size(); ++axis) from[axis] *= (how >> axis & 1U) != 0 ? -1 : 1;
  std::rotate(from.begin(), from.begin() + how / 8 % 3, from.end());
  if (how >= 24) std::swap(from[0], from[1]);
  const Point3 mirrored{middle.x + from[0], middle.y + from[1], middle.z + from[2]};
  return kind < 14 ? mirrored : nextTo(mirrored, stream);
}

Sites3 crystalIn(ByteStream& stream) {
  constexpr std::array patterns{Pattern3::cubic, Pattern3::bcc, Pattern3::fcc,   Pattern3::diamond,
                                Pattern3::a15,   Pattern3::hcp, Pattern3::random};
  const Pattern3 pattern = patterns[stream.choice(patterns.size())];
  Sites3 sites = generate(pattern, 1 + stream.choice(30), 1);
  if (stream.flag())
    for (Point3& p : sites) p = nextTo(p, stream);
  return sites;
}

struct SpaceInput {
  Sites3 sites;
  Cells3Options options{{0, 0, 0, 1, 1, 1}, Detail3::polyhedra, {}};
};

/// Scales and moves all.
void place(ByteStream& stream, SpaceInput& input) {
  const std::size_t kind = stream.choice(8);
  if (kind < 4) return;
  const int exponent = kind == 4 ? 3 * stream.take<std::int8_t>() : 0;
  const double flat = kind == 5 ? std::ldexp(1.0, -static_cast<int>(stream.choice(48))) : 1;
  Point3 by{};
  if (kind > 5) {
    const int size = static_cast<int>(stream.choice(54));
    by = {std::ldexp(stream.number(), size), std::ldexp(stream.number(), size), 0};
  }
  const auto to = [&](const Point3& p) {
    return Point3{std::ldexp(p.x + by.x, exponent), std::ldexp(p.y + by.y, exponent),
                  std::ldexp(p.z * flat, exponent)};
  };
  for (Point3& p : input.sites) p = to(p);
  const Box3& box = input.options.domain;
  const Point3 low = to({box.xmin, box.ymin, box.zmin}), high = to({box.xmax, box.ymax, box.zmax});
  input.options.domain = {low.x, low.y, low.z, high.x, high.y, high.z};
}

SpaceInput spaceInputIn(std::string_view bytes) {
  ByteStream stream(bytes);
  SpaceInput input;
  if (stream.choice(4) == 0) input.options.detail = Detail3::measures;
  if (stream.choice(4) == 0) {
    const double xmin = stream.number(), ymin = stream.number(), zmin = stream.number();
    const double xmax = stream.number(), ymax = stream.number();
    input.options.domain = {xmin, ymin, zmin, xmax, ymax, stream.number()};
  }
  if (stream.choice(4) == 0) input.sites = crystalIn(stream);
  const std::size_t placed = stream.choice(2);
  if (placed == 0) place(stream, input);
  while (!stream.atEnd() && input.sites.size() < most_sites_in_space)
    input.sites.push_back(siteIn(stream, input.sites));
  if (placed == 1) {
    ByteStream again(bytes.substr(bytes.size() / 2));
    place(again, input);
  }
  return input;
}

Result<Diagram3> checkedCells(const Sites3& sites, const Cells3Options& options) {
  auto diagram = session().cells(std::span<const Point3>(sites), options);
  if (!diagram) {
    require(diagram.error().code == ErrorCode::input, diagram.error().message);
    require(!diagram.error().message.empty(), "a refusal says why");
    return diagram;
  }
  const auto broken = check(sites, options, *diagram, 1);
  require(broken.has_value(), "cells in space can be checked");
  require(broken->empty(), broken->empty() ? "" : broken->front());
  return diagram;
}

/// The neighbors of a site's cell, by `order` of sites: of those at one place that owns the cell.
std::vector<std::int64_t> neighborsBy(const Diagram3& diagram, std::size_t site,
                                      const std::vector<std::uint32_t>& order) {
  std::vector<std::int64_t> neighbors;
  for (auto f = diagram.face_offsets[site]; f < diagram.face_offsets[site + 1]; ++f) {
    const std::int64_t n = diagram.neighbors[f];
    neighbors.push_back(isWall(n) ? n : static_cast<std::int64_t>(order[static_cast<std::size_t>(n)]));
  }
  std::ranges::sort(neighbors);
  return neighbors;
}

/// Cells do not depend on the order of sites, but for which of those at one place owns the cell.
void requireSameReversed(const SpaceInput& input, const Result<Diagram3>& diagram) {
  const std::size_t count = input.sites.size();
  const auto other = checkedCells({input.sites.rbegin(), input.sites.rend()}, input.options);
  require(other.has_value() == diagram.has_value(), "the order of sites does not decide who is refused");
  if (!diagram) return;
  std::vector<std::uint32_t> own(count), reversed(count);
  for (std::size_t i = 0; i < count; ++i) {
    own[i] = diagram->owner[i];
    reversed[i] = diagram->owner[count - 1 - i];
  }
  require(diagram->flat == other->flat, "the order of sites does not decide what is flat");
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t mine = diagram->owner[i], theirs = other->owner[count - 1 - i];
    require(diagram->status[mine] == other->status[theirs], "the order of sites does not decide a status");
    require(neighborsBy(*diagram, mine, own) == neighborsBy(*other, theirs, reversed),
            "the order of sites does not decide who are neighbors");
  }
}

}  // namespace

void fuzzSpace(std::string_view bytes) {
  const SpaceInput input = spaceInputIn(bytes);
  const auto diagram = checkedCells(input.sites, input.options);
  if (bytes.size() % 2 == 1) requireSameReversed(input, diagram);
}

void fuzzSpaceSites(std::string_view bytes) {
  constexpr std::array<std::string_view, 4> kinds{"csv", "tsv", "txt", "xyz"};
  const std::string_view kind = bytes.starts_with("\x93NUMPY") ? "npy" : kinds[bytes.size() % kinds.size()];
  const std::string& path = fileOf(kind, bytes);
  const auto table = readSpaceSites(path);
  if (!table) return requireTold(table.error(), path);
  require(!table->sites.empty(), "a file without sites is refused");
  for (const Point3& p : table->sites)
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "coordinates are finite");
  for (const Attribute& attribute : table->attributes) {
    require(attribute.size() == table->sites.size(), "attributes are as long as the sites");
    for (std::size_t site = 0; site < attribute.size(); ++site) (void)attribute.at(site);
  }
}

}  // namespace vorpipe::fuzz
