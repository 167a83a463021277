#include "io/base/line_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"

namespace vorpipe {
namespace {

const char* findLineEnd(const char* first, const char* last) {
  return std::find_if(first, last, [](char c) { return c == '\n' || c == '\r'; });
}

}  // namespace

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

LineReader::LineReader(InputFile file)
    : file_(std::move(file)), buffer_(std::make_unique_for_overwrite<char[]>(longest_line)) {}

tl::unexpected<Error> LineReader::errorAt(std::size_t column, std::string_view what) const {
  return inputError(fmt::format("{}:{}:{}: {}", name(), number_, column, what));
}

Result<void> LineReader::refill() {
  std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  const std::size_t room = longest_line - end_;
  VORPIPE_LET(got, file_.read(std::span(buffer_.get() + end_, room)));
  end_ += got;
  at_end_ = got < room;
  return {};
}

Result<std::string_view> LineReader::wholeLines() {
  const auto atHand = [this] {
    const std::string_view text(buffer_.get() + begin_, end_ - begin_);
    return text.substr(0, text.rfind('\n') + 1);  // npos + 1 is 0
  };
  if (auto lines = atHand(); !lines.empty() || at_end_) return lines;
  VORPIPE_TRY(refill());
  return atHand();
}

void LineReader::skip(std::size_t bytes, std::uint64_t lines) {
  begin_ += bytes;
  number_ += lines;
}

std::optional<std::string_view> LineReader::takeUntil(const char* end) {
  const char* const last = buffer_.get() + end_;
  std::string_view line(buffer_.get() + begin_, end);
  if (end == last && line.empty()) return std::nullopt;
  const bool two = end + 1 < last && end[0] == '\r' && end[1] == '\n';
  begin_ = std::min(end_, begin_ + line.size() + (two ? 2 : 1));
  return number_ == 1 ? withoutByteOrderMark(line) : line;
}

Result<std::optional<std::string_view>> LineReader::next() {
  ++number_;
  std::size_t searched = begin_;
  while (true) {
    const char* const last = buffer_.get() + end_;
    const char* const found = findLineEnd(buffer_.get() + searched, last);
    // A CR at the very end of the buffer may have its LF in the next chunk.
    const bool whole = found != last && (*found == '\n' || found + 1 != last);
    if (whole || at_end_) return takeUntil(found);
    if (begin_ == 0 && end_ == longest_line) {
      return errorAt(1, fmt::format("the line is longer than {} bytes; is this a text file?", longest_line));
    }
    const auto seen = static_cast<std::size_t>(found - buffer_.get()) - begin_;
    VORPIPE_TRY(refill());
    searched = begin_ + seen;
  }
}

}  // namespace vorpipe
