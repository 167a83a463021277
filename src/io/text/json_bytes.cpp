#include "io/text/json_bytes.h"

#include <fmt/core.h>

namespace vorpipe {

bool JsonBytes::refill() {
  if (at_end_) return false;
  if (!stopped_ && file_ != nullptr) {
    const auto got = file_->read(buffer_);
    if (!got) stopped_ = got.error();
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
  if (!stopped_) stopped_ = std::move(error.value());
  end_ = next_;
}

tl::unexpected<Error> JsonBytes::errorAt(std::size_t back, std::string_view what) const {
  return inputError(fmt::format("{}:{}:{}: {}", name_, line_, column() - back, what));
}

tl::unexpected<Error> JsonBytes::errorAtNumber(std::string_view what) const {
  return inputError(fmt::format("{}:{}:{}: {}", name_, number_line_, number_column_, what));
}

}  // namespace vorpipe
