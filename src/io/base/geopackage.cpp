#include "io/base/geopackage.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/field_text.h"
#include "io/base/print.h"
#include "io/base/sqlite.h"

namespace vorpipe {
namespace {

/// A row of gpkg_spatial_ref_sys.
struct SpatialReference {
  std::string name;
  std::int32_t id;  ///< srs_id
  std::string organization;
  std::int64_t code;
  std::string definition;
};

constexpr std::int32_t unknown_plane = -1, unknown_degrees = 0, first_own = 100000;

const char* const wgs84_definition =
    R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],)"
    R"(AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],)"
    R"(UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AXIS["Latitude",NORTH],)"
    R"(AXIS["Longitude",EAST],AUTHORITY["EPSG","4326"]])";

/// Returns the rows that the standard requires.
std::array<SpatialReference, 3> standardReferences() {
  return {{{"Undefined Cartesian SRS", unknown_plane, "NONE", unknown_plane, "undefined"},
           {"Undefined geographic SRS", unknown_degrees, "NONE", unknown_degrees, "undefined"},
           {"WGS 84 geodetic", 4326, "EPSG", 4326, wgs84_definition}}};
}

std::string_view sqlType(AttributeType type) {
  switch (type) {
    case AttributeType::integer:
      return "INTEGER";
    case AttributeType::real:
      return "DOUBLE";
    case AttributeType::boolean:
      return "BOOLEAN";
    case AttributeType::text:
    case AttributeType::json:
      break;
  }
  return "TEXT";
}

std::string_view typeName(GeometryType type) {
  switch (type) {
    case GeometryType::point:
      return "POINT";
    case GeometryType::line_string:
      return "LINESTRING";
    case GeometryType::polygon:
      return "POLYGON";
    case GeometryType::multi_line_string:
      return "MULTILINESTRING";
    case GeometryType::multi_polygon:
      break;
  }
  return "MULTIPOLYGON";
}

std::string insertionOf(const SpatialReference& reference) {
  return fmt::format("INSERT INTO gpkg_spatial_ref_sys VALUES({},{},{},{},{},NULL);\n",
                     sqlText(reference.name), reference.id, sqlText(reference.organization), reference.code,
                     sqlText(reference.definition));
}

/// Returns the row of a coordinate system: an unknown one is an undefined plane, -1; degrees of unknown
/// origin are 0.
SpatialReference referenceOf(const CoordinateSystem& system) {
  const auto [plane, degrees, wgs84] = standardReferences();
  const bool named = !system.organization.empty();
  if (!named && system.definition.empty()) return system.kind == CoordinateKind::degrees ? degrees : plane;
  if (system.organization == wgs84.organization && system.code == wgs84.code) return wgs84;
  const std::string definition = system.definition.empty() ? "undefined" : system.definition;
  // The id of a row is arbitrary; people look for the organization's code.
  const bool fits = named && system.code > 0 && system.code <= std::numeric_limits<std::int32_t>::max();
  const auto id = fits && system.code != wgs84.code ? static_cast<std::int32_t>(system.code) : first_own;
  if (!named) return {"Coordinate system of the input", id, "NONE", id, definition};
  return {fmt::format("{}:{}", system.organization, system.code), id, system.organization, system.code,
          definition};
}

/// SQL that creates the tables of GeoPackages, with the rows that each must have and that of `reference`.
std::string geoPackageTables(const SpatialReference& reference) {
  std::string sql = R"(
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY,
  organization TEXT NOT NULL, organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL,
  description TEXT);
CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL,
  identifier TEXT UNIQUE, description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')), min_x DOUBLE, min_y DOUBLE,
  max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL,
  geometry_type_name TEXT NOT NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name),
  CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id));
CREATE TABLE gpkg_extensions (table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL,
  definition TEXT NOT NULL, scope TEXT NOT NULL,
  CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name));
)";
  bool standard = false;
  for (const SpatialReference& row : standardReferences()) {
    sql += insertionOf(row);
    standard = standard || row.id == reference.id;
  }
  return standard ? sql : sql + insertionOf(reference);
}

/// Returns the name of a layer's R-tree, quoted for SQL.
std::string treeName(const Layer& layer) { return sqlName("rtree_" + layer.name + "_geom"); }

/// SQL that creates a layer's own table and its R-tree, without triggers, and registers both.
std::string layerTables(const Layer& layer, const SpatialReference& reference) {
  using namespace fmt::literals;
  std::string columns;
  for (const LayerField& field : layer.fields) {
    columns += fmt::format(", {} {}", sqlName(field.name), sqlType(field.type));
  }
  return fmt::format(
      "CREATE TABLE {table} (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom {type}{columns});\n"
      "INSERT INTO gpkg_contents "
      "VALUES({name},'features',{name},'','2000-01-01T00:00:00.000Z',NULL,NULL,NULL,NULL,{system});\n"
      "INSERT INTO gpkg_geometry_columns VALUES({name},'geom','{type}',{system},0,0);\n"
      "CREATE VIRTUAL TABLE {tree} USING rtree(id, minx, maxx, miny, maxy);\n"
      "INSERT INTO gpkg_extensions VALUES({name},'geom','gpkg_rtree_index',"
      "'http://www.geopackage.org/spec120/#extension_rtree','write-only');\n",
      "table"_a = sqlName(layer.name), "type"_a = typeName(layer.geometry), "columns"_a = columns,
      "name"_a = sqlText(layer.name), "system"_a = reference.id, "tree"_a = treeName(layer));
}

