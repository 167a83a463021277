#include "io/cells/cell_attributes.h"

#include <fmt/format.h>

#include <iterator>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "io/base/field_text.h"
#include "io/base/geopackage.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

/// Returns the names of attributes beside fields, whose names are separated by blanks.
std::vector<std::string> namesBeside(const std::string& fields, std::span<const Attribute> attributes,
                                     std::string_view prefix = "input_") {
  std::istringstream words(fields);
  std::unordered_set<std::string> taken(std::istream_iterator<std::string>(words), {});
  taken.insert("");
  std::vector<std::string> names;
  for (const Attribute& attribute : attributes) {
    std::string name = attribute.name();
    while (!taken.insert(lowerCase(name)).second) name.insert(0, prefix);
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

std::vector<AddedField> addedFields(const CellsOutput& output) {
  std::vector<AddedField> added;
  // The areas of a projection are square kilometers, whatever the system of its degrees.
  if (const auto unit = squareKilometersIn(output.system)) added.push_back({"area_km2", 1 / *unit});
  if (output.share) added.push_back({"share", areaSum(output.diagram)});
  return added;
}

std::vector<std::string> attributeNames(std::span<const Attribute> attributes,
                                        std::span<const AddedField> added) {
  // The fields of all formats, so that an attribute has the same name in each; fid and geom are GeoPackage's.
  std::string fields =
      "fid geom site x y weight status owner area perimeter centroid centroid_x centroid_y vertices "
      "neighbors "
      "rings mass neighbor_shifts mass_centroid mass_centroid_x mass_centroid_y";
  for (const AddedField& field : added) fields.append(" ").append(field.name);
  return namesBeside(fields, attributes);
}

std::vector<std::string> pieceAttributeNames(const Attribute& by, std::span<const Attribute> attributes) {
  const std::string fields = "fid geom site x y weight area area_km2 share ";
  std::vector<std::string> names = namesBeside(fields, {&by, 1}, "feature_");
  // An attribute may have blanks in its name, which separate fields.
  std::vector<Attribute> beside;
  beside.emplace_back(names.front());
  for (const Attribute& attribute : attributes) beside.emplace_back(attribute.name());
  return namesBeside(fields, beside, "site_");
}

std::vector<std::string> pointAttributeNames(std::span<const Attribute> attributes) {
  return namesBeside(
      "fid geom x y lon lat weight w r radius lng long longitude latitude easting northing wkt geometry "
      "the_geom",
      attributes);
}

namespace {

/// Says which attributes got other names.
std::string noteOfNames(std::span<const Attribute> attributes, std::span<const std::string> names) {
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

}  // namespace

std::string renamingNote(std::span<const Attribute> attributes, std::span<const AddedField> added) {
  return noteOfNames(attributes, attributeNames(attributes, added));
}

std::vector<std::string> attributeNamesInSpace(std::span<const Attribute> attributes) {
  return namesBeside(
      "site x y z weight status owner volume area centroid_x centroid_y centroid_z faces neighbors",
      attributes);
}

std::string renamingNoteInSpace(std::span<const Attribute> attributes) {
  return noteOfNames(attributes, attributeNamesInSpace(attributes));
}

void printCsvNames(Bytes& text, std::span<const std::string> names) {
  for (const std::string& name : names) {
    text.push_back(',');
    printCsvField(text, name);
  }
}

void printCsvValues(Bytes& text, std::span<const Attribute> attributes, std::size_t site) {
  for (const Attribute& attribute : attributes) {
    text.push_back(',');
    if (const auto value = attribute.at(site)) printCsvField(text, *value);
  }
}

std::vector<std::string> jsonKeys(std::span<const std::string> names) {
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    Bytes key;
    printJsonString(key, name);
    keys.push_back(fmt::to_string(key) + ":");
  }
  return keys;
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

void addAttributeFields(std::vector<LayerField>& fields, std::span<const Attribute> attributes,
                        std::span<const std::string> names) {
  for (std::size_t k = 0; k < names.size(); ++k) {
    fields.push_back({utf8Of(names[k]), attributes[k].type()});
  }
}

std::string_view nameOfSite(const Attribute& names, std::int64_t site) {
  if (isWall(site)) return nameOf(static_cast<Wall>(site));
  return names.at(static_cast<std::size_t>(site)).value_or("");
}

std::string_view statusWord(Status status) {
  return status == Status::ok ? "ok" : status == Status::empty ? "empty" : "duplicate";
}

std::vector<std::int64_t> namedNeighbors(const Diagram& diagram, std::size_t site) {
  const auto all = diagram.cell(site).neighbors();
  std::vector<std::int64_t> named(all.begin(), all.end());
  if (!diagram.neighbor_shifts.empty()) return named;
  std::unordered_set<std::int64_t> met;
  std::erase_if(named, [&](std::int64_t neighbor) { return !met.insert(neighbor).second; });
  return named;
}

void printNeighbors(Bytes& text, const CellsOutput& output, std::size_t site) {
  if (output.names == nullptr) {
    const auto neighbors = output.diagram.cell(site).neighbors();
    return join(text, neighbors.size(), " ",
                [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}"), neighbors[k]); });
  }
  const auto neighbors = namedNeighbors(output.diagram, site);
  join(text, neighbors.size(), ";",
       [&](Bytes& out, std::size_t k) { out.append(nameOfSite(*output.names, neighbors[k])); });
}

void printJsonSite(Bytes& text, const Attribute* names, std::int64_t site) {
  if (names == nullptr) {
    print(text, FMT_COMPILE("{}"), site);
  } else if (isWall(site)) {
    print(text, FMT_COMPILE(R"("{}")"), nameOf(static_cast<Wall>(site)));
  } else {
    printJsonValue(text, *names, static_cast<std::size_t>(site));
  }
}

void printShifts(Bytes& text, const Diagram& diagram, std::size_t site) {
  const auto shifts = diagram.cell(site).shifts();
  join(text, shifts.size(), " ",
       [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}:{}"), shifts[k][0], shifts[k][1]); });
}

}  // namespace vorpipe
