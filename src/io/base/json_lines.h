/// JSON texts, one per line. Including this header compiles the parser.
#pragma once

#include <fmt/core.h>

#include <string_view>
#include <utility>

#include "io/base/error.h"
#include "io/base/json_parser.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"

namespace vorpipe {

/// Returns the JSON of a line, without the separator that RFC 8142 puts before it.
inline std::string_view withoutSeparator(std::string_view line) {
  line = trimmed(line);
  return line.starts_with('\x1E') ? trimmed(line.substr(1)) : line;
}

/// Calls take(value) for each nonblank line. take returns what is wrong with the value, if anything; the
/// error puts the line's place before it. Errors: those of reading and parsing (input, device).
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
