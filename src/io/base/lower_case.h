/// Case-insensitive names.
#pragma once

#include <string>
#include <string_view>

namespace vorpipe {

/// Returns `text` with ASCII letters in lower case.
inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return lower;
}

}  // namespace vorpipe
