/// Databases and statements of SQLite that end with their owners, and words of SQL.
#pragma once

#include <memory>
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

}  // namespace vorpipe
