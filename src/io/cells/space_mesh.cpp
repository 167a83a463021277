// Cells in space as meshes: .vtu, .obj, .ply and .stl.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/print.h"
#include "io/cells/space_writers.h"
#include "io/cells/vtk_xml.h"

namespace vorpipe {
namespace {

/// The sites with a polyhedron, in their order.
std::vector<std::uint32_t> polyhedraOf(const Diagram3& diagram) {
  std::vector<std::uint32_t> sites;
  for (std::uint32_t i = 0; i < diagram.size(); ++i) {
    if (isPolyhedron(diagram, i)) sites.push_back(i);
  }
  return sites;
}

/// Numbers that VTK has for the faces of a cell: how many, and for each its size and corners.
std::uint64_t faceNumbers(const Diagram3& d, std::size_t site) {
  const auto begin = d.face_offsets[site], end = d.face_offsets[site + 1];
  return 1 + (end - begin) + d.face_vertex_offsets[end] - d.face_vertex_offsets[begin];
}

void putFaces(Bytes& bytes, const Diagram3& d, std::size_t site) {
  constexpr auto order = std::endian::little;
  const auto begin = d.face_offsets[site], end = d.face_offsets[site + 1];
  appendNumber<order>(bytes, static_cast<std::int64_t>(end - begin));
  for (auto face = begin; face < end; ++face) {
    const auto ring = ringOf(d, face);
    appendNumber<order>(bytes, static_cast<std::int64_t>(ring.size()));
    for (const std::uint32_t v : ring) appendNumber<order>(bytes, static_cast<std::int64_t>(v));
  }
}

/// The arrays that describe polyhedra. They refer to all arguments; `corners` and `numbers` are where those
/// of each cell end.
std::vector<VtkArray> polyhedraArrays(const Diagram3& d, const std::vector<std::uint32_t>& sites,
                                      const std::vector<std::int64_t>& corners,
                                      const std::vector<std::int64_t>& numbers) {
  constexpr std::uint8_t polyhedron = 42;  // VTK_POLYHEDRON
  const auto last = [](const std::vector<std::int64_t>& ends) {
    return ends.empty() ? std::uint64_t{0} : static_cast<std::uint64_t>(ends.back());
  };
  const std::uint64_t count = sites.size();
  std::vector<VtkArray> arrays;
  arrays.push_back({"connectivity", vtkType<std::int64_t>(), 1, count, last(corners) * sizeof(std::int64_t),
                    [&](Bytes& bytes, std::size_t cell) {
                      std::vector<std::uint32_t> points;
                      takeCorners(d, sites[cell], points);
                      for (const std::uint32_t v : points)
                        appendNumber<std::endian::little>(bytes, static_cast<std::int64_t>(v));
                    }});
  arrays.push_back(
      vtkNumbers<std::int64_t>("offsets", count, [&](std::size_t cell) { return corners[cell]; }));
  arrays.push_back(vtkNumbers<std::uint8_t>("types", count, [](std::size_t) { return polyhedron; }));
  arrays.push_back({"faces", vtkType<std::int64_t>(), 1, count, last(numbers) * sizeof(std::int64_t),
                    [&](Bytes& bytes, std::size_t cell) { putFaces(bytes, d, sites[cell]); }});
  arrays.push_back(
      vtkNumbers<std::int64_t>("faceoffsets", count, [&](std::size_t cell) { return numbers[cell]; }));
  return arrays;
}

std::vector<VtkArray> polyhedraData(const SpaceOutput& output, const std::vector<std::uint32_t>& sites) {
  const Diagram3& d = output.diagram;
  const auto numbers = [&](std::string_view name, std::span<const double> by_site) {
    return vtkNumbers<double>(name, sites.size(),
                              [&sites, by_site](std::size_t cell) { return by_site[sites[cell]]; });
  };
  std::vector<VtkArray> data;
  data.push_back(
      vtkNumbers<std::uint32_t>("site", sites.size(), [&](std::size_t cell) { return sites[cell]; }));
  data.push_back(numbers("volume", d.volume));
  data.push_back(numbers("area", d.surface));
  data.push_back(vtkNumbers<std::int64_t>("neighbors", sites.size(), [&](std::size_t cell) {
    return d.face_offsets[sites[cell] + 1] - d.face_offsets[sites[cell]];
  }));
  data.push_back(vtkNumbers<std::uint8_t>("status", sites.size(),
                                          [&](std::size_t cell) { return d.status[sites[cell]]; }));
  data.push_back(
      vtkPoints("centroid", sites.size(), [&](std::size_t cell) { return d.centroid[sites[cell]]; }));
  if (!output.weights.empty()) data.push_back(numbers("weight", output.weights));
  return data;
}

}  // namespace

void takeCorners(const Diagram3& d, std::size_t site, std::vector<std::uint32_t>& points) {
  points.assign(
      d.face_vertices.begin() + static_cast<std::ptrdiff_t>(d.face_vertex_offsets[d.face_offsets[site]]),
      d.face_vertices.begin() + static_cast<std::ptrdiff_t>(d.face_vertex_offsets[d.face_offsets[site + 1]]));
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

Result<void> writeSpaceVtu(ByteSink& sink, const SpaceOutput& output) {
  const Diagram3& d = output.diagram;
  const std::vector<std::uint32_t> sites = polyhedraOf(d);
  std::vector<std::int64_t> corners, numbers;
  std::vector<std::uint32_t> points;
  std::uint64_t corner = 0, number = 0;
  for (const std::uint32_t site : sites) {
    takeCorners(d, site, points);
    corners.push_back(static_cast<std::int64_t>(corner += points.size()));
    numbers.push_back(static_cast<std::int64_t>(number += faceNumbers(d, site)));
  }
  VtkSection places{"Points",
                    {vtkPoints("Points", d.vertices.size(), [&](std::size_t v) { return d.vertices[v]; })}};
  return writeVtkXml(
      sink, {"UnstructuredGrid",
             fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", d.vertices.size(), sites.size()),
             {std::move(places),
              {"Cells", polyhedraArrays(d, sites, corners, numbers)},
              {"CellData", polyhedraData(output, sites)}}});
}

Result<void> writeSpaceObj(ByteSink& sink, const SpaceOutput& output) {
  const Diagram3& d = output.diagram;
  VORPIPE_TRY(sink.write("# Objects are the cells of the sites that have one, in their order.\n"));
  VORPIPE_TRY(writeEach(sink, d.vertices.size(), [&](Bytes& text, std::size_t v) {
    print(text, FMT_COMPILE("v {} {} {}\n"), d.vertices[v].x, d.vertices[v].y, d.vertices[v].z);
  }));
  return writeEach(
      sink, d.size(),
      [&](Bytes& text, std::size_t site) {
        if (!isPolyhedron(d, site)) return;
        print(text, FMT_COMPILE("o cell_{}\n"), site);
        for (auto face = d.face_offsets[site]; face < d.face_offsets[site + 1]; ++face) {
          text.push_back('f');
          for (const std::uint32_t v : ringOf(d, face)) print(text, FMT_COMPILE(" {}"), std::uint64_t{v} + 1);
          text.push_back('\n');
        }
      },
      output.threads);
}

Result<void> writeSpacePly(ByteSink& sink, const SpaceOutput& output) {
  constexpr auto order = std::endian::little;
  const Diagram3& d = output.diagram;
  if (d.vertices.size() > std::numeric_limits<std::int32_t>::max()) {
    return inputError(fmt::format("{}: {} vertices are more than a .ply can count; .vtu can", sink.name(),
                                  d.vertices.size()));
  }
  // Two cells share a face: that of the lower index writes it, and a cell at a wall or beside an image its
  // own.
  const auto isOwn = [&](std::size_t site, std::uint64_t face) {
    const bool is_image =
        !d.neighbor_shifts.empty() && d.neighbor_shifts[face] != std::array<std::int32_t, 3>{};
    return is_image || d.neighbors[face] < 0 || static_cast<std::size_t>(d.neighbors[face]) > site;
  };
  std::uint64_t faces = 0;
  for (std::size_t site = 0; site < d.size(); ++site) {
    for (auto face = d.face_offsets[site]; face < d.face_offsets[site + 1]; ++face)
      faces += isOwn(site, face);
  }
  VORPIPE_TRY(sink.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uint int vertex_indices\nproperty int site\nproperty int neighbor\n"
      "property double area\nend_header\n",
      d.vertices.size(), faces)));
  VORPIPE_TRY(writeEach(sink, d.vertices.size(), [&](Bytes& bytes, std::size_t v) {
    const Point3& p = d.vertices[v];
    for (const double number : {p.x, p.y, p.z}) appendNumber<order>(bytes, number);
  }));
  return writeEach(sink, d.size(), [&](Bytes& bytes, std::size_t site) {
    for (auto face = d.face_offsets[site]; face < d.face_offsets[site + 1]; ++face) {
      if (!isOwn(site, face)) continue;
      const auto ring = ringOf(d, face);
      appendNumber<order>(bytes, static_cast<std::uint32_t>(ring.size()));
      for (const std::uint32_t v : ring) appendNumber<order>(bytes, static_cast<std::int32_t>(v));
      appendNumber<order>(bytes, static_cast<std::int32_t>(site));
      appendNumber<order>(bytes, static_cast<std::int32_t>(d.neighbors[face]));
      appendNumber<order>(bytes, d.face_areas[face]);
    }
  });
}

