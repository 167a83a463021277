#include "io/text/json_bytes.h"

#include <fmt/core.h>

#include <span>

namespace vorpipe {

bool JsonBytes::refill() {
  if (file_ == nullptr) return false;
  const auto got = file_->read(buffer_);
  if (!got) stopped_ = got.error();
  if (!got || *got == 0) return false;
  rest_ = std::string_view(buffer_.data(), *got);
  return true;
}

std::optional<char> JsonBytes::peek() {
  if (!stopped_ && (!rest_.empty() || (!at_end_ && refill()))) return rest_.front();
  if (!at_end_) {
    // The parser counts the end as if it were a byte.
    at_end_ = true;
    ++count_;
    if (after_line_end_) last_ = {last_.line + 1, 0};
    ++last_.column;
  }
  return std::nullopt;
}

void JsonBytes::take() {
  constexpr std::string_view in_numbers = "0123456789+-.eE";
  const char c = rest_.front();
  rest_.remove_prefix(1);
  ++count_;
  if (after_line_end_) last_ = {last_.line + 1, 0};
  ++last_.column;
  after_line_end_ = c == '\n';
  const bool in_number = in_numbers.find(c) != std::string_view::npos;
  if (in_number && !in_number_) number_ = last_;
  in_number_ = in_number;
}

tl::unexpected<Error> JsonBytes::errorAt(std::size_t back, std::string_view what) const {
  return inputError(fmt::format("{}:{}:{}: {}", name_, last_.line, last_.column - back, what));
}

tl::unexpected<Error> JsonBytes::errorAtNumber(std::string_view what) const {
  return inputError(fmt::format("{}:{}:{}: {}", name_, number_.line, number_.column, what));
}

}  // namespace vorpipe
