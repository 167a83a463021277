#include "io/base/geopackage.h"

#include <fmt/core.h>
#include <sqlite3.h>

#include <algorithm>
#include <limits>

#include "base/try.h"
#include "io/base/byte_order.h"
#include "io/base/error.h"
#include "io/base/geopackage_tables.h"
#include "io/base/sqlite.h"

namespace vorpipe {
namespace {

/// A file in memory that is being filled.
class Filling {
 public:
  Filling(ByteSink& sink, const Layer& layer) : sink_(sink), layer_(layer) {}

  Result<void> open();
  Result<void> createTables();
  Result<void> fillFeatures(std::size_t count, const FillRow& fill);
  Result<void> close();
  Result<void> write();

 private:
  /// Returns SQLite's message about what went wrong.
  [[nodiscard]] tl::unexpected<Error> failed(int code) const;
  Result<void> execute(const std::string& sql);
  Result<Statement> prepare(const std::string& sql);
  Result<void> step(const Statement& statement);
  Result<void> noteInTree(const Statement& insertion, const Box& box);
  [[nodiscard]] std::string treeInsertion() const {
    return fmt::format("INSERT INTO {} VALUES(?,?,?,?,?)", sqlName("rtree_" + layer_.name + "_geom"));
  }

  ByteSink& sink_;
  const Layer& layer_;
  Database database_;
  SpatialReference reference_{};
  Box box_{};
  bool any_ = false;  ///< whether there is a geometry
};

tl::unexpected<Error> Filling::failed(int code) const {
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

Result<void> Filling::execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return failed(code);
  return {};
}

Result<Statement> Filling::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr);
  if (code != SQLITE_OK) return failed(code);
  return Statement(statement);
}

Result<void> Filling::step(const Statement& statement) {
  const int code = sqlite3_step(statement.get());
  if (code != SQLITE_DONE) return failed(code);
  sqlite3_reset(statement.get());
  return {};
}

Result<void> Filling::open() {
  // SQLite's "memdb" file system keeps it in one piece, so that sqlite3_serialize makes no copy.
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2("layer", &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, "memdb");
  database_.reset(database);
  if (code != SQLITE_OK) return failed(code);
  sqlite3_int64 limit = std::numeric_limits<sqlite3_int64>::max();
  sqlite3_file_control(database, "main", SQLITE_FCNTL_SIZE_LIMIT, &limit);
  return execute(
      "PRAGMA page_size=4096; PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA encoding='UTF-8';"
      "PRAGMA application_id=1196444487; PRAGMA user_version=10300;");
}

Result<void> Filling::createTables() {
  reference_ = referenceOf(layer_.system);
  return execute("BEGIN;" + geoPackageTables(reference_) + layerTable(layer_, reference_) +
                 treeTable(layer_));
}

Result<void> Filling::noteInTree(const Statement& insertion, const Box& box) {
  box_ = any_ ? Box{std::min(box_.xmin, box.xmin), std::min(box_.ymin, box.ymin),
                    std::max(box_.xmax, box.xmax), std::max(box_.ymax, box.ymax)}
              : box;
  any_ = true;
  int column = 0;
  sqlite3_bind_int64(insertion.get(), ++column, sqlite3_last_insert_rowid(database_.get()));
  for (const double bound : {box.xmin, box.xmax, box.ymin, box.ymax}) {
    sqlite3_bind_double(insertion.get(), ++column, bound);
  }
  return step(insertion);
}

Result<void> Filling::fillFeatures(std::size_t count, const FillRow& fill) {
  const auto insertion = prepare(featureInsertion(layer_));
  if (!insertion) return tl::unexpected(insertion.error());
  const auto tree_insertion = prepare(treeInsertion());
  if (!tree_insertion) return tl::unexpected(tree_insertion.error());
  for (std::size_t index = 0; index < count; ++index) {
    sqlite3_clear_bindings(insertion->get());
    FeatureRow row(insertion->get(), reference_.id);
    if (!fill(index, row)) continue;
    if (row.code() != SQLITE_OK) return failed(row.code());
    VORPIPE_TRY(step(*insertion));
    if (!row.box()) continue;
    VORPIPE_TRY(noteInTree(*tree_insertion, *row.box()));
  }
  return {};
}

Result<void> Filling::close() {
  return execute((any_ ? contentsBox(layer_, box_) : std::string()) + treeTriggers(layer_) + "COMMIT;");
}

Result<void> Filling::write() {
  sqlite3_int64 size = 0;
  const unsigned char* const bytes =
      sqlite3_serialize(database_.get(), "main", &size, SQLITE_SERIALIZE_NOCOPY);
  if (bytes == nullptr) return deviceError(sink_.name() + ": SQLite does not hand over what it has written");
  return sink_.write({reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)});
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

void FeatureRow::add(std::int64_t value) { note(sqlite3_bind_int64(insertion_, next(), value)); }
void FeatureRow::add(double value) { note(sqlite3_bind_double(insertion_, next(), value)); }
void FeatureRow::add(std::string_view value) {
  note(sqlite3_bind_text64(insertion_, next(), value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}
void FeatureRow::addMissing() { ++column_; }

Result<void> writeGeoPackage(ByteSink& sink, const Layer& layer, std::size_t count, const FillRow& fill) {
  Filling file(sink, layer);
  return file.open()
      .and_then([&] { return file.createTables(); })
      .and_then([&] { return file.fillFeatures(count, fill); })
      .and_then([&] { return file.close(); })
      .and_then([&] { return file.write(); });
}

}  // namespace vorpipe