namespace {

/// A corner of a triangle; .stl has floats.
void putCorner(Bytes& bytes, const Point3& p) {
  for (const double number : {p.x, p.y, p.z})
    appendNumber<std::endian::little>(bytes, static_cast<float>(number));
}

/// A normal of unit length; zero for a triangle without an area.
Point3 unitNormal(const Point3& a, const Point3& b, const Point3& c) {
  const Point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
  const Point3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const double length = std::hypot(n.x, n.y, n.z);
  return length > 0 ? Point3{n.x / length, n.y / length, n.z / length} : Point3{0, 0, 0};
}

}  // namespace

Result<void> writeSpaceStl(ByteSink& sink, const SpaceOutput& output) {
  const Diagram3& d = output.diagram;
  const auto ofCells = [&](std::size_t site, const auto& put) {
    if (!isPolyhedron(d, site)) return;
    for (auto face = d.face_offsets[site]; face < d.face_offsets[site + 1]; ++face) {
      const auto ring = ringOf(d, face);
      for (std::size_t k = 2; k < ring.size(); ++k)
        put(d.vertices[ring[0]], d.vertices[ring[k - 1]], d.vertices[ring[k]]);
    }
  };
  std::uint64_t triangles = 0;
  for (std::size_t site = 0; site < d.size(); ++site)
    ofCells(site, [&](const auto&, const auto&, const auto&) { ++triangles; });
  if (triangles > std::numeric_limits<std::uint32_t>::max()) {
    return inputError(
        fmt::format("{}: {} triangles are more than an .stl can count; .vtu can", sink.name(), triangles));
  }
  constexpr std::size_t header_bytes = 80;
  std::string header = "surfaces of cells in space";  // a binary .stl must not begin with "solid"
  header.resize(header_bytes, ' ');
  Bytes head;
  head.append(header);
  appendNumber<std::endian::little>(head, static_cast<std::uint32_t>(triangles));
  VORPIPE_TRY(writeAll(sink, head));
  return writeEach(sink, d.size(), [&](Bytes& bytes, std::size_t site) {
    ofCells(site, [&](const Point3& a, const Point3& b, const Point3& c) {
      for (const Point3& p : {unitNormal(a, b, c), a, b, c}) putCorner(bytes, p);
      appendNumber<std::endian::little>(bytes, std::uint16_t{0});
    });
  });
}

}  // namespace vorpipe
