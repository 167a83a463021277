#include "io/base/feature_layer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <new>
#include <span>

#include "base/try.h"
#include "io/base/coordinate_system.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

constexpr std::string_view sqlite_magic("SQLite format 3\0", 16);

std::string textOf(sqlite3_stmt* row, int column) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr ? std::string()
                         : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
}

/// Whether a column of this type holds bytes, as additional geometries do, whose types are names of
/// geometries.
bool isBinary(const std::string& type) {
  constexpr std::array<std::string_view, 11> geometries = {
      "POINT",      "LINESTRING",   "POLYGON",      "MULTIPOINT", "MULTILINESTRING", "MULTIPOLYGON",
      "MULTICURVE", "CURVEPOLYGON", "MULTISURFACE", "CURVE",      "SURFACE"};
  return type.empty() || type.starts_with("BLOB") || type.find("GEOM") != std::string::npos ||
         std::ranges::find(geometries, type) != geometries.end();
}

/// Returns the type of a column by the standard's names; an unknown one is text until its values show
/// otherwise.
AttributeType typeOf(const std::string& type) {
  constexpr std::array<std::string_view, 6> integers = {"INT",      "INTEGER",   "TINYINT",
                                                        "SMALLINT", "MEDIUMINT", "BIGINT"};
  constexpr std::array<std::string_view, 4> reals = {"REAL", "DOUBLE", "FLOAT", "NUMERIC"};
  if (type == "BOOLEAN") return AttributeType::boolean;
  if (std::ranges::find(integers, type) != integers.end()) return AttributeType::integer;
  return std::ranges::find(reals, type) == reals.end() ? AttributeType::text : AttributeType::real;
}

CoordinateKind kindOf(const CoordinateSystem& system) {
  const CoordinateKind kind = kindOfWkt(system.definition);
  if (kind != CoordinateKind::unknown) return kind;
  return system.organization == "EPSG" ? systemOfCode(system.code).kind : CoordinateKind::plane;
}

/// A layer as listed in the file's tables.
struct Listed {
  std::string name, geometry_column, geometry_type;
  std::int64_t system;
};

bool isOf(const Listed& layer, LayerOf kind) {
  const bool points = kind == LayerOf::points;
  return layer.geometry_type == (points ? "POINT" : "POLYGON") ||
         layer.geometry_type == (points ? "MULTIPOINT" : "MULTIPOLYGON");
}
bool mayBeOfAny(const Listed& layer) {
  return layer.geometry_type == "GEOMETRY" || layer.geometry_type == "GEOMETRYCOLLECTION";
}

std::string listed(std::span<const Listed> layers) {
  constexpr std::size_t most = 20;
  std::vector<std::string> names;
  for (const Listed& layer : layers.first(std::min(most, layers.size()))) {
    names.push_back(fmt::format("{} ({})", printable(layer.name), printable(layer.geometry_type)));
  }
  if (layers.size() > most) names.push_back(fmt::format("and {} more", layers.size() - most));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Whether memory is available: if so, a damaged file requested too much.
bool hasMemory() {
  constexpr sqlite3_uint64 some = 1 << 20;
  void* const memory = sqlite3_malloc64(some);
  sqlite3_free(memory);
  return memory != nullptr;
}

}  // namespace

tl::unexpected<Error> FeatureLayer::failed(int code) const {
  constexpr int primary = 0xFF;
  if ((code & primary) == SQLITE_NOMEM && hasMemory()) {
    return inputError(
        fmt::format("{}: cannot be read: it asks for more memory than a file of its size has", path_));
  }
  if (!limits_->refusal().empty()) {
    return inputError(fmt::format("{}: cannot be read: {}", path_, limits_->refusal()));
  }
  // SQLite's message may quote text of the file.
  const auto message = fmt::format("{}: cannot be read: {}", path_, escaped(sqlite3_errmsg(database_.get())));
  const bool device = (code & primary) == SQLITE_NOMEM || (code & primary) == SQLITE_IOERR;
  return device ? deviceError(message) : inputError(message);
}

