#include "io/base/geopackage_tables.h"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "io/base/sqlite.h"

namespace vorpipe {
namespace {

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

std::string_view sqlType(FieldType type) {
  switch (type) {
    case FieldType::integer:
      return "INTEGER";
    case FieldType::real:
      return "DOUBLE";
    case FieldType::boolean:
      return "BOOLEAN";
    case FieldType::text:
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

}  // namespace

SpatialReference referenceOf(const CoordinateSystem& system) {
  const auto [plane, degrees, wgs84] = standardReferences();
  const bool named = !system.organization.empty();
  if (!named && system.definition.empty()) {
    return system.kind == CoordinateKind::degrees ? degrees : plane;
  }
  if (system.organization == wgs84.organization && system.code == wgs84.code) return wgs84;
  const std::string definition = system.definition.empty() ? "undefined" : system.definition;
  // The id of a row is arbitrary; people look for the organization's code.
  const bool fits = named && system.code > 0 && system.code <= std::numeric_limits<std::int32_t>::max();
  const auto id = fits && system.code != wgs84.code ? static_cast<std::int32_t>(system.code) : first_own;
  if (!named) return {"Coordinate system of the input", id, "NONE", id, definition};
  return {fmt::format("{}:{}", system.organization, system.code), id, system.organization, system.code,
          definition};
}

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

std::string layerTable(const Layer& layer, const SpatialReference& reference) {
  std::string columns;
  for (const LayerField& field : layer.fields) {
    columns += fmt::format(", {} {}", sqlName(field.name), sqlType(field.type));
  }
  const std::string name = sqlText(layer.name);
  return fmt::format(
      "CREATE TABLE {} (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom {}{});\n"
      "INSERT INTO gpkg_contents "
      "VALUES({},'features',{},'','2000-01-01T00:00:00.000Z',NULL,NULL,NULL,NULL,{});\n"
      "INSERT INTO gpkg_geometry_columns VALUES({},'geom','{}',{},0,0);\n",
      sqlName(layer.name), typeName(layer.geometry), columns, name, name, reference.id, name,
      typeName(layer.geometry), reference.id);
}

std::string featureInsertion(const Layer& layer) {
  std::string values = "NULL,?";
  for (std::size_t k = 0; k < layer.fields.size(); ++k) values += ",?";
  return fmt::format("INSERT INTO {} VALUES({})", sqlName(layer.name), values);
}

std::string treeTable(const Layer& layer) {
  return fmt::format(
      "CREATE VIRTUAL TABLE {} USING rtree(id, minx, maxx, miny, maxy);\n"
      "INSERT INTO gpkg_extensions VALUES({},'geom','gpkg_rtree_index',"
      "'http://www.geopackage.org/spec120/#extension_rtree','write-only');\n",
      sqlName("rtree_" + layer.name + "_geom"), sqlText(layer.name));
}

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

std::string contentsBox(const Layer& layer, const Box& box) {
  return fmt::format("UPDATE gpkg_contents SET min_x={},min_y={},max_x={},max_y={} WHERE table_name={};\n",
                     box.xmin, box.ymin, box.xmax, box.ymax, sqlText(layer.name));
}

}  // namespace vorpipe
