/// SQLite: owning handles, quoting, and limits on what a database of unknown origin can make it do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace vorpipe {

struct SqliteClose {
  void operator()(sqlite3* database) const;
};
struct SqliteFinalize {
  void operator()(sqlite3_stmt* statement) const;
};
using Database = std::unique_ptr<sqlite3, SqliteClose>;
using Statement = std::unique_ptr<sqlite3_stmt, SqliteFinalize>;

/// Quotes a name, or a text, for SQL.
std::string sqlName(std::string_view name);
std::string sqlText(std::string_view text);

/// Size of the header of a database file, in bytes.
inline constexpr std::size_t sqlite_header_size = 100;

/// Returns a file's address for SQLITE_OPEN_URI. A WAL database without changes beside it is read as
/// immutable: else SQLite creates files beside it, and cannot read it if that fails.
std::string sqliteAddress(const std::string& path, std::span<const char, sqlite_header_size> header);

/// Bounds what views and generated columns, which are programs, can do: the work, time and memory of all
/// queries of one database, in proportion to its file. Nothing is written to temporary files.
class QueryLimits {
 public:
  /// Applies the bounds to a database of `file_bytes` bytes; it must not outlive this object. Returns
  /// SQLite's code.
  int apply(sqlite3* database, std::uint64_t file_bytes);

  /// Prepares a query as sqlite3_prepare_v2 does, and returns its code.
  int prepare(const std::string& sql, sqlite3_stmt*& statement) const;

  /// Why a query was refused, after SQLite's codes SQLITE_AUTH and SQLITE_INTERRUPT.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  /// Whether a query may continue.
  bool mayContinue();
  int allow(int action, const char* function);

  sqlite3* database_ = nullptr;
  std::uint64_t steps_left_ = 0;  ///< in portions
  double last_second_ = 0;        ///< of the thread's processor time
  std::int64_t most_memory_ = 0;  ///< that SQLite may have in this process
  bool slow_ = false;             ///< a query calls a function that takes time quadratic in its text
  std::string refusal_;
};

}  // namespace vorpipe
