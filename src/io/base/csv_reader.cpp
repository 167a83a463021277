#include "io/base/csv_reader.h"

#include <csv.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/number.h"

namespace vorpipe {
namespace {

constexpr std::string_view separators = ",;\t";

/// Returns how often a character occurs outside quotes.
std::size_t countOf(std::string_view line, char separator) {
  bool quoted = false;
  std::size_t count = 0;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == separator && !quoted) ++count;
  }
  return count;
}

/// Whether it separates two or more numbers.
bool separatesNumbers(std::string_view line, char separator) {
  std::size_t count = 0;
  while (true) {
    const std::size_t end = std::min(line.find(separator), line.size());
    const std::string_view field = line.substr(0, end);
    const bool number = separator == ',' ? parseNumber(field).has_value() : parseDecimal(field).has_value();
    if (!number) return false;
    ++count;
    if (end == line.size()) return count > 1;
    line.remove_prefix(end + 1);
  }
}

/// Returns the separator of a line's fields: comma, semicolon or tab. Prefers one with only numbers between,
/// which may have decimal commas unless it is a comma. Otherwise returns the most frequent one; a comma if
/// there is none.
char separatorOf(std::string_view line) {
  // In "1,5;2,5" counting does not help: it has as many commas as fields.
  for (const char separator : {';', '\t'}) {
    if (separatesNumbers(line, separator)) return separator;
  }
  return *std::ranges::max_element(separators, {}, [line](char c) { return countOf(line, c); });
}

/// Returns the separator that a line "sep=;" names; spreadsheets write it as the first line.
std::optional<char> namedSeparator(std::string_view line) {
  constexpr std::string_view name = "sep=";
  // A tab at the end may be the separator; spreadsheets quote the whole line.
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  while (line.size() > name.size() + 1 && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
  if (line.size() == name.size() + 3 && line.front() == '"' && line.back() == '"')
    line = line.substr(1, name.size() + 1);
  const bool named = line.size() == name.size() + 1 && lowerCase(line.substr(0, name.size())) == name;
  if (!named || separators.find(line.back()) == std::string_view::npos) return std::nullopt;
  return line.back();
}

}  // namespace

void CsvReader::Free::operator()(csv_parser* parser) const {
  csv_free(parser);
  delete parser;
}

void CsvReader::setSeparator(char separator) {
  separator_ = separator;
  csv_set_delim(parser_.get(), static_cast<unsigned char>(separator));
}

CsvReader::Parser CsvReader::makeParser() {
  auto raw = std::make_unique<csv_parser>();
  if (csv_init(raw.get(), CSV_STRICT | CSV_STRICT_FINI) != 0) return nullptr;
  return Parser(raw.release());
}

Result<CsvReader> CsvReader::create(LineReader lines, std::optional<char> separator) {
  Parser parser = makeParser();
  if (!parser) return deviceError(lines.name() + ": out of memory");
  CsvReader reader(std::move(lines), std::move(parser));
  if (separator) reader.setSeparator(*separator);
  return reader;
}

// C code calls the callbacks, and no exception may cross it.
void CsvReader::onField(void* text, std::size_t length, void* record) {
  auto& into = *static_cast<Record*>(record);
  try {
    into.text.append(static_cast<const char*>(text), length);
    into.ends.push_back(into.text.size());
  } catch (const std::bad_alloc&) {
    into.out_of_memory = true;
  }
}

void CsvReader::onRecordEnd(int /*character*/, void* record) {
  static_cast<Record*>(record)->complete = true;
}

std::string_view CsvReader::field(std::size_t index) const {
  const std::size_t begin = index == 0 ? 0 : record_.ends[index - 1];
  return std::string_view(record_.text).substr(begin, record_.ends[index] - begin);
}

Result<void> CsvReader::parse(std::string_view line) {
  line_ = line;
  const std::size_t parsed =
      csv_parse(parser_.get(), line.data(), line.size(), onField, onRecordEnd, &record_);
  const bool whole = parsed == line.size();
  if (whole) {
    csv_parse(parser_.get(), "\n", 1, onField, onRecordEnd, &record_);
  }
  switch (csv_error(parser_.get())) {
    case CSV_SUCCESS:
      break;
    case CSV_EPARSE:
      return lines_.errorAt(parsed + 1,
                            "a quote inside a field that does not begin with one, or text after a "
                            "closing quote");
    default:
      record_.out_of_memory = true;
  }
  if (record_.out_of_memory) {
    return deviceError(fmt::format("{}: out of memory at line {}", name(), lines_.number()));
  }
  return {};
}

/// Whether a line begins a record, rather than being a comment or naming the separator.
Result<bool> CsvReader::isRecord(std::string_view line) {
  if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF")) {
    return lines_.errorAt(1, "the text is UTF-16; UTF-8 is needed");
  }
  const std::string_view text = trimmed(line);
  if (text.starts_with('#')) {
    ++comments_;
    late_comment_ = late_comment_ || begun_;
    return false;
  }
  if (begun_ || text.empty()) return true;
  if (const auto separator = namedSeparator(line)) {
    setSeparator(*separator);
    return false;
  }
  if (!separator_) setSeparator(separatorOf(line));
  return true;
}

Result<bool> CsvReader::next() {
  record_.text.clear();
  record_.ends.clear();
  record_.complete = false;
  earlier_.clear();
  while (true) {
    line_ = {};
    VORPIPE_LET(line, lines_.next());
    if (!line && earlier_.empty()) return false;
    if (!line) return errorAt(fields(), "the quoted field that begins here does not end");
    if (earlier_.size() > LineReader::longest_line) {
      return errorAt(fields(), fmt::format("the quoted field that begins here is longer than {} bytes",
                                           LineReader::longest_line));
    }
    if (earlier_.empty()) {
      const auto record = isRecord(*line);
      if (!record) return record;
      if (!*record) continue;
    }
    VORPIPE_TRY(parse(*line));
    if (record_.complete) {
      begun_ = true;
      return true;
    }
    if (!earlier_.empty() || !trimmed(*line).empty()) {
      earlier_.append(*line) += '\n';
    }
  }
}

std::size_t CsvReader::fieldBegin(std::size_t index) const {
  const std::string record = earlier_ + std::string(line_);
  const Parser parser = makeParser();
  if (!parser || index == 0) return 0;
  csv_set_delim(parser.get(), static_cast<unsigned char>(separator()));
  Record replay;
  for (std::size_t i = 0; i < record.size(); ++i) {
    csv_parse(parser.get(), &record[i], 1, onField, onRecordEnd, &replay);
    if (replay.ends.size() == index) return i + 1;
  }
  return record.size();
}

tl::unexpected<Error> CsvReader::errorAt(std::size_t index, std::string_view what) const {
  const std::string record = earlier_ + std::string(line_);
  std::size_t begin = fieldBegin(index);
  begin = std::min(record.find_first_not_of(" \t", begin), record.size());
  const std::string_view before = std::string_view(record).substr(0, begin);
  const auto after = record.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto lines_after = static_cast<std::uint64_t>(std::count(after, record.end(), '\n'));
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return inputError(
      fmt::format("{}:{}:{}: {}", name(), lines_.number() - lines_after, begin - line_begin + 1, what));
}

}  // namespace vorpipe
