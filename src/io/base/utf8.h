/// Text of unknown encoding.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vorpipe {

/// Returns the length of the UTF-8 character at the start of `bytes`; 0 if there is none. Surrogates and
/// overlong forms are no characters.
std::size_t characterLength(std::string_view bytes);

/// Whether all bytes form such characters.
bool isUtf8(std::string_view bytes);

/// Converts text in Windows-1252, which includes Latin-1, to UTF-8.
std::string fromWindows1252(std::string_view bytes);

}  // namespace vorpipe
