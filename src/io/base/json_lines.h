/// JSON texts, one on a line. What includes this compiles the parser.
#pragma once

#include <fmt/core.h>

#include <string_view>
#include <utility>

#include "io/base/error.h"
#include "io/base/json_parser.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"

namespace vorpipe {

/// The bytes of a line of JSON; RFC 8142 has one before it that is none.
inline std::string_view withoutSeparator(std::string_view line) {
  line = trimmed(line);
  return line.starts_with('\x1E') ? trimmed(line.substr(1)) : line;
}

/// Calls take(value) with what each line that is not blank holds; it returns what is wrong with it, if there
/// is anything, which is put behind the line's place. Errors: those of reading and parsing (input, device).
template <class Json, class Take>
Result<void> eachJsonLine(LineReader& lines, const Take& take) {
  while (true) {
    const auto line = lines.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line) return {};
    const std::string_view text = withoutSeparator(**line);
    if (text.empty()) continue;
    JsonBytes bytes(lines.name(), text);
    bytes.setPlace(lines.number(), static_cast<std::size_t>(text.data() - (*line)->data()));
    const auto value = parseJson<Json>(bytes);
    if (!value) return tl::unexpected(value.error());
    if (const auto problem = take(*value)) {
      return inputError(fmt::format("{}:{}: {}", lines.name(), lines.number(), *problem));
    }
  }
}

}  // namespace vorpipe
