/// Writes JSON as text; separate because the JSON library's writer takes long to compile.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace vorpipe {

/// Returns the text with a final line end. Invalid UTF-8 is replaced: a driver's name may hold any bytes.
std::string jsonText(const nlohmann::ordered_json& json, int indent);

/// Returns UTF-8 text as a JSON string in double quotes.
std::string jsonString(std::string_view text);

}  // namespace vorpipe
