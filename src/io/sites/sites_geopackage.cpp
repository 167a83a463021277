#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/feature_layer.h"
#include "io/base/geometry_bytes.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/base/read_log.h"
#include "io/base/shapefile.h"
#include "io/sites/site_columns.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"

namespace vorpipe {
namespace {

class GeoPackageSites {
 public:
  GeoPackageSites(const std::string& path, FeatureLayer layer, const ReadOptions& options)
      : layer_(std::move(layer)), table_(path, options) {}

  Result<SiteTable> read() {
    VORPIPE_TRY(findColumns());
    table_.system() = layer_.system();
    for (std::uint64_t row = 1;; ++row) {
      VORPIPE_LET(more, layer_.next());
      if (!more) return finish();
      table_.setPlace([&] { return fmt::format("row {}", row); });
      if (const auto problem = addRow()) {
        return inputError(
            fmt::format("{}: layer {}, row {}: {}", table_.name(), printable(layer_.name()), row, *problem));
      }
    }
  }

 private:
  Result<void> findColumns() {
    const auto& columns = layer_.columns();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto kind = weightNamed(columns[k].name, false);
      if (kind && weight_) {
        return inputError(fmt::format("{}: layer {} has both {} and {}; keep one", table_.name(),
                                      printable(layer_.name()), printable(columns[*weight_].name),
                                      printable(columns[k].name)));
      }
      if (kind) {
        weight_ = k;
        kind_ = *kind;
        continue;
      }
      const std::size_t to = table_.attributes().newColumn(columns[k].name);
      table_.attributes().setType(to, columns[k].type);
      attributes_.emplace_back(k, to);
    }
    if (weight_ && columns[*weight_].name != "weight" && columns[*weight_].name != "radius") {
      table_.note(
          fmt::format("the column {} is taken as {}", inQuotes(columns[*weight_].name), meaningOf(kind_)));
    }
    return {};
  }

  RowProblem addRow() {
    points_.clear();
    bool heights = false;
    if (const auto geometry = layer_.geometry()) {
      const auto taken = takeGeometryPoints(*geometry, points_, heights);
      if (!taken) return taken.error();
    }
    if (heights) table_.noteHeights();
    if (points_.empty()) return table_.addMissing("has no place; --missing skip leaves such out");
    std::optional<double> weight;
    if (weight_) {
      const auto value = layer_.value(*weight_);
      if (!value) {
        return table_.addMissing(fmt::format("its {} is null; --missing skip leaves such out",
                                             printable(layer_.columns()[*weight_].name)));
      }
      const auto number = parseNumber(value->second);
      if (!number) return number.error();
      const auto valid = weightOf(kind_, *number, value->second);
      if (!valid) return valid.error();
      weight = *valid;
    }
    if (table_.attributes().kept()) setAttributes();
    return table_.addRow(points_, weight);
  }

  void setAttributes() {
    for (const auto& [from, to] : attributes_) {
      const auto value = layer_.value(from);
      if (!value) continue;
      const auto& [type, text] = *value;
      const bool other = type == AttributeType::text && !isUtf8(text);
      other_text_ = other_text_ || other;
      table_.attributes().set(to, type, other ? fromWindows1252(text) : text);
    }
  }

  SiteTable finish() {
    if (!layer_.binary().empty()) {
      table_.note(fmt::format("columns of bytes are left out: {}", fmt::join(layer_.binary(), ", ")));
    }
    if (other_text_) table_.note("has text that is not UTF-8, which is taken as Windows-1252");
    return table_.finish();
  }

  FeatureLayer layer_;
  TableBuilder table_;
  std::optional<std::size_t> weight_;
  WeightKind kind_ = WeightKind::weight;
  std::vector<std::pair<std::size_t, std::size_t>>
      attributes_;  ///< columns of the layer and of the attributes
  std::vector<Point> points_;
  bool other_text_ = false;
};

}  // namespace

Result<SiteTable> readGeoPackageSites(const std::string& path, const ReadOptions& options) {
  VORPIPE_VAR(layer, FeatureLayer::open(path, options.layer, LayerOf::points));
  return GeoPackageSites(path, std::move(layer), options).read();
}

Result<SiteTable> readShapefileSites(const std::string& path, const ReadOptions& options) {
  VORPIPE_LET(converted, ConvertedShapefile::of(path));
  const ReadLog::Pause pause;
  VORPIPE_VAR(layer, FeatureLayer::open(path, {}, LayerOf::points, converted.file()));
  VORPIPE_VAR(table, GeoPackageSites(path, std::move(layer), options).read());
  // The number of a row, which GDAL adds, is no attribute of the file.
  std::erase_if(table.attributes, [](const Attribute& attribute) { return attribute.name() == "fid"; });
  return table;
}

}  // namespace vorpipe
