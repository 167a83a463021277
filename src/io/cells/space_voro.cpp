// Cells in space as lines of text that Voro++'s codes describe.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/try.h"
#include "io/base/attribute.h"
#include "io/base/error.h"
#include "io/base/print.h"
#include "io/base/quoted.h"
#include "io/cells/space_writers.h"

namespace vorpipe {
namespace {

constexpr std::string_view voro_codes = "iqxyzrwpPomgEseFAaftlnvcC";
constexpr std::string_view voro_usual = "%i %q %v", voro_with_radii = "%i %q %v %r";

double lengthOf(const Point3& p) { return std::hypot(p.x, p.y, p.z); }
Point3 minus(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

/// A cell, with what several codes need.
struct VoroCell {
  const SpaceOutput& output;
  std::size_t site;
  std::vector<std::uint32_t> corners{};  ///< its vertices, ascending

  [[nodiscard]] std::uint64_t begin() const { return output.diagram.face_offsets[site]; }
  [[nodiscard]] std::uint64_t end() const { return output.diagram.face_offsets[site + 1]; }
  [[nodiscard]] std::size_t faces() const { return end() - begin(); }
  [[nodiscard]] std::span<const std::uint32_t> ring(std::size_t face) const {
    return ringOf(output.diagram, begin() + face);
  }
  [[nodiscard]] const Point3& place(std::uint32_t vertex) const { return output.diagram.vertices[vertex]; }
  [[nodiscard]] std::size_t corner(std::uint32_t vertex) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(corners, vertex) - corners.begin());
  }
  [[nodiscard]] double perimeter(std::size_t face) const {
    const auto around = ring(face);
    double sum = 0;
    for (std::size_t k = 0; k < around.size(); ++k)
      sum += lengthOf(minus(place(around[k]), place(around[(k + 1) % around.size()])));
    return sum;
  }
  [[nodiscard]] std::size_t sides() const {
    std::size_t count = 0;
    for (std::size_t face = 0; face < faces(); ++face) count += ring(face).size();
    return count;
  }
};

Point3 normalOf(const VoroCell& cell, std::size_t face) {
  const std::int64_t neighbor = cell.output.diagram.neighbors[cell.begin() + face];
  if (!isWall(neighbor)) {
    const Point3 d =
        minus(cell.output.sites[static_cast<std::size_t>(neighbor)], cell.output.sites[cell.site]);
    const double length = lengthOf(d);
    return {d.x / length, d.y / length, d.z / length};
  }
  switch (static_cast<Wall>(neighbor)) {
    case Wall::xmin:
      return {-1, 0, 0};
    case Wall::xmax:
      return {1, 0, 0};
    case Wall::ymin:
      return {0, -1, 0};
    case Wall::ymax:
      return {0, 1, 0};
    case Wall::zmin:
      return {0, 0, -1};
    default:
      return {0, 0, 1};
  }
}

/// Voro++'s number of a neighbor: walls are -1 to -6 in the order of the axes.
std::int64_t voroNeighbor(std::int64_t neighbor) {
  if (neighbor == static_cast<std::int64_t>(Wall::zmin)) return -5;
  if (neighbor == static_cast<std::int64_t>(Wall::zmax)) return -6;
  return neighbor;
}

void printPlace(Bytes& text, const Point3& p) { print(text, FMT_COMPILE("{} {} {}"), p.x, p.y, p.z); }
void printInBrackets(Bytes& text, const Point3& p) { print(text, FMT_COMPILE("({},{},{})"), p.x, p.y, p.z); }

/// Prints a site's name, or its number.
void printSite(Bytes& text, const SpaceOutput& output, std::size_t site) {
  if (output.names == nullptr) {
    print(text, FMT_COMPILE("{}"), site);
  } else {
    text.append(output.names->at(site).value_or(std::string_view("-")));
  }
}

template <class Put>
void printFaces(Bytes& text, const VoroCell& cell, const Put& put) {
  join(text, cell.faces(), " ", [&](Bytes& to, std::size_t face) { put(to, face); });
}

/// Numbers of faces by their numbers of edges, from 0 up.
std::vector<std::size_t> faceOrders(const VoroCell& cell) {
  std::vector<std::size_t> counts;
  for (std::size_t face = 0; face < cell.faces(); ++face) {
    const std::size_t sides = cell.ring(face).size();
    counts.resize(std::max(counts.size(), sides + 1));
    ++counts[sides];
  }
  return counts;
}

/// Numbers of edges that meet in each corner.
std::vector<std::size_t> cornerOrders(const VoroCell& cell) {
  std::vector<std::size_t> orders(cell.corners.size());
  for (std::size_t face = 0; face < cell.faces(); ++face) {
    for (const std::uint32_t vertex : cell.ring(face)) ++orders[cell.corner(vertex)];
  }
  return orders;
}

double farthestSquared(const VoroCell& cell) {
  double most = 0;
  for (const std::uint32_t vertex : cell.corners) {
    const Point3 d = minus(cell.place(vertex), cell.output.sites[cell.site]);
    most = std::max(most, d.x * d.x + d.y * d.y + d.z * d.z);
  }
  return most;
}

double edgeLength(const VoroCell& cell) {
  double twice = 0;
  for (std::size_t face = 0; face < cell.faces(); ++face) twice += cell.perimeter(face);
  return twice / 2;
}

/// The face's corners as Voro++ has them: clockwise seen from outside.
void printRing(Bytes& text, const VoroCell& cell, std::size_t face) {
  const auto ring = cell.ring(face);
  text.push_back('(');
  join(text, ring.size(), ",", [&](Bytes& to, std::size_t k) {
    print(to, FMT_COMPILE("{}"), cell.corner(ring[ring.size() - 1 - k]));
  });
  text.push_back(')');
}

void printCounts(Bytes& text, const std::vector<std::size_t>& counts) {
  join(text, counts.size(), " ", [&](Bytes& to, std::size_t k) { print(to, FMT_COMPILE("{}"), counts[k]); });
}

void printCorners(Bytes& text, const VoroCell& cell, const Point3& origin) {
  join(text, cell.corners.size(), " ",
       [&](Bytes& to, std::size_t k) { printInBrackets(to, minus(cell.place(cell.corners[k]), origin)); });
}

void printNumber(Bytes& text, double number) { print(text, FMT_COMPILE("{}"), number); }
void printCount(Bytes& text, std::size_t count) { print(text, FMT_COMPILE("{}"), count); }

/// Prints codes of the cell as a whole; returns whether the code is one of them.
bool printOfCell(Bytes& text, const VoroCell& cell, char code) {
  const SpaceOutput& output = cell.output;
  const Point3& at = output.sites[cell.site];
  switch (code) {
    case 'i':
      return printSite(text, output, cell.site), true;
    case 'q':
      return printPlace(text, at), true;
    case 'x':
      return printNumber(text, at.x), true;
    case 'y':
      return printNumber(text, at.y), true;
    case 'z':
      return printNumber(text, at.z), true;
    case 'r':
      return printNumber(text, output.weights.empty() ? 0.0 : std::sqrt(output.weights[cell.site])), true;
    case 'w':
      return printCount(text, cell.corners.size()), true;
    case 'm':
      return printNumber(text, farthestSquared(cell)), true;
    case 'g':
      return printCount(text, cell.sides() / 2), true;
    case 'E':
      return printNumber(text, edgeLength(cell)), true;
    case 's':
      return printCount(text, cell.faces()), true;
    case 'F':
      return printNumber(text, output.diagram.surface[cell.site]), true;
    case 'v':
      return printNumber(text, output.diagram.volume[cell.site]), true;
    case 'c':
      return printPlace(text, minus(output.diagram.centroid[cell.site], at)), true;
    case 'C':
      return printPlace(text, output.diagram.centroid[cell.site]), true;
    default:
      return false;
  }
}

/// Prints codes of its corners and faces.
void printOfFaces(Bytes& text, const VoroCell& cell, char code) {
  const Diagram3& d = cell.output.diagram;
  switch (code) {
    case 'p':
      return printCorners(text, cell, cell.output.sites[cell.site]);
    case 'P':
      return printCorners(text, cell, {0, 0, 0});
    case 'o':
      return printCounts(text, cornerOrders(cell));
    case 'A':
      return printCounts(text, faceOrders(cell));
    case 'a':
      return printFaces(text, cell,
                        [&](Bytes& to, std::size_t face) { printCount(to, cell.ring(face).size()); });
    case 'e':
      return printFaces(text, cell,
                        [&](Bytes& to, std::size_t face) { printNumber(to, cell.perimeter(face)); });
    case 'f':
      return printFaces(text, cell, [&](Bytes& to, std::size_t face) {
        printNumber(to, d.face_areas[cell.begin() + face]);
      });
    case 't':
      return printFaces(text, cell, [&](Bytes& to, std::size_t face) { printRing(to, cell, face); });
    case 'l':
      return printFaces(text, cell,
                        [&](Bytes& to, std::size_t face) { printInBrackets(to, normalOf(cell, face)); });
    default:  // 'n'
      return printFaces(text, cell, [&](Bytes& to, std::size_t face) {
        const std::int64_t neighbor = d.neighbors[cell.begin() + face];
        if (isWall(neighbor)) return print(to, FMT_COMPILE("{}"), voroNeighbor(neighbor));
        printSite(to, cell.output, static_cast<std::size_t>(neighbor));
      });
  }
}

void printVoroLine(Bytes& text, const SpaceOutput& output, std::string_view format, std::size_t site) {
  if (!isPolyhedron(output.diagram, site)) return;
  VoroCell cell{output, site};
  takeCorners(output.diagram, site, cell.corners);
  for (std::size_t k = 0; k < format.size(); ++k) {
    const bool code =
        format[k] == '%' && k + 1 < format.size() && voro_codes.find(format[k + 1]) != std::string_view::npos;
    if (!code) {
      text.push_back(format[k]);
    } else if (!printOfCell(text, cell, format[++k])) {
      printOfFaces(text, cell, format[k]);
    }
  }
  text.push_back('\n');
}

}  // namespace

