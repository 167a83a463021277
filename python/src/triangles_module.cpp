#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <tuple>

#include "arrays.h"
#include "results.h"
#include "runs.h"
#include "triangles.h"

namespace vorpipe::python {
namespace {

/// Arrays in memory as C++ has them.
template <class Number>
using Rows = py::array_t<Number, py::array::c_style | py::array::forcecast>;

template <class Row, class Number>
std::span<const Row> rowsOf(const Rows<Number>& array) {
  static_assert(sizeof(Row) % sizeof(Number) == 0);
  return {reinterpret_cast<const Row*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

py::array adjacentArray(const Rows<std::uint32_t>& triangles, std::size_t points) {
  auto adjacent = [&] {
    const WithoutGil no_gil;
    return adjacentTriangles(rowsOf<Triangle>(triangles), points);
  }();
  return arrayOf<std::int32_t>(std::move(adjacent));
}

std::tuple<py::array, py::array, py::array> fanArrays(const Rows<std::uint32_t>& triangles,
                                                      const Rows<std::int32_t>& adjacent,
                                                      std::size_t points) {
  Fans fans = [&] {
    const WithoutGil no_gil;
    return fansOf(rowsOf<Triangle>(triangles), rowsOf<Adjacent>(adjacent), points);
  }();
  return {arrayOf<std::int64_t>(std::move(fans.offsets)), arrayOf<std::int32_t>(std::move(fans.triangles)),
          arrayOf<std::uint8_t>(std::move(fans.are_closed))};
}

std::tuple<py::array, py::array> flippedArrays(const Rows<double>& points,
                                               const Rows<std::uint32_t>& triangles,
                                               const Rows<std::int32_t>& adjacent) {
  Mesh mesh = [&] {
    const WithoutGil no_gil;
    return flipped(rowsOf<Point>(points), rowsOf<Triangle>(triangles), rowsOf<Adjacent>(adjacent));
  }();
  return {arrayOf<std::uint32_t>(std::move(mesh.triangles)), arrayOf<std::int32_t>(std::move(mesh.adjacent))};
}

py::array flatArray(const Rows<double>& points, const Rows<std::uint32_t>& triangles,
                    const Rows<std::int32_t>& adjacent) {
  auto are_flat = [&] {
    const WithoutGil no_gil;
    return flatOnHull(rowsOf<Point>(points), rowsOf<Triangle>(triangles), rowsOf<Adjacent>(adjacent));
  }();
  return arrayOf<std::uint8_t>(std::move(are_flat));
}

std::tuple<py::array, py::array, py::array> centerArrays(const Rows<double>& points,
                                                         const Rows<std::uint32_t>& triangles,
                                                         const Rows<std::int32_t>& adjacent) {
  Centers centers = [&] {
    const WithoutGil no_gil;
    return centersOf(rowsOf<Point>(points), rowsOf<Triangle>(triangles), rowsOf<Adjacent>(adjacent));
  }();
  return {arrayOf<std::int32_t>(std::move(centers.of_triangle)),
          arrayOf<double>(std::move(centers.positions)), arrayOf<std::int32_t>(std::move(centers.triangles))};
}

py::array trianglesAtPlaces(const Rows<double>& points, const Rows<std::uint32_t>& triangles,
                            const Rows<std::int32_t>& adjacent, const Rows<double>& places,
                            double tolerance) {
  auto found = [&] {
    const WithoutGil no_gil;
    return trianglesAt(rowsOf<Point>(points), rowsOf<Triangle>(triangles), rowsOf<Adjacent>(adjacent),
                       rowsOf<Point>(places), tolerance);
  }();
  return arrayOf<std::int32_t>(std::move(found));
}

}  // namespace

void defineTriangles(py::module_& module) {
  module.def("adjacent_triangles", &adjacentArray, py::arg("triangles"), py::arg("points"));
  module.def("flipped_triangles", &flippedArrays, py::arg("points"), py::arg("triangles"),
             py::arg("adjacent"));
  module.def("flat_on_hull", &flatArray, py::arg("points"), py::arg("triangles"), py::arg("adjacent"));
  module.def("triangle_fans", &fanArrays, py::arg("triangles"), py::arg("adjacent"), py::arg("points"));
  module.def("triangle_centers", &centerArrays, py::arg("points"), py::arg("triangles"), py::arg("adjacent"));
  module.def("triangles_at", &trianglesAtPlaces, py::arg("points"), py::arg("triangles"), py::arg("adjacent"),
             py::arg("places"), py::arg("tolerance"));
}

}  // namespace vorpipe::python
