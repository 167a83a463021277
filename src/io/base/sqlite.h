/// Owning handles of SQLite databases and statements, and SQL quoting.
#pragma once

#include <cstddef>
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
std::string placeOf(const std::string& path, std::span<const char, sqlite_header_size> header);

}  // namespace vorpipe
