/// Values of C++ as plain ones of Python, which pickle takes, and back.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "errors.h"
#include "vorpipe.h"

namespace vorpipe::python {

namespace py = pybind11;

/// Of a struct: `all`, a tuple of names with pointers to its members.
template <class T>
struct Members;

template <class T>
concept Structure = requires {
  Members<T>::all;
};

/// What a row of an array consists of, as Point of doubles.
template <class T>
struct RowOf {};
template <class T>
requires std::is_arithmetic_v<T>
struct RowOf<T> {
  using Number = T;
};
template <class T>
requires std::is_enum_v<T>
struct RowOf<T> {
  using Number = std::underlying_type_t<T>;
};
template <>
struct RowOf<Point> {
  using Number = double;
};
template <>
struct RowOf<Point3> {
  using Number = double;
};
template <class T, std::size_t count>
struct RowOf<std::array<T, count>> {
  using Number = T;
};
template <class T>
concept Row = requires {
  typename RowOf<T>::Number;
};

/// Thrown where a pickle does not say what this version of a struct consists of.
struct OtherPickle {};

/// The value as what it must be; cast would make one of what is none.
template <class Object>
Object asIs(const py::handle& value) {
  if (!py::isinstance<Object>(value)) throw OtherPickle{};
  return py::reinterpret_borrow<Object>(value);
}

/// How values of a type become Python's and come back. `owner` is the object of Python that they lie in,
/// which arrays keep alive: they show its memory.
template <class T>
struct Pickled;

template <class T>
py::object pickledOf(const T& value, const py::handle& owner) {
  return Pickled<T>::of(value, owner);
}

template <class T>
T unpickled(const py::handle& state) {
  try {
    return Pickled<T>::from(state);
  } catch (const py::cast_error&) {
    throw OtherPickle{};
  }
}

/// Numbers and texts; enumerators by their number, texts as bytes, since names of files need not be UTF-8.
template <class T>
requires(std::is_arithmetic_v<T>) struct Pickled<T> {
  static py::object of(T value, const py::handle&) { return py::cast(value); }
  static T from(const py::handle& state) { return state.cast<T>(); }
};

template <class T>
requires(std::is_enum_v<T>) struct Pickled<T> {
  using Number = std::underlying_type_t<T>;
  static py::object of(T value, const py::handle&) { return py::cast(static_cast<Number>(value)); }
  static T from(const py::handle& state) { return static_cast<T>(state.cast<Number>()); }
};

template <>
struct Pickled<std::string> {
  static py::object of(const std::string& text, const py::handle&) { return py::bytes(text); }
  static std::string from(const py::handle& state) { return asIs<py::bytes>(state); }
};

template <class T>
struct Pickled<std::optional<T>> {
  static py::object of(const std::optional<T>& value, const py::handle& owner) {
    return value ? pickledOf(*value, owner) : py::object(py::none());
  }
  static std::optional<T> from(const py::handle& state) {
    return state.is_none() ? std::nullopt : std::optional<T>(unpickled<T>(state));
  }
};

template <class A, class B>
struct Pickled<std::pair<A, B>> {
  static py::object of(const std::pair<A, B>& both, const py::handle& owner) {
    return py::make_tuple(pickledOf(both.first, owner), pickledOf(both.second, owner));
  }
  static std::pair<A, B> from(const py::handle& state) {
    const auto both = asIs<py::tuple>(state);
    if (both.size() != 2) throw OtherPickle{};
    return {unpickled<A>(both[0]), unpickled<B>(both[1])};
  }
};

/// What is an object of Python's by itself, which others may share.
template <class T>
struct Pickled<std::shared_ptr<T>> {
  static py::object of(const std::shared_ptr<T>& shared, const py::handle&) {
    return py::cast(std::const_pointer_cast<std::remove_const_t<T>>(shared));
  }
  static std::shared_ptr<T> from(const py::handle& state) {
    return state.cast<std::shared_ptr<std::remove_const_t<T>>>();
  }
};

/// Rows are one array of numbers, of one axis.
template <Row T>
struct Pickled<std::vector<T>> {
  using Number = typename RowOf<T>::Number;
  static constexpr std::size_t columns = sizeof(T) / sizeof(Number);
  static py::object of(const std::vector<T>& rows, const py::handle& owner) {
    const auto* const first = reinterpret_cast<const Number*>(rows.data());
    py::array_t<Number> array(static_cast<py::ssize_t>(rows.size() * columns), first, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
  }
  static std::vector<T> from(const py::handle& state) {
    const auto array = state.cast<py::array_t<Number, py::array::c_style>>();
    const auto count = static_cast<std::size_t>(array.size());
    if (count % columns != 0) throw OtherPickle{};
    std::vector<T> rows(count / columns);
    if (count > 0) std::memcpy(rows.data(), array.data(), count * sizeof(Number));
    return rows;
  }
};

template <class T>
requires(!Row<T>) struct Pickled<std::vector<T>> {
  static py::object of(const std::vector<T>& values, const py::handle& owner) {
    py::list list;
    for (const T& value : values) list.append(pickledOf(value, owner));
    return list;
  }
  static std::vector<T> from(const py::handle& state) {
    std::vector<T> values;
    for (const py::handle& value : asIs<py::list>(state)) values.push_back(unpickled<T>(value));
    return values;
  }
};

/// A dict of its members.
template <Structure T>
struct Pickled<T> {
  static py::object of(const T& value, const py::handle& owner) {
    py::dict state;
    const auto put = [&](const auto& member) {
      state[member.first] = pickledOf(value.*member.second, owner);
    };
    std::apply([&](const auto&... member) { (put(member), ...); }, Members<T>::all);
    return state;
  }
  static T from(const py::handle& given) {
    const auto state = asIs<py::dict>(given);
    if (state.size() != std::tuple_size_v<std::remove_const_t<decltype(Members<T>::all)>>)
      throw OtherPickle{};
    T value{};
    const auto take = [&]<class Member>(const Member& member) {
      if (!state.contains(member.first)) throw OtherPickle{};
      auto& to = value.*member.second;
      to = unpickled<std::remove_reference_t<decltype(to)>>(state[member.first]);
    };
    std::apply([&](const auto&... member) { (take(member), ...); }, Members<T>::all);
    return value;
  }
};

/// For `def`: the pickles of a class, which name the version that made them. Throws InputError for those of
/// a version whose structs have other members.
template <class T>
auto pickles() {
  return py::pickle(
      [](const py::object& self) {
        return py::make_tuple(std::string(version()), pickledOf(self.cast<const T&>(), self));
      },
      [](const py::tuple& state) -> T {
        const auto made_by =
            state.size() == 2 ? state[0].cast<std::string>() : std::string("another program");
        try {
          return unpickled<T>(state[state.size() - 1]);
        } catch (const OtherPickle&) {
          raiseInput("pickle", "vorpipe " + made_by + " made it, which has other results than this, " +
                                   std::string(version()) +
                                   ": compute it anew, or take that version to read it");
        }
      });
}

/// How many members an aggregate has.
struct AnyMember {
  template <class T>
  operator T() const;  // NOLINT: it stands for whatever is asked for
};
template <class T, class... Known>
consteval std::size_t memberCount() {
  if constexpr (requires { T{Known{}..., AnyMember{}}; }) {
    return memberCount<T, Known..., AnyMember>();
  } else {
    return sizeof...(Known);
  }
}

/// Whether all members of a struct are named, but for some that a pickle need not have.
template <class T>
constexpr bool has_all_members(std::size_t left_out = 0) {
  return std::tuple_size_v<std::remove_const_t<decltype(Members<T>::all)>> + left_out == memberCount<T>();
}

}  // namespace vorpipe::python
