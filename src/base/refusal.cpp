#include "base/refusal.h"

#include <utility>

namespace vorpipe {

std::string_view nameOf(Subject subject) {
  switch (subject) {
    case Subject::none:
      break;
    case Subject::sites:
      return "sites";
    case Subject::weights:
      return "weights";
    case Subject::domain:
      return "domain";
    case Subject::outline:
      return "outline";
    case Subject::period:
      return "period";
    case Subject::density:
      return "density";
    case Subject::search:
      return "search";
    case Subject::masses:
      return "masses";
  }
  return {};
}

Error refusal(Subject subject, std::string message) {
  return {ErrorCode::input, std::move(message), /*out_of_memory=*/false, subject};
}

Error refusalOf(Subject subject, const std::string& message) {
  return refusal(subject, std::string(nameOf(subject)) + ": " + message);
}

}  // namespace vorpipe
