/// Names in any case.
#pragma once

#include <string>
#include <string_view>

namespace vorpipe {

/// With the letters of ASCII as small ones.
inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return lower;
}

}  // namespace vorpipe
