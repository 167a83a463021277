#include "io/base/sqlite.h"

#include <fmt/core.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <string_view>
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

constexpr int steps_at_a_time = 200;

/// Functions that views of maps call; their work is proportional to their arguments and results.
constexpr auto functions = std::to_array<std::string_view>(
    {"->",         "->>",        "abs",          "acos",       "acosh",     "asin",         "asinh",
     "atan",       "atan2",      "atanh",        "avg",        "ceil",      "ceiling",      "char",
     "coalesce",   "concat",     "concat_ws",    "cos",        "cosh",      "count",        "cume_dist",
     "date",       "datetime",   "degrees",      "dense_rank", "exp",       "first_value",  "floor",
     "format",     "glob",       "group_concat", "hex",        "ifnull",    "iif",          "json_extract",
     "julianday",  "lag",        "last_value",   "lead",       "length",    "like",         "likelihood",
     "likely",     "ln",         "log",          "log10",      "log2",      "lower",        "max",
     "min",        "mod",        "nth_value",    "ntile",      "nullif",    "octet_length", "percent_rank",
     "pi",         "pow",        "power",        "printf",     "quote",     "radians",      "rank",
     "round",      "row_number", "sign",         "sin",        "sinh",      "sqrt",         "strftime",
     "string_agg", "substr",     "substring",    "sum",        "tan",       "tanh",         "time",
     "total",      "trunc",      "typeof",       "unicode",    "unixepoch", "unlikely",     "upper"});

/// The same for short texts only: these compare all of one text with all of another.
constexpr auto slow_functions =
    std::to_array<std::string_view>({"instr", "ltrim", "replace", "rtrim", "trim"});

/// Processor time of this thread: a sleeping machine or a slow disk does not count.
double processorSeconds() {
  constexpr double nanosecond = 1e-9;
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * nanosecond;
}

/// Bounds SQLite's memory, for the whole process. Used while SQLite calls no handler: it expands views that
/// name each other twice before a query runs.
class HeapLimit {
 public:
  explicit HeapLimit(std::int64_t most) : soft_(sqlite3_soft_heap_limit64(-1)) {
    hard_ = sqlite3_hard_heap_limit64(most);
  }
  ~HeapLimit() {
    sqlite3_hard_heap_limit64(hard_);
    sqlite3_soft_heap_limit64(soft_);
  }
  HeapLimit(const HeapLimit&) = delete;
  HeapLimit& operator=(const HeapLimit&) = delete;

 private:
  inline static std::mutex mutex;
  std::lock_guard<std::mutex> alone_{mutex};
  std::int64_t soft_, hard_ = 0;
};

}  // namespace

void SqliteClose::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void SqliteFinalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

std::string sqlName(std::string_view name) { return quotedIn('"', name); }
std::string sqlText(std::string_view text) { return quotedIn('\'', text); }

std::string sqliteAddress(const std::string& path, std::span<const char, sqlite_header_size> header) {
  constexpr std::size_t read_version = 19;
  constexpr char wal = 2;
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.~/";
  // SQLite gets only a path, even for ":memory:" or a path that begins like an address.
  std::string address = path.starts_with('/') ? "file:" : "file:./";
  for (const char c : path) {
    address += plain.find(c) != std::string_view::npos
                   ? std::string(1, c)
                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return header[read_version] == wal && !hasChangesBeside(path) ? address + "?immutable=1" : address;
}

bool QueryLimits::mayContinue() {
  if (sqlite3_memory_used() > most_memory_) {
    refusal_ = "it asks for more memory than a file of its size has";
  } else if (steps_left_ == 0 || processorSeconds() > last_second_) {
    refusal_ = "it asks for far more work than a file of its size has";
  }
  return refusal_.empty();
}

int QueryLimits::allow(int action, const char* function) {
  if (!mayContinue()) return SQLITE_DENY;
  if (action == SQLITE_RECURSIVE) {
    refusal_ = "a view in it is recursive, and may never end; save the layer as a table";
  } else if (action == SQLITE_FUNCTION) {
    const std::string_view name(function);
    const bool slow = std::ranges::find(slow_functions, name) != slow_functions.end();
    slow_ = slow_ || slow;
    if (!slow && std::ranges::find(functions, name) == functions.end()) {
      refusal_ =
          fmt::format("SQL in it calls {}, which is left to no file; save the layer as a table", function);
    }
  }
  return refusal_.empty() ? SQLITE_OK : SQLITE_DENY;
}

int QueryLimits::apply(sqlite3* database, std::uint64_t file_bytes) {
  constexpr std::uint64_t shortest = std::uint64_t{1} << 16, longest = 1'000'000'000;
  constexpr std::uint64_t few_steps = 100'000'000, steps_of_byte = 1000;
  constexpr std::uint64_t little_memory = std::uint64_t{1} << 26, memory_of_byte = 8;
  constexpr double few_seconds = 10, seconds_of_byte = 2e-6;
  // Enough for the most columns of a layer; each takes some instructions.
  constexpr int instructions = 25'000, pattern = 100;
  database_ = database;
  // Views may not call functions with side effects.
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, static_cast<int>(std::clamp(file_bytes, shortest, longest)));
  sqlite3_limit(database, SQLITE_LIMIT_VDBE_OP, instructions);
  sqlite3_limit(database, SQLITE_LIMIT_LIKE_PATTERN_LENGTH, pattern);
  // Sorting or joining takes more steps than there are bytes, but at most this multiple.
  steps_left_ = (few_steps + file_bytes * steps_of_byte) / steps_at_a_time;
  last_second_ = processorSeconds() + few_seconds + static_cast<double>(file_bytes) * seconds_of_byte;
  most_memory_ =
      sqlite3_memory_used() + static_cast<std::int64_t>(little_memory + file_bytes * memory_of_byte);
  // Sorted data stay in memory, which is counted; temporary files would not be.
  const int code = sqlite3_exec(database, "PRAGMA cell_size_check = ON; PRAGMA temp_store = MEMORY", nullptr,
                                nullptr, nullptr);
  if (code != SQLITE_OK) return code;
  const auto step = [](void* limits) {
    auto& its = *static_cast<QueryLimits*>(limits);
    const bool continues = its.mayContinue();
    if (continues) --its.steps_left_;
    return continues ? 0 : 1;
  };
  sqlite3_progress_handler(database, steps_at_a_time, step, this);
  const auto authorize = [](void* limits, int action, const char*, const char* function, const char*,
                            const char*) {
    return static_cast<QueryLimits*>(limits)->allow(action, function);
  };
  return sqlite3_set_authorizer(database, authorize, this);
}

int QueryLimits::prepare(const std::string& sql, sqlite3_stmt*& statement) const {
  constexpr int short_value = 4096;
  const HeapLimit nested_views(most_memory_);
  const int code = sqlite3_prepare_v2(database_, sql.c_str(), -1, &statement, nullptr);
  if (slow_) sqlite3_limit(database_, SQLITE_LIMIT_LENGTH, short_value);
  return code;
}

}  // namespace vorpipe
