#include "io/cells/pieces_file.h"

#include <algorithm>
#include <array>
#include <new>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/field_text.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cells_writers.h"

namespace vorpipe {
namespace {

/// A number of a piece, under its name.
struct PieceNumber {
  std::string_view name;
  double value;
};

/// A piece: its feature, its site, and its numbers in the order of the fields.
struct Piece {
  std::uint32_t feature, site;
  std::array<PieceNumber, 6> numbers;
  std::size_t count = 0;

  void add(std::string_view name, double value) { numbers[count++] = {name, value}; }
  [[nodiscard]] std::span<const PieceNumber> all() const { return std::span(numbers).first(count); }
};

Piece pieceAt(const PiecesOutput& output, std::size_t k) {
  const Pieces& pieces = output.pieces;
  const Sites& sites = output.sites;
  Piece piece{pieces.region[k], pieces.site[k], {}};
  const double area = pieces.cells.area[k];
  piece.add("x", sites.x[piece.site]);
  piece.add("y", sites.y[piece.site]);
  if (!sites.weight.empty()) piece.add("weight", sites.weight[piece.site]);
  piece.add("area", area);
  if (output.square_kilometers) piece.add("area_km2", area * *output.square_kilometers);
  piece.add("share", area / pieces.region_area[piece.feature]);
  return piece;
}

/// The names of a piece's numbers; none if there are no pieces.
std::vector<std::string> numberNames(const PiecesOutput& output) {
  std::vector<std::string> names = {"x", "y"};
  if (!output.sites.weight.empty()) names.emplace_back("weight");
  names.emplace_back("area");
  if (output.square_kilometers) names.emplace_back("area_km2");
  names.emplace_back("share");
  return names;
}

Result<void> writeCsvPieces(ByteSink& sink, const PiecesOutput& output) {
  const auto names = pieceAttributeNames(output.by, output.attributes);
  Bytes header;
  printCsvField(header, names.front());
  header.append(std::string_view(",site"));
  printCsvNames(header, numberNames(output));
  printCsvNames(header, std::span(names).subspan(1));
  header.push_back('\n');
  VORPIPE_TRY(writeAll(sink, header));
  const auto put = [&](Bytes& text, std::size_t k) {
    const Piece piece = pieceAt(output, k);
    if (const auto name = output.by.at(piece.feature)) printCsvField(text, *name);
    print(text, FMT_COMPILE(",{}"), piece.site);
    for (const auto& [name, value] : piece.all()) print(text, FMT_COMPILE(",{}"), value);
    printCsvValues(text, output.attributes, piece.site);
    text.push_back('\n');
  };
  return writeEach(sink, output.pieces.size(), put, output.threads);
}

Result<void> writePieceFeatures(ByteSink& sink, FeaturesAs as, const PiecesOutput& output) {
  const auto keys = jsonKeys(pieceAttributeNames(output.by, output.attributes));
  const auto put = [&](Bytes& text, std::size_t k) {
    const Piece piece = pieceAt(output, k);
    print(text, FMT_COMPILE(R"({{"type":"Feature","id":{},"properties":{{)"), k);
    text.append(keys.front());
    printJsonValue(text, output.by, piece.feature);
    print(text, FMT_COMPILE(R"(,"site":{})"), piece.site);
    for (const auto& [name, value] : piece.all()) print(text, FMT_COMPILE(R"(,"{}":{})"), name, value);
    for (std::size_t a = 0; a < output.attributes.size(); ++a) {
      text.push_back(',');
      text.append(keys[a + 1]);
      printJsonValue(text, output.attributes[a], piece.site);
    }
    text.append(std::string_view("},"));
    printGeometry(text, {output.sites, output.pieces.cells, k, output.system});
    text.push_back('}');
    return true;
  };
  return writeFeatures(sink, as, output.pieces.size(), put, output.threads);
}

Result<void> writeGeojsonPieces(ByteSink& sink, const PiecesOutput& output) {
  return writePieceFeatures(sink, FeaturesAs::collection, output);
}

Result<void> writeGeojsonlPieces(ByteSink& sink, const PiecesOutput& output) {
  return writePieceFeatures(sink, FeaturesAs::lines, output);
}

/// A GeoPackage with the layer `pieces`, of MultiPolygons.
Result<void> writeGpkgPieces(ByteSink& sink, const PiecesOutput& output) {
  const auto names = pieceAttributeNames(output.by, output.attributes);
  std::vector<LayerField> fields;
  addAttributeFields(fields, {&output.by, 1}, std::span(names).first(1));
  fields.push_back({"site", AttributeType::integer});
  for (const std::string& name : numberNames(output)) fields.push_back({name, AttributeType::real});
  addAttributeFields(fields, output.attributes, std::span(names).subspan(1));
  const Layer layer{"pieces", GeometryType::multi_polygon, std::move(fields), output.system};
  Wkb wkb;
  return writeGeoPackage(sink, layer, output.pieces.size(), [&](std::size_t k, FeatureRow& row) {
    const Piece piece = pieceAt(output, k);
    setPolygons(row, wkb, {output.sites, output.pieces.cells, k, output.system});
    addValue(row, output.by, piece.feature);
    row.add(std::int64_t{piece.site});
    for (const PieceNumber& number : piece.all()) row.add(number.value);
    for (const Attribute& attribute : output.attributes) addValue(row, attribute, piece.site);
    return true;
  });
}

constexpr PiecesFormat csv_pieces{".csv", writeCsvPieces}, geojson_pieces{".geojson", writeGeojsonPieces},
    geojsonl_pieces{".geojsonl", writeGeojsonlPieces}, gpkg_pieces{".gpkg", writeGpkgPieces};
constexpr std::array pieces_formats{&csv_pieces, &geojson_pieces, &geojsonl_pieces, &gpkg_pieces};

}  // namespace

std::vector<std::string_view> piecesExtensions() {
  return extensionsOf(std::span<const PiecesFormat* const>(pieces_formats));
}

const PiecesFormat* piecesFormat(std::string_view extension) {
  const auto* const found = std::ranges::find(pieces_formats, extension, &PiecesFormat::extension);
  return found == pieces_formats.end() ? nullptr : *found;
}

Result<void> writePieces(ByteSink& sink, const PiecesOutput& output, const PiecesFormat& format) {
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write the pieces");
  }
}

}  // namespace vorpipe
