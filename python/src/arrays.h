/// NumPy's arrays over memory of ours, and memory of ours from NumPy's arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace vorpipe::python {

namespace py = pybind11;

/// A capsule that keeps `owner` alive, for the arrays that show parts of it.
template <class Owner>
py::capsule keeping(std::shared_ptr<const Owner> owner) {
  using Kept = std::shared_ptr<const Owner>;
  return py::capsule(new Kept(std::move(owner)), [](void* kept) { delete static_cast<Kept*>(kept); });
}

/// An array that shows `data` without a copy, read-only, and keeps `owner` alive.
template <class Number, class Owner>
py::array viewOf(const void* data, std::vector<py::ssize_t> shape, std::shared_ptr<const Owner> owner) {
  py::array_t<Number> array(std::move(shape), static_cast<const Number*>(data), keeping(std::move(owner)));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same for a vector of rows, as Point is a row of two doubles: of shape (rows,) or (rows, columns).
template <class Number, class Row, class Owner>
py::array viewOf(const std::vector<Row>& rows, std::shared_ptr<const Owner> owner) {
  static_assert(sizeof(Row) % sizeof(Number) == 0);
  constexpr auto columns = static_cast<py::ssize_t>(sizeof(Row) / sizeof(Number));
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows.size())};
  if (columns > 1) shape.push_back(columns);
  return viewOf<Number>(rows.data(), std::move(shape), std::move(owner));
}

/// An array that owns what was a vector; nothing is copied.
template <class Number, class Row>
py::array arrayOf(std::vector<Row> rows) {
  static_assert(sizeof(Row) % sizeof(Number) == 0);
  constexpr auto columns = static_cast<py::ssize_t>(sizeof(Row) / sizeof(Number));
  auto owner = std::make_shared<const std::vector<Row>>(std::move(rows));
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(owner->size())};
  if (columns > 1) shape.push_back(columns);
  const auto* const data = reinterpret_cast<const Number*>(owner->data());
  return py::array_t<Number>(std::move(shape), data, keeping(std::move(owner)));
}

/// The elements of an array of one axis, whatever its strides.
template <class Number>
std::vector<Number> vectorOf(const py::array_t<Number>& array) {
  const auto elements = array.template unchecked<1>();
  std::vector<Number> values(static_cast<std::size_t>(elements.shape(0)));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = elements(static_cast<py::ssize_t>(i));
  return values;
}

}  // namespace vorpipe::python
