#include "io/base/json_parser.h"

#include <fmt/core.h>

#include "io/base/input_file.h"

namespace vorpipe {

/// Parsed values take up to `bytes_of_byte` bytes per byte of text, for lists of empty lists.
void JsonBytes::checkKept() {
  constexpr std::uint64_t bytes_of_byte = 40, little = 1 << 22;
  const std::uint64_t kept = count_ - kept_from_;
  if (kept < little) return;
  const auto what = fmt::format("{} MB of JSON in one piece", kept >> 20);
  if (auto room = checkRoom(fmt::format("{}:{}:{}", name_, line_, column()), what, kept * bytes_of_byte);
      !room)
    error_ = std::move(room.error());
}

bool JsonBytes::refill() {
  if (at_end_) return false;
  if (!error_ && file_ != nullptr) checkKept();
  if (!error_ && file_ != nullptr) {
    const auto got = file_->read(buffer_);
    if (!got) error_ = got.error();
    if (got && *got > 0) {
      next_ = buffer_.data();
      end_ = next_ + *got;
      return true;
    }
  }
  // The parser counts the end as if it were a byte.
  at_end_ = true;
  count(' ');
  return false;
}

void JsonBytes::stop(tl::unexpected<Error> error) {
  if (!error_) error_ = std::move(error.value());
  end_ = next_;
}

tl::unexpected<Error> JsonBytes::errorAt(std::size_t back, std::string_view what) const {
  return inputError(fmt::format("{}:{}:{}: {}", name_, line_, column() - back, what));
}

tl::unexpected<Error> JsonBytes::errorAtNumber(std::string_view what) const {
  return inputError(fmt::format("{}:{}:{}: {}", name_, number_line_, number_column_, what));
}

}  // namespace vorpipe
