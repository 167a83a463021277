/// Text of unknown encoding.
#pragma once

#include <string>
#include <string_view>

namespace vorpipe {

/// Whether bytes are UTF-8, without surrogates and overlong forms.
bool isUtf8(std::string_view bytes);

/// Text of Windows-1252, which holds Latin-1, as UTF-8.
std::string fromWindows1252(std::string_view bytes);

}  // namespace vorpipe
