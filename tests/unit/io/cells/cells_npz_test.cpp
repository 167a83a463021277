#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <thread>
#include <vector>

#include "io/base/npy_array.h"
#include "unit/io/cells/cells_fixture.h"

namespace vorpipe::test {
namespace {

TEST(NpyHeader, IsAligned) {
  const std::vector<std::uint64_t> shapes = {5, 3, 12345678901};
  for (std::size_t dimensions = 1; dimensions <= shapes.size(); ++dimensions) {
    const std::string header = npyHeader("<f8", std::span(shapes).first(dimensions));
    EXPECT_EQ(header.size() % 64, 0u);
    EXPECT_EQ(header.back(), '\n');
  }
  EXPECT_THAT(npyHeader("<f8", std::span(shapes).first(1)), ::testing::HasSubstr("'shape': (5,), }"));
  EXPECT_THAT(npyHeader("|u1", std::span(shapes).first(2)), ::testing::HasSubstr("'shape': (5, 3), }"));
}

TEST_F(CellsFile, NumPyReadsTheArrays) {
  written("c.npz");
  if (!numpy(
          "import zipfile\n"
          "assert zipfile.ZipFile('c.npz').testzip() is None\n"
          "c = np.load('c.npz')\n"
          "def check(name, dtype, values):\n"
          "    a, b = c[name], np.array(values, dtype)\n"
          "    assert a.dtype == b.dtype and a.shape == b.shape and (a == b).all(), (name, a, b)\n"
          "t = 1 / 3\n"
          "check('sites', 'f8', [[.25, .5], [.5, .05], [.25, .5], [7, .5], [.5, .75]])\n"
          "check('status', 'u1', [0, 0, 2, 1, 0])\n"
          "check('owners', 'u4', [0, 1, 0, 3, 4])\n"
          "check('areas', 'f8', [t, (1 - t) * .1, 0, 0, (1 - t) * (1 - .1)])\n"
          "check('perimeters', 'f8', [2 + 2 * t, 2 * (1 - t + .1), 0, 0, 2 * (1 - t + 1 - .1)])\n"
          "check('centroids', 'f8', [[t / 2, .5], [2 * t, .05], [.25, .5], [7, .5], [2 * t, .55]])\n"
          "check('second_moments', 'f8', [[1, 2, 3], [4, 5, 6], [0, 0, 0], [0, 0, 0], [7, 8, 9]])\n"
          "check('cell_offsets', 'i8', [0, 5, 9, 9, 9, 13])\n"
          "check('cell_vertices', 'f8', [[0, 0], [t, 0], [t, .1], [t, 1], [0, 1], [t, 0], [1, 0], [1, .1],\n"
          "                              [t, .1], [1, .1], [1, 1], [t, 1], [t, .1]])\n"
          "check('neighbor_offsets', 'i8', [0, 5, 9, 9, 9, 13])\n"
          "check('neighbors', 'i8', [-3, 1, 4, -4, -1, -3, -2, 4, 0, -2, -4, 0, 1])\n"
          "check('edge_lengths', 'f8', [t, .1, .9, t, 1, 2 * t, .1, 2 * t, .1, .9, 2 * t, .9, 2 * t])\n"
          "check('triangles', 'u4', [[0, 1, 4]])\n"
          "assert len(c.files) == 13\n")) {
    GTEST_SKIP() << without_numpy;
  }
}

TEST_F(CellsFile, NumPyReadsTheWeights) {
  Sites sites = someSites();
  sites.weight = {1, -2.5, 0, 1e-300, tenth};
  Diagram cells = someCells();
  cells.triangles.clear();
  written("c.npz", sites, cells);
  if (!numpy("c = np.load('c.npz')\n"
             "assert list(c['weights']) == [1, -2.5, 0, 1e-300, .1]\n"
             "assert c['triangles'].shape == (0, 3)\n")) {
    GTEST_SKIP() << without_numpy;
  }
}

TEST_F(CellsFile, NumPyReadsPiecesShiftsAndMass) {
  written("pieces.npz", sitesInPieces(), cellsInPieces());
  written("more.npz", someSites(), cellsWithShiftsAndMass());
  if (!numpy("p, m = np.load('pieces.npz'), np.load('more.npz')\n"
             "assert p['ring_starts'].dtype == np.int64 and list(p['ring_starts']) == [0, 4, 8, 11]\n"
             "assert len(p.files) == 14 and len(m.files) == 16\n"
             "s = m['neighbor_shifts']\n"
             "assert s.dtype == np.int32 and s.shape == (13, 2)\n"
             "assert list(s[0]) == [0, -1] and list(s[12]) == [1, 2] and not s[1:12].any()\n"
             "assert list(m['mass']) == [.1, 2, 0, 0, 3] and m['mass'].dtype == np.float64\n"
             "assert (m['mass_centroids'] == m['centroids']).all()\n")) {
    GTEST_SKIP() << without_numpy;
  }
}

/// A pipe takes bytes in one order only.
TEST_F(CellsFile, NpzGoesThroughAPipe) {
  const std::string expected = written("c.npz");
  const std::string pipe = path("pipe.npz");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  {
    const std::jthread reader([&] { received = contents(pipe); });
    auto file = OutputFile::create(pipe);
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(writeCells(*file, {someSites(), someCells()}, **cellsFormatOf(pipe)));
    ASSERT_TRUE(file->commit());
  }
  EXPECT_EQ(received, expected);
}

}  // namespace
}  // namespace vorpipe::test
