/// Databases and statements of SQLite that end with their owners, and words of SQL.
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

/// A name, or a text, in SQL.
std::string sqlName(std::string_view name);
std::string sqlText(std::string_view text);

/// The bytes that a database begins with, about itself.
inline constexpr std::size_t sqlite_header_size = 100;

/// A file as an address for SQLITE_OPEN_URI. A database in the mode WAL without changes beside it is read as
/// one that nobody changes: else SQLite makes files beside it, and does not read it where it cannot.
std::string placeOf(const std::string& path, std::span<const char, sqlite_header_size> header);

}  // namespace vorpipe
