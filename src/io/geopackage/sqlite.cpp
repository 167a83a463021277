#include "io/geopackage/sqlite.h"

#include <sqlite3.h>

namespace vorpipe {
namespace {

std::string quotedIn(char quote, std::string_view text) {
  std::string quoted(1, quote);
  for (const char c : text) quoted.append(c == quote ? 2 : 1, c);
  return quoted + quote;
}

}  // namespace

void SqliteClose::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void SqliteFinalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

std::string sqlName(std::string_view name) { return quotedIn('"', name); }
std::string sqlText(std::string_view text) { return quotedIn('\'', text); }

}  // namespace vorpipe
