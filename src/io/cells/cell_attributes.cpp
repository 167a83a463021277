#include "io/cells/cell_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_set>

#include "io/base/field_text.h"
#include "io/base/lower_case.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

/// Field names of all formats, so that an attribute has the same name in each; fid and geom are GeoPackage's.
constexpr std::array<std::string_view, 21> own_fields{"fid",
                                                      "geom",
                                                      "site",
                                                      "x",
                                                      "y",
                                                      "weight",
                                                      "status",
                                                      "owner",
                                                      "area",
                                                      "perimeter",
                                                      "centroid",
                                                      "centroid_x",
                                                      "centroid_y",
                                                      "vertices",
                                                      "neighbors",
                                                      "rings",
                                                      "mass",
                                                      "neighbor_shifts",
                                                      "mass_centroid",
                                                      "mass_centroid_x",
                                                      "mass_centroid_y"};

}  // namespace

std::vector<std::string> attributeNames(std::span<const Attribute> attributes) {
  std::unordered_set<std::string> taken{""};
  for (const std::string_view field : own_fields) taken.emplace(field);
  std::vector<std::string> names;
  for (const Attribute& attribute : attributes) {
    std::string name = attribute.name();
    while (!taken.insert(lowerCase(name)).second) name.insert(0, "input_");
    names.push_back(std::move(name));
  }
  return names;
}

std::string renamingNote(std::span<const Attribute> attributes) {
  const auto names = attributeNames(attributes);
  std::string renamed;
  for (std::size_t k = 0; k < names.size(); ++k) {
    // The column `fid` holds a GeoPackage's row numbers: users need no note of its renaming.
    if (names[k] == attributes[k].name() || attributes[k].name() == "fid") continue;
    renamed += fmt::format("{}{} to {}", renamed.empty() ? "" : ", ", inQuotes(attributes[k].name()),
                           inQuotes(names[k]));
  }
  if (renamed.empty()) return renamed;
  return "renamed, since other fields have these names: " + renamed;
}

void printJsonValue(Bytes& text, const Attribute& attribute, std::size_t site) {
  const auto value = attribute.at(site);
  if (!value) {
    text.append(std::string_view("null"));
  } else if (attribute.type() == AttributeType::text) {
    printJsonString(text, *value);
  } else {
    text.append(*value);
  }
}

void printCsvValue(Bytes& text, const Attribute& attribute, std::size_t site) {
  if (const auto value = attribute.at(site)) printCsvField(text, *value);
}

}  // namespace vorpipe
