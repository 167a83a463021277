#include "io/base/sqlite.h"

#include <fmt/core.h>
#include <sqlite3.h>

#include <filesystem>
#include <system_error>

namespace vorpipe {
namespace {

std::string quotedIn(char quote, std::string_view text) {
  std::string quoted(1, quote);
  for (const char c : text) quoted.append(c == quote ? 2 : 1, c);
  return quoted + quote;
}

/// Whether the file beside a WAL database may hold changes.
bool hasChangesBeside(const std::string& path) {
  std::error_code unknown;
  const auto real = std::filesystem::canonical(path, unknown);
  const auto size = std::filesystem::file_size(real.string() + "-wal", unknown);
  return !unknown && size > 0;
}

}  // namespace

void SqliteClose::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void SqliteFinalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

std::string sqlName(std::string_view name) { return quotedIn('"', name); }
std::string sqlText(std::string_view text) { return quotedIn('\'', text); }

std::string placeOf(const std::string& path, std::span<const char, sqlite_header_size> header) {
  constexpr std::size_t read_version = 19;
  constexpr char wal = 2;
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.~/";
  // SQLite gets only a path, even for ":memory:" or a path that begins like an address.
  std::string place = path.starts_with('/') ? "file:" : "file:./";
  for (const char c : path) {
    place += plain.find(c) != std::string_view::npos ? std::string(1, c)
                                                     : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return header[read_version] == wal && !hasChangesBeside(path) ? place + "?immutable=1" : place;
}

}  // namespace vorpipe