Result<void> FeatureLayer::openDatabase(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  std::array<char, sqlite_header_size> header{};
  VORPIPE_LET(got, file.read(header));
  if (!std::string_view(header.data(), got).starts_with(sqlite_magic)) {
    return inputError(fmt::format("{}: is no GeoPackage: it does not begin with \"SQLite format 3\"", path_));
  }
  const std::string address = sqliteAddress(path, header);
  sqlite3* database = nullptr;
  const int code =
      sqlite3_open_v2(address.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(database);
  if (database == nullptr) throw std::bad_alloc();
  if (code != SQLITE_OK) return failed(code);
  const int limited = limits_->apply(database, file.size().value_or(0));
  return limited == SQLITE_OK ? Result<void>() : failed(limited);
}

Result<Statement> FeatureLayer::prepare(const std::string& sql, std::string_view parameter) const {
  sqlite3_stmt* raw = nullptr;
  const int code = limits_->prepare(sql, raw);
  Statement statement(raw);
  if (code != SQLITE_OK) return failed(code);
  if (sqlite3_bind_parameter_count(raw) > 0) {
    const int bound =
        sqlite3_bind_text(raw, 1, parameter.data(), static_cast<int>(parameter.size()), SQLITE_TRANSIENT);
    if (bound != SQLITE_OK) return failed(bound);
  }
  return statement;
}

Result<bool> FeatureLayer::step(const Statement& statement) const {
  const int code = sqlite3_step(statement.get());
  if (code == SQLITE_ROW || code == SQLITE_DONE) return code == SQLITE_ROW;
  return failed(code);
}

template <class Use>
Result<void> FeatureLayer::eachRow(const std::string& sql, std::string_view parameter, const Use& use) const {
  VORPIPE_LET(statement, prepare(sql, parameter));
  while (true) {
    VORPIPE_LET(more, step(statement));
    if (!more) return {};
    use(statement.get());
  }
}

Result<void> FeatureLayer::chooseLayer(const std::string& name, LayerOf kind) {
  std::vector<Listed> layers, chosen;
  VORPIPE_TRY(eachRow(
      "SELECT c.table_name, g.column_name, upper(g.geometry_type_name), g.srs_id FROM gpkg_contents c"
      " JOIN gpkg_geometry_columns g ON g.table_name = c.table_name WHERE c.data_type = 'features' ORDER BY "
      "1",
      {}, [&](sqlite3_stmt* row) {
        layers.push_back({textOf(row, 0), textOf(row, 1), textOf(row, 2), sqlite3_column_int64(row, 3)});
      }));
  if (layers.empty()) return inputError(fmt::format("{}: has no layers of features", path_));
  const std::string_view what = kind == LayerOf::points ? "points" : "polygons";
  const auto choose = [&](const auto& which) {
    std::ranges::copy_if(layers, std::back_inserter(chosen), which);
  };
  if (!name.empty()) {
    choose([&](const Listed& layer) { return layer.name == name; });
    if (chosen.empty()) {
      return inputError(fmt::format("{}: has no layer {}; it has {}", path_, inQuotes(name), listed(layers)));
    }
  } else {
    choose([&](const Listed& layer) { return isOf(layer, kind); });
    if (chosen.empty()) choose(mayBeOfAny);
    if (chosen.empty())
      return inputError(fmt::format("{}: has no layer of {}; it has {}", path_, what, listed(layers)));
  }
  if (chosen.size() > 1) {
    return inputError(fmt::format("{}: has several layers of {}: {}; {} says which", path_, what,
                                  listed(chosen), kind == LayerOf::points ? "--layer" : "--domain-layer"));
  }
  name_ = chosen[0].name;
  geometry_column_ = chosen[0].geometry_column;
  system_id_ = chosen[0].system;
  return {};
}

Result<void> FeatureLayer::findColumns() {
  bool has_geometry = false;
  const auto add = [&](sqlite3_stmt* row) {
    std::string column = textOf(row, 0), type = textOf(row, 1);
    type.resize(std::min(type.find('('), type.size()));  // TEXT(20)
    if (upperCase(column) == upperCase(geometry_column_)) {
      has_geometry = true;
    } else if (isBinary(type)) {
      binary_.push_back(std::move(column));
    } else {
      columns_.push_back({std::move(column), typeOf(type)});
    }
  };
  VORPIPE_TRY(eachRow("SELECT name, upper(type) FROM pragma_table_info(?)", name_, add));
  if (has_geometry) return {};
  return inputError(
      fmt::format("{}: its layer {} has no column {}", path_, inQuotes(name_), inQuotes(geometry_column_)));
}

Result<void> FeatureLayer::findSystem() {
  constexpr std::int64_t plane = -1, degrees = 0;
  if (system_id_ == plane || system_id_ == degrees) {
    system_.kind = system_id_ == plane ? CoordinateKind::plane : CoordinateKind::degrees;
    return {};
  }
  return eachRow(
      "SELECT organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys"
      " WHERE srs_id = CAST(? AS INTEGER) LIMIT 1",
      std::to_string(system_id_), [this](sqlite3_stmt* row) {
        system_.organization = upperCase(textOf(row, 0));
        system_.code = sqlite3_column_int64(row, 1);
        system_.definition = textOf(row, 2);
        if (system_.definition == "undefined") system_.definition.clear();
        system_.kind = kindOf(system_);
      });
}

Result<void> FeatureLayer::select() {
  std::string names = sqlName(geometry_column_);
  for (const LayerColumn& column : columns_) names += ", " + sqlName(column.name);
  VORPIPE_VAR(statement, prepare(fmt::format("SELECT {} FROM {}", names, sqlName(name_)), {}));
  rows_ = std::move(statement);
  return {};
}

Result<FeatureLayer> FeatureLayer::open(const std::string& path, const std::string& name, LayerOf kind,
                                        const std::string& converted) {
  FeatureLayer layer(path);
  VORPIPE_TRY(layer.openDatabase(converted.empty() ? path : converted));
  VORPIPE_TRY(layer.chooseLayer(name, kind));
  VORPIPE_TRY(layer.findColumns());
  VORPIPE_TRY(layer.findSystem());
  VORPIPE_TRY(layer.select());
  return layer;
}

Result<bool> FeatureLayer::next() { return step(rows_); }

std::optional<std::string_view> FeatureLayer::geometry() const {
  if (sqlite3_column_type(rows_.get(), 0) == SQLITE_NULL) return std::nullopt;
  const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(rows_.get(), 0));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(rows_.get(), 0));
  return bytes == nullptr ? std::string_view() : std::string_view(bytes, size);
}

std::optional<std::pair<AttributeType, std::string>> FeatureLayer::value(std::size_t column) const {
  const int index = static_cast<int>(column) + 1;
  sqlite3_stmt* const row = rows_.get();
  switch (sqlite3_column_type(row, index)) {
    case SQLITE_INTEGER: {
      const std::int64_t number = sqlite3_column_int64(row, index);
      const bool truth = columns_[column].type == AttributeType::boolean && (number == 0 || number == 1);
      if (truth) return std::pair(AttributeType::boolean, std::string(number == 1 ? "true" : "false"));
      return std::pair(AttributeType::integer, std::to_string(number));
    }
    case SQLITE_FLOAT: {
      std::string number = fmt::format("{}", sqlite3_column_double(row, index));
      const bool finite = isJsonNumber(number);
      return std::pair(finite ? AttributeType::real : AttributeType::text, std::move(number));
    }
    case SQLITE_TEXT:
      return std::pair(AttributeType::text, textOf(row, index));
    default:
      return std::nullopt;
  }
}

}  // namespace vorpipe
