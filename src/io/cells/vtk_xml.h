/// XML files of VTK, which ParaView reads: .vtp and .vtu.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/base/byte_sink.h"
#include "io/base/print.h"
#include "io/cells/cells_mesh.h"
#include "vorpipe.h"

namespace vorpipe {

/// Numbers of a piece. `put(bytes, row)` appends those of a row in little-endian order; rows may be of
/// different lengths.
struct VtkArray {
  std::string_view name, type;  ///< VTK's name of the type: "Float64"
  std::uint64_t components;
  std::uint64_t rows, bytes;
  std::function<void(Bytes&, std::size_t)> put;
};

/// Returns VTK's name of a number type.
template <class Number>
constexpr std::string_view vtkType() {
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<Number, std::uint32_t>) return "UInt32";
  if constexpr (std::is_same_v<Number, std::uint8_t>) return "UInt8";
}

/// One number for each row: numberOf(row).
template <class Number, class NumberOf>
VtkArray vtkNumbers(std::string_view name, std::uint64_t rows, NumberOf numberOf) {
  return {name,
          vtkType<Number>(),
          1,
          rows,
          rows * sizeof(Number),
          [numberOf = std::move(numberOf)](Bytes& bytes, std::size_t row) {
            appendNumber<std::endian::little>(bytes, static_cast<Number>(numberOf(row)));
          }};
}

/// One point for each row: pointOf(row), a Point with z = 0, or one in space.
template <class PointOf>
VtkArray vtkPoints(std::string_view name, std::uint64_t rows, PointOf pointOf) {
  constexpr std::uint64_t components = 3;
  return {name,
          vtkType<double>(),
          components,
          rows,
          rows * components * sizeof(double),
          [pointOf = std::move(pointOf)](Bytes& bytes, std::size_t row) {
            const auto point = pointOf(row);
            double z = 0;
            if constexpr (requires { point.z; }) z = point.z;
            for (const double number : {point.x, point.y, z}) {
              appendNumber<std::endian::little>(bytes, number);
            }
          }};
}

/// Arrays that belong together: "Points", "Polys", "CellData".
struct VtkSection {
  std::string_view name;
  std::vector<VtkArray> arrays;
};

struct VtkPiece {
  std::string_view kind;  ///< "PolyData", "UnstructuredGrid"
  std::string counts;     ///< numbers of points and cells: XML attributes as named by the kind
  std::vector<VtkSection> sections;
};

/// Returns the counts of a PolyData piece.
std::string polyDataCounts(std::uint64_t points, std::uint64_t lines, std::uint64_t polygons);

/// Writes a file with one piece; its arrays follow the header as raw bytes, with 64-bit lengths. Error
/// (device): writing failed.
Result<void> writeVtkXml(ByteSink& sink, const VtkPiece& piece);

/// The points of a mesh; the corners of its faces, and where those of each face end. Both refer to it.
VtkSection meshPoints(const CellsMesh& mesh);
std::vector<VtkArray> meshFaces(const CellsMesh& mesh);

/// Writes a mesh as PolyData with these arrays for its faces. Error (device): writing failed.
Result<void> writeMeshVtp(ByteSink& sink, const CellsMesh& mesh, std::vector<VtkArray> face_data);

}  // namespace vorpipe
