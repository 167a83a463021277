#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/base/npy_array.h"
#include "io/cells/cells_mesh.h"
#include "unit/io/cells/cells_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

/// Takes numbers from the front of some bytes.
struct Numbers {
  std::string_view bytes;
  bool big_endian;

  template <class Number>
  Number next() {
    if (bytes.size() < sizeof(Number)) {
      ADD_FAILURE() << "the file ends too early";
      return {};
    }
    const auto number = valueOf<Number>(bytes.data(), big_endian);
    bytes.remove_prefix(sizeof(Number));
    return number;
  }
  template <class Number>
  std::vector<Number> next(std::size_t count) {
    std::vector<Number> numbers(count);
    for (Number& number : numbers) {
      number = next<Number>();
    }
    return numbers;
  }
  /// Checks that `text` comes next.
  void expect(std::string_view text) {
    EXPECT_THAT(std::string(bytes), StartsWith(std::string(text)));
    bytes.remove_prefix(std::min(text.size(), bytes.size()));
  }
};

void expectPoints(Numbers& numbers) {
  for (const Point& point : std::vector<Point>{
           {0, 0}, {third, 0}, {third, tenth}, {third, 1}, {0, 1}, {1, 0}, {1, tenth}, {1, 1}}) {
    EXPECT_THAT(numbers.next<double>(3), ElementsAre(point.x, point.y, 0));
  }
}

TEST_F(CellsFile, ObjSharesVertices) {
  EXPECT_EQ(
      written("c.obj"),
      "# Faces are the cells of the sites that have one, in their order.\n"
      "v 0 0 0\nv 0.3333333333333333 0 0\nv 0.3333333333333333 0.1 0\nv 0.3333333333333333 1 0\nv 0 1 0\n"
      "v 1 0 0\nv 1 0.1 0\nv 1 1 0\n"
      "f 1 2 3 4 5\nf 2 6 7 3\nf 7 8 4 3\n");
}

TEST_F(CellsFile, PlyIsLittleEndian) {
  const std::string bytes = written("c.ply");
  Numbers numbers{bytes, false};
  numbers.expect(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 3\nproperty list uint int vertex_indices\nproperty uint site\nproperty double area\n"
      "end_header\n");
  expectPoints(numbers);
  const Diagram cells = someCells();
  for (const auto& [site, corners] : std::vector<std::pair<std::uint32_t, std::vector<std::int32_t>>>{
           {0, {0, 1, 2, 3, 4}}, {1, {1, 5, 6, 2}}, {4, {6, 7, 3, 2}}}) {
    EXPECT_EQ(numbers.next<std::uint32_t>(), corners.size());
    EXPECT_EQ(numbers.next<std::int32_t>(corners.size()), corners);
    EXPECT_EQ(numbers.next<std::uint32_t>(), site);
    EXPECT_EQ(numbers.next<double>(), cells.area[site]);
  }
  EXPECT_EQ(numbers.bytes.size(), 0u);
}

TEST_F(CellsFile, VtkIsBigEndian) {
  const std::string bytes = written("c.vtk");
  const Diagram cells = someCells();
  Numbers numbers{bytes, true};
  numbers.expect("# vtk DataFile Version 3.0\nvorpipe cells\nBINARY\nDATASET POLYDATA\nPOINTS 8 double\n");
  expectPoints(numbers);
  numbers.expect("\nPOLYGONS 3 16\n");
  EXPECT_THAT(numbers.next<std::int32_t>(16), ElementsAre(5, 0, 1, 2, 3, 4, 4, 1, 5, 6, 2, 4, 6, 7, 3, 2));
  numbers.expect("\nCELL_DATA 3\nSCALARS site unsigned_int 1\nLOOKUP_TABLE default\n");
  EXPECT_THAT(numbers.next<std::uint32_t>(3), ElementsAre(0, 1, 4));
  numbers.expect("\nSCALARS area double 1\nLOOKUP_TABLE default\n");
  EXPECT_THAT(numbers.next<double>(3), ElementsAre(cells.area[0], cells.area[1], cells.area[4]));
  numbers.expect("\nSCALARS perimeter double 1\nLOOKUP_TABLE default\n");
  EXPECT_THAT(numbers.next<double>(3),
              ElementsAre(cells.perimeter[0], cells.perimeter[1], cells.perimeter[4]));
  numbers.expect("\nSCALARS neighbors int 1\nLOOKUP_TABLE default\n");
  EXPECT_THAT(numbers.next<std::int32_t>(3), ElementsAre(5, 4, 4));
  numbers.expect("\nSCALARS status unsigned_char 1\nLOOKUP_TABLE default\n");
  numbers.expect(std::string(3, '\0') + "\n");
  EXPECT_EQ(numbers.bytes.size(), 0u);
}