/// SQL that keeps a layer's R-tree up to date from then on.
std::string treeTriggers(const Layer& layer) {
  // Triggers of the standard, annex F.3; programs that change the layer provide the functions.
  using namespace fmt::literals;
  return fmt::format(
      R"(CREATE TRIGGER "rtree_{t}_geom_insert" AFTER INSERT ON "{t}"
  WHEN (new.geom NOT NULL AND NOT ST_IsEmpty(NEW.geom)) BEGIN
  INSERT OR REPLACE INTO "rtree_{t}_geom"
    VALUES (NEW.fid, ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER "rtree_{t}_geom_update1" AFTER UPDATE OF geom ON "{t}"
  WHEN OLD.fid = NEW.fid AND (NEW.geom NOTNULL AND NOT ST_IsEmpty(NEW.geom)) BEGIN
  INSERT OR REPLACE INTO "rtree_{t}_geom"
    VALUES (NEW.fid, ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER "rtree_{t}_geom_update2" AFTER UPDATE OF geom ON "{t}"
  WHEN OLD.fid = NEW.fid AND (NEW.geom ISNULL OR ST_IsEmpty(NEW.geom)) BEGIN
  DELETE FROM "rtree_{t}_geom" WHERE id = OLD.fid; END;
CREATE TRIGGER "rtree_{t}_geom_update3" AFTER UPDATE ON "{t}"
  WHEN OLD.fid != NEW.fid AND (NEW.geom NOTNULL AND NOT ST_IsEmpty(NEW.geom)) BEGIN
  DELETE FROM "rtree_{t}_geom" WHERE id = OLD.fid;
  INSERT OR REPLACE INTO "rtree_{t}_geom"
    VALUES (NEW.fid, ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER "rtree_{t}_geom_update4" AFTER UPDATE ON "{t}"
  WHEN OLD.fid != NEW.fid AND (NEW.geom ISNULL OR ST_IsEmpty(NEW.geom)) BEGIN
  DELETE FROM "rtree_{t}_geom" WHERE id IN (OLD.fid, NEW.fid); END;
CREATE TRIGGER "rtree_{t}_geom_delete" AFTER DELETE ON "{t}" WHEN old.geom NOT NULL BEGIN
  DELETE FROM "rtree_{t}_geom" WHERE id = OLD.fid; END;
)",
      "t"_a = layer.name);
}

/// A layer that is written into a database in memory.
class LayerWriter {
 public:
  LayerWriter(ByteSink& sink, const Layer& layer)
      : sink_(sink), layer_(layer), reference_(referenceOf(layer.system)) {}

  Result<void> createTables();
  Result<void> insertFeatures(std::size_t count, const FillRow& fill);
  Result<void> write();

 private:
  /// Returns SQLite's message about what went wrong.
  [[nodiscard]] tl::unexpected<Error> failed(int code) const;
  Result<void> execute(const std::string& sql);
  Result<Statement> prepare(const std::string& sql);
  Result<void> step(const Statement& statement);
  Result<void> addToTree(const Statement& insertion, const Box& box);

  ByteSink& sink_;
  const Layer& layer_;
  const SpatialReference reference_;
  Database database_;
  std::optional<Box> box_;  ///< of all geometries
};

tl::unexpected<Error> LayerWriter::failed(int code) const {
  const char* const reason = sqlite3_errmsg(database_.get());
  constexpr int primary = 0xFF;
  switch (code & primary) {
    case SQLITE_NOMEM:
    case SQLITE_FULL:
    case SQLITE_IOERR:
      return deviceError(fmt::format("{}: there is not enough memory to write it: {}", sink_.name(), reason));
    default:
      return inputError(fmt::format("{}: cannot be a GeoPackage: {}", sink_.name(), reason));
  }
}

Result<void> LayerWriter::execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return failed(code);
  return {};
}

Result<Statement> LayerWriter::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr);
  if (code != SQLITE_OK) return failed(code);
  return Statement(statement);
}

Result<void> LayerWriter::step(const Statement& statement) {
  const int code = sqlite3_step(statement.get());
  if (code != SQLITE_DONE) return failed(code);
  sqlite3_reset(statement.get());
  return {};
}

