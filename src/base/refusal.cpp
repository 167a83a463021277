#include "base/refusal.h"

#include <array>
#include <utility>

namespace vorpipe {

std::string_view nameOf(Subject subject) {
  constexpr std::array<std::string_view, 9> names{"",       "sites",   "weights", "domain", "outline",
                                                  "period", "density", "search",  "masses"};
  return names[static_cast<std::size_t>(subject)];
}

Error refusal(Subject subject, std::string message) {
  return {ErrorCode::input, std::move(message), /*out_of_memory=*/false, subject};
}

Error refusalOf(Subject subject, const std::string& message) {
  return refusal(subject, std::string(nameOf(subject)) + ": " + message);
}

}  // namespace vorpipe
