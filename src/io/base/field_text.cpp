#include "io/base/field_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>

#include "io/base/quoted.h"

namespace vorpipe {
namespace {

/// Whether a character needs no escape in a JSON string.
bool isPlain(char c) {
  constexpr unsigned char first_printable = 0x20, first_of_several = 0x80;
  const auto byte = static_cast<unsigned char>(c);
  return byte >= first_printable && byte < first_of_several && c != '"' && c != '\\';
}

bool isBlank(char c) { return c == ' ' || c == '\t'; }

/// Readers may guess the separator as the most frequent one in the header outside quotes, so all possible
/// separators need quotes.
bool needsQuotes(std::string_view field) {
  return field.empty() || isBlank(field.front()) || isBlank(field.back()) ||
         field.find_first_of("\",;\t\r\n") != std::string_view::npos;
}

}  // namespace

std::string jsonText(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string jsonString(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void printCsvField(Bytes& text, std::string_view field) {
  if (!needsQuotes(field)) return text.append(field);
  text.push_back('"');
  for (const char c : field) {
    if (c == '"') text.push_back('"');
    text.push_back(c);
  }
  text.push_back('"');
}

void printJsonString(Bytes& text, std::string_view string) {
  if (!std::ranges::all_of(string, isPlain)) return text.append(jsonString(string));
  text.push_back('"');
  text.append(string);
  text.push_back('"');
}

std::string utf8Of(std::string_view text) {
  if (isUtf8(text)) return std::string(text);
  return nlohmann::json::parse(jsonString(text)).get<std::string>();
}

}  // namespace vorpipe
