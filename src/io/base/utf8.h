/// Text of unknown encoding.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vorpipe {

/// How many of the bytes are the UTF-8 character that they begin with; 0 if they begin with none. There are
/// no surrogates, and no overlong forms.
std::size_t characterLength(std::string_view bytes);

/// Whether bytes are such characters alone.
bool isUtf8(std::string_view bytes);

/// Text of Windows-1252, which holds Latin-1, as UTF-8.
std::string fromWindows1252(std::string_view bytes);

}  // namespace vorpipe