tl::expected<void, std::string> checkVoroFormat(std::string_view format) {
  bool any = false;
  for (std::size_t k = format.find('%'); k != std::string_view::npos; k = format.find('%', k + 2)) {
    any = true;
    const std::string_view code = format.substr(k, 2);
    if (code.size() == 2 && voro_codes.find(code[1]) != std::string_view::npos) continue;
    std::string known;
    for (const char letter : voro_codes) known += fmt::format("{}%{}", known.empty() ? "" : " ", letter);
    return tl::unexpected(fmt::format("{} is no code of Voro++; they are {}", inQuotes(code), known));
  }
  if (!any) return tl::unexpected(inQuotes(format) + " has no code, such as %i or %v");
  return {};
}

Result<void> writeSpaceVoro(ByteSink& sink, const SpaceOutput& output) {
  std::string_view format = output.voro_format;
  if (format.empty()) format = output.weights.empty() ? voro_usual : voro_with_radii;
  if (format.find("%r") != std::string_view::npos) {
    const auto negative = std::ranges::find_if(output.weights, [](double weight) { return weight < 0; });
    if (negative != output.weights.end()) {
      return inputError(fmt::format("{}: %r is a radius, and the weight {} of site {} is of none",
                                    sink.name(), *negative, negative - output.weights.begin()));
    }
  }
  return writeEach(
      sink, output.sites.size(),
      [&](Bytes& text, std::size_t site) { printVoroLine(text, output, format, site); }, output.threads);
}

}  // namespace vorpipe
