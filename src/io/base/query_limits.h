/// Limits on what a database of unknown origin can make SQLite do: its views and generated columns are
/// programs.
#pragma once

#include <cstdint>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace vorpipe {

/// Bounds the work, time and memory of all queries of one database, in proportion to its file. Nothing is
/// written to temporary files.
class QueryLimits {
 public:
  /// Applies the bounds to a database of `file_bytes` bytes; it must not outlive this object. Returns
  /// SQLite's code.
  int hold(sqlite3* database, std::uint64_t file_bytes);

  /// Prepares a query as sqlite3_prepare_v2 does, and returns its code.
  int prepare(const std::string& sql, sqlite3_stmt*& statement) const;

  /// Why a query was refused, after SQLite's codes SQLITE_AUTH and SQLITE_INTERRUPT.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  /// Whether a query may continue.
  bool goesOn();
  int allow(int action, const char* function);

  sqlite3* database_ = nullptr;
  std::uint64_t steps_left_ = 0;  ///< in portions
  double last_second_ = 0;        ///< of the thread's processor time
  std::int64_t most_memory_ = 0;  ///< that SQLite may have in this process
  bool slow_ = false;             ///< a query calls a function that takes time quadratic in its text
  std::string refusal_;
};

}  // namespace vorpipe
