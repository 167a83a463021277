/// JSON as text, for those who make it: the library's own writer takes long to compile.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace vorpipe {

/// With a line's end. What is no UTF-8 is replaced: a driver's name may hold any bytes.
std::string jsonText(const nlohmann::ordered_json& json, int indent);

/// UTF-8 text as a string of JSON, in double quotes.
std::string jsonString(std::string_view text);

}  // namespace vorpipe
