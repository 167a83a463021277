#include "attributes.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "arrays.h"
#include "choices.h"
#include "errors.h"
#include "io/base/number.h"
#include "io/cells/cell_attributes.h"
#include "members.h"
#include "results.h"

namespace vorpipe {

template <>
inline constexpr std::array<std::string_view, 5> names_of<AttributeType>{"integer", "real", "boolean", "text",
                                                                         "json"};

}  // namespace vorpipe

namespace vorpipe::python {
namespace {

std::int64_t integerOf(std::string_view text) {
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// What no double holds is infinite.
double realOf(std::string_view text) {
  const double beyond = text.starts_with('-') ? -HUGE_VAL : HUGE_VAL;
  return parseNumber(text).value_or(beyond);
}

bool isComplete(const Attribute& attribute) {
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    if (!attribute.at(site)) return false;
  }
  return true;
}

/// An array of what `read` makes of each value; `missing` where there is none.
template <class Number, class Read>
py::array arrayFrom(const Attribute& attribute, Number missing, const Read& read) {
  std::vector<Number> values(attribute.size(), missing);
  for (std::size_t site = 0; site < values.size(); ++site) {
    if (const auto text = attribute.at(site)) values[site] = read(*text);
  }
  return arrayOf<Number>(std::move(values));
}

/// A list of what `read` makes of each value; None where there is none.
template <class Read>
py::list listFrom(const Attribute& attribute, const Read& read) {
  py::list values;
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    const auto text = attribute.at(site);
    values.append(text ? py::object(read(*text)) : py::object(py::none()));
  }
  return values;
}

/// An array, or, of texts and where values are missing, a list. JSON is its text.
py::object valuesOf(const Attributes& attributes, std::size_t column) {
  const Attribute& attribute = attributes.columns.at(column);
  switch (attribute.type()) {
    case AttributeType::integer:
      if (isComplete(attribute)) return arrayFrom<std::int64_t>(attribute, 0, integerOf);
      return listFrom(attribute, [](std::string_view text) { return py::int_(integerOf(text)); });
    case AttributeType::real:
      return arrayFrom<double>(attribute, std::nan(""), realOf);
    case AttributeType::boolean: {
      if (!isComplete(attribute)) {
        return listFrom(attribute, [](std::string_view text) { return py::bool_(text == "true"); });
      }
      const auto isTrue = [](std::string_view text) { return std::uint8_t{text == "true"}; };
      return arrayFrom<std::uint8_t>(attribute, 0, isTrue).attr("view")("bool");
    }
    case AttributeType::text:
    case AttributeType::json:
      break;
  }
  return listFrom(attribute, [](std::string_view text) { return textOf(text); });
}

/// Adds a column of what `print` makes of each number; missing where that is nothing.
template <class Number, class Print>
void addNumbers(Attributes& attributes, const std::string& name, AttributeType type,
                const py::array_t<Number>& values, const Print& print) {
  const auto elements = values.template unchecked<1>();
  Attribute attribute(name, type);
  std::string text;
  for (py::ssize_t i = 0; i < elements.shape(0); ++i) {
    text.clear();
    print(text, elements(i), i);
    attribute.add(text.empty() ? std::nullopt : std::optional<std::string_view>(text));
  }
  attributes.columns.push_back(std::move(attribute));
}

void addIntegers(Attributes& attributes, const std::string& name, const py::array_t<std::int64_t>& values) {
  addNumbers(attributes, name, AttributeType::integer, values,
             [](std::string& text, std::int64_t value, py::ssize_t) {
               fmt::format_to(std::back_inserter(text), "{}", value);
             });
}

/// What is not a number is missing.
void addReals(Attributes& attributes, const std::string& name, const py::array_t<double>& values) {
  addNumbers(attributes, name, AttributeType::real, values,
             [&](std::string& text, double value, py::ssize_t i) {
               if (std::isinf(value)) {
                 raiseInput("attributes",
                            fmt::format("'{}' of point {} is infinite, which files cannot say", name, i));
               }
               if (std::isnan(value)) return;
               text = fmt::format("{}", value);
               // A whole number is of reals, too. fmt's "#" ends it with a bare point since version 10.
               if (text.find_first_of(".e") == std::string::npos) text += ".0";
             });
}

void addBooleans(Attributes& attributes, const std::string& name, const py::array_t<bool>& values) {
  addNumbers(attributes, name, AttributeType::boolean, values,
             [](std::string& text, bool value, py::ssize_t) { text = value ? "true" : "false"; });
}

void addTexts(Attributes& attributes, const std::string& name, const std::string& type,
              const std::vector<std::optional<std::string>>& values) {
  Attribute attribute(name, chosen<AttributeType>("attributes", type));
  for (const auto& value : values) {
    attribute.add(value ? std::optional<std::string_view>(*value) : std::nullopt);
  }
  attributes.columns.push_back(std::move(attribute));
}

py::list namesOf(const Attributes& attributes) {
  py::list names;
  for (const Attribute& attribute : attributes.columns) names.append(textOf(attribute.name()));
  return names;
}

}  // namespace

void defineAttributes(py::module_& module) {
  py::class_<Attributes, std::shared_ptr<Attributes>>(module, "Attributes", "Named columns of values.")
      .def(py::init<>())
      .def("__len__", [](const Attributes& attributes) { return attributes.columns.size(); })
      .def("copy", [](const Attributes& attributes) { return attributes; })
      .def("add_integers", &addIntegers, py::arg("name"), py::arg("values"))
      .def("add_reals", &addReals, py::arg("name"), py::arg("values"))
      .def("add_booleans", &addBooleans, py::arg("name"), py::arg("values"))
      .def("add_texts", &addTexts, py::arg("name"), py::arg("type"), py::arg("values"))
      .def("values", &valuesOf, py::arg("column"))
      .def(
          "type",
          [](const Attributes& attributes, std::size_t column) {
            return nameOf(attributes.columns.at(column).type());
          },
          py::arg("column"))
      .def_property_readonly("names", &namesOf)
      .def_property_readonly("names_in_files",
                             [](const Attributes& attributes) { return attributeNames(attributes.columns); })
      .def_property_readonly("renaming_note",
                             [](const Attributes& attributes) { return renamingNote(attributes.columns); })
      .def(pickles<Attributes>());
}

}  // namespace vorpipe::python
