#include "cli/manual/brief.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace vorpipe::cli {

std::string briefly(const std::string& description) {
  constexpr std::array<std::string_view, 4> ends = {":", ";", " [", ". "};
  std::size_t end = description.size();
  for (const std::string_view mark : ends) end = std::min(end, description.find(mark));
  return description.substr(0, end);
}

}  // namespace vorpipe::cli