Result<void> LayerWriter::createTables() {
  // SQLite's "memdb" file system keeps it in one piece, so that sqlite3_serialize makes no copy.
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2("layer", &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, "memdb");
  database_.reset(database);
  if (code != SQLITE_OK) return failed(code);
  sqlite3_int64 limit = std::numeric_limits<sqlite3_int64>::max();
  sqlite3_file_control(database, "main", SQLITE_FCNTL_SIZE_LIMIT, &limit);
  VORPIPE_TRY(execute(
      "PRAGMA page_size=4096; PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA encoding='UTF-8';"
      "PRAGMA application_id=1196444487; PRAGMA user_version=10300;"));
  return execute("BEGIN;" + geoPackageTables(reference_) + layerTables(layer_, reference_));
}

Result<void> LayerWriter::addToTree(const Statement& insertion, const Box& box) {
  const Box all = box_.value_or(box);
  box_ = {std::min(all.xmin, box.xmin), std::min(all.ymin, box.ymin), std::max(all.xmax, box.xmax),
          std::max(all.ymax, box.ymax)};
  int column = 0;
  sqlite3_bind_int64(insertion.get(), ++column, sqlite3_last_insert_rowid(database_.get()));
  for (const double bound : {box.xmin, box.xmax, box.ymin, box.ymax}) {
    sqlite3_bind_double(insertion.get(), ++column, bound);
  }
  return step(insertion);
}

Result<void> LayerWriter::insertFeatures(std::size_t count, const FillRow& fill) {
  std::string values = "NULL,?";
  for (std::size_t k = 0; k < layer_.fields.size(); ++k) values += ",?";
  VORPIPE_LET(insertion, prepare(fmt::format("INSERT INTO {} VALUES({})", sqlName(layer_.name), values)));
  VORPIPE_LET(tree_insertion, prepare(fmt::format("INSERT INTO {} VALUES(?,?,?,?,?)", treeName(layer_))));
  for (std::size_t index = 0; index < count; ++index) {
    sqlite3_clear_bindings(insertion.get());
    FeatureRow row(insertion.get(), reference_.id);
    if (!fill(index, row)) continue;
    if (row.code() != SQLITE_OK) return failed(row.code());
    VORPIPE_TRY(step(insertion));
    if (!row.box()) continue;
    VORPIPE_TRY(addToTree(tree_insertion, *row.box()));
  }
  return {};
}

Result<void> LayerWriter::write() {
  std::string box;
  if (box_) {
    box = fmt::format("UPDATE gpkg_contents SET min_x={},min_y={},max_x={},max_y={} WHERE table_name={};\n",
                      box_->xmin, box_->ymin, box_->xmax, box_->ymax, sqlText(layer_.name));
  }
  VORPIPE_TRY(execute(box + treeTriggers(layer_) + "COMMIT;"));
  sqlite3_int64 size = 0;
  const unsigned char* const bytes =
      sqlite3_serialize(database_.get(), "main", &size, SQLITE_SERIALIZE_NOCOPY);
  if (bytes == nullptr) return deviceError(sink_.name() + ": SQLite does not hand over what it has written");
  return sink_.write({reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)});
}

template <class Number>
Number numberOf(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

void FeatureRow::note(int code) {
  if (code_ == SQLITE_OK) code_ = code;
}

void FeatureRow::setGeometry(const Wkb& geometry) {
  // Version 1 of the header, in little-endian order, with an envelope of x and y.
  constexpr char version = 0, flags = 0b0000'0011;
  Bytes blob;
  blob.append(std::string_view("GP"));
  blob.push_back(version);
  blob.push_back(flags);
  appendNumber<std::endian::little>(blob, system_);
  const Box& box = geometry.box();
  for (const double bound : {box.xmin, box.xmax, box.ymin, box.ymax}) {
    appendNumber<std::endian::little>(blob, bound);
  }
  blob.append(geometry.bytes());
  note(sqlite3_bind_blob64(insertion_, 1, blob.data(), blob.size(), SQLITE_TRANSIENT));
  box_ = box;
}

void FeatureRow::add(std::int64_t value) { note(sqlite3_bind_int64(insertion_, ++column_, value)); }
void FeatureRow::add(double value) { note(sqlite3_bind_double(insertion_, ++column_, value)); }
void FeatureRow::add(std::string_view value) {
  note(sqlite3_bind_text64(insertion_, ++column_, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}
void FeatureRow::addMissing() { ++column_; }

void addValue(FeatureRow& row, const Attribute& attribute, std::size_t site) {
  const auto value = attribute.at(site);
  if (!value) return row.addMissing();
  switch (attribute.type()) {
    case AttributeType::integer:
      return row.add(numberOf<std::int64_t>(*value));
    case AttributeType::real:
      return row.add(numberOf<double>(*value));
    case AttributeType::boolean:
      return row.add(std::int64_t{*value == "true"});
    case AttributeType::text:
    case AttributeType::json:
      break;
  }
  row.add(std::string_view(utf8Of(*value)));
}

Result<void> writeGeoPackage(ByteSink& sink, const Layer& layer, std::size_t count, const FillRow& fill) {
  LayerWriter file(sink, layer);
  VORPIPE_TRY(file.createTables());
  VORPIPE_TRY(file.insertFeatures(count, fill));
  return file.write();
}

}  // namespace vorpipe
