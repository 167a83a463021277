/// Text separated by commas, semicolons or tabs, record by record, through libcsv (decision D64).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/line_reader.h"

struct csv_parser;

namespace vorpipe {

class CsvReader {
 public:
  /// Without a separator, the first line determines it. Error (device): out of memory.
  static Result<CsvReader> create(LineReader lines, std::optional<char> separator = std::nullopt);

  /// Reads the next record, skipping blank lines and comments, which begin with #; false after the last one.
  /// Errors: a quote that is not closed or is inside an unquoted field, a line or a record that is too long,
  /// the text is UTF-16 (input); reading failed, out of memory (device).
  Result<bool> next();

  /// The lines after the last record, for a caller that parses them itself: see LineReader.
  Result<std::string_view> wholeLines() { return lines_.wholeLines(); }
  void skip(std::size_t bytes, std::uint64_t lines) { lines_.skip(bytes, lines); }

  /// Valid once a record was read.
  [[nodiscard]] char separator() const { return separator_.value_or(','); }
  /// Number of all comments if one follows the first record, where a line that begins with # may be meant as
  /// a record; else 0.
  [[nodiscard]] std::uint64_t comments() const { return late_comment_ ? comments_ : 0; }
  /// Number of the last line of the last record.
  [[nodiscard]] std::uint64_t line() const { return lines_.number(); }

  [[nodiscard]] std::size_t fields() const { return record_.ends.size(); }
  /// Text of a field of the last record, without its quotes and the blanks around it.
  [[nodiscard]] std::string_view field(std::size_t index) const;
  [[nodiscard]] const std::string& name() const { return lines_.name(); }

  /// "FILE:LINE:COLUMN: what" as an input error about the beginning of a field of the last record;
  /// index fields() is the end of the record.
  [[nodiscard]] tl::unexpected<Error> errorAt(std::size_t index, std::string_view what) const;
  /// The same about the beginning of the line that was read or skipped last.
  [[nodiscard]] tl::unexpected<Error> errorAtLine(std::string_view what) const {
    return lines_.errorAt(1, what);
  }

 private:
  struct Free {
    void operator()(csv_parser* parser) const;
  };
  using Parser = std::unique_ptr<csv_parser, Free>;

  struct Record {
    std::string text;               ///< all fields, one after the other
    std::vector<std::size_t> ends;  ///< where each ends in text
    bool complete = false;
    bool out_of_memory = false;
  };

  CsvReader(LineReader lines, Parser parser) : lines_(std::move(lines)), parser_(std::move(parser)) {}
  static Parser makeParser();
  Result<bool> isRecord(std::string_view line);
  void setSeparator(char separator);
  static void onField(void* text, std::size_t length, void* record);
  static void onRecordEnd(int character, void* record);
  Result<void> parse(std::string_view line);
  [[nodiscard]] std::size_t fieldBegin(std::size_t index) const;

  LineReader lines_;
  Parser parser_;
  std::optional<char> separator_;
  std::uint64_t comments_ = 0;
  bool begun_ = false;         ///< whether there was a record
  bool late_comment_ = false;  ///< whether a comment came after it
  Record record_;
  std::string earlier_;    ///< earlier lines of a record with a line end inside quotes, LF after each
  std::string_view line_;  ///< the line that was parsed last
};

}  // namespace vorpipe