TEST_F(CellsFile, MeshJoinsWhatIsEqual) {
  auto file = OutputFile::create(path("c.obj"));
  ASSERT_TRUE(file);
  Diagram cells;
  const double next = std::nextafter(1.0, 2.0);
  cells.status = {Status::ok, Status::ok, Status::ok};
  cells.cell_offsets = {0, 3, 5, 9};  // the second has two vertices, which make no polygon
  cells.vertices = {{0, 1}, {1, -0.0}, {next, 1}, {next, 1}, {0, 1}, {-0.0, 1}, {1, 0}, {1, 1}, {1, next}};
  const auto mesh = cellsMesh(*file, cells);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_THAT(mesh->corners, ElementsAre(0, 1, 2, 0, 1, 3, 4));
  EXPECT_THAT(mesh->offsets, ElementsAre(0u, 3u, 7u));
  EXPECT_EQ(mesh->points.size(), 5u);
  EXPECT_THAT(mesh->sites, ElementsAre(0u, 2u));
}

double areaOf(const CellsMesh& mesh, std::size_t face) {
  double twice = 0;
  const auto corners = mesh.cornersOf(face);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point& a = mesh.points[static_cast<std::size_t>(corners[k])];
    const Point& b = mesh.points[static_cast<std::size_t>(corners[(k + 1) % corners.size()])];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

TEST_F(CellsFile, MeshHasEachPieceAndNoHole) {
  auto file = OutputFile::create(path("c.obj"));
  ASSERT_TRUE(file);
  const auto mesh = cellsMesh(*file, cellsInPieces());
  ASSERT_TRUE(mesh) << mesh.error().message;
  // Eight triangles between the square and its hole, the triangle, and the other cell.
  EXPECT_THAT(mesh->sites, ElementsAre(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 1u));
  EXPECT_EQ(mesh->points.size(), 11u);
  std::vector<double> area(2);
  for (std::size_t face = 0; face < mesh->size(); ++face) {
    EXPECT_GT(areaOf(*mesh, face), 0) << face;
    area[mesh->sites[face]] += areaOf(*mesh, face);
  }
  EXPECT_THAT(area, ElementsAre(15.5, 1));
}

TEST_F(CellsFile, MeshFailsWhereRingsAreNoPolygon) {
  auto file = OutputFile::create(path("c.obj"));
  ASSERT_TRUE(file);
  Diagram cells = cellsInPieces();
  cells.vertices[1] = {std::nan(""), 0};
  const auto mesh = cellsMesh(*file, cells);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::device);
  EXPECT_EQ(mesh.error().message,
            path("c.obj") + ": the cell of site 0 has holes, and could not be cut into triangles");
}

TEST_F(CellsFile, ObjGroupsThePiecesOfACell) {
  const std::string text = written("c.obj", sitesInPieces(), cellsInPieces());
  EXPECT_THAT(text, StartsWith("# Faces are pieces of cells; the group is the cell's site.\nv "));
  const auto first = text.find("\ng site_0\nf "), second = text.find("\ng site_1\nf ");
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
  EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(first),
                       text.begin() + static_cast<std::ptrdiff_t>(second), 'f'),
            9);
}

TEST_F(CellsFile, MeshJoinsManyPoints) {
  auto file = OutputFile::create(path("c.obj"));
  ASSERT_TRUE(file);
  constexpr std::size_t side = 300;
  Diagram cells;
  cells.cell_offsets = {0};
  for (std::size_t i = 0; i < side * side; ++i) {
    const double x = static_cast<double>(i % side) * 0x1p-9, y = static_cast<double>(i / side) * 0x1p-9;
    for (const Point& vertex : {Point{x, y}, {x + 0x1p-9, y}, {x + 0x1p-9, y + 0x1p-9}, {x, y + 0x1p-9}}) {
      cells.vertices.push_back(vertex);
    }
    cells.cell_offsets.push_back(cells.vertices.size());
    cells.status.push_back(Status::ok);
  }
  const auto mesh = cellsMesh(*file, cells);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), (side + 1) * (side + 1));
  EXPECT_EQ(mesh->size(), side * side);
  for (std::size_t i = 0; i < cells.vertices.size(); ++i) {
    const Point& point = mesh->points[static_cast<std::size_t>(mesh->corners[i])];
    ASSERT_EQ(point.x, cells.vertices[i].x);
    ASSERT_EQ(point.y, cells.vertices[i].y);
  }
}

}  // namespace
}  // namespace vorpipe::test
