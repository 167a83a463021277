/// Names of keys, for Key::name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vorpipe::view {

/// Returns the name of a GLFW key by its place on an American keyboard; empty for keys without a name, such
/// as modifiers.
std::string_view nameOfKey(int key);

/// Returns the name of the key for a character: 'A' is "a", '?' is "question"; empty if there is none. Empty
/// for blanks too: their key is named when it goes down.
std::string nameOfCharacter(std::uint32_t character);

/// Whether a key gives a character, which then determines its name better than its place.
bool givesCharacter(int key);

}  // namespace vorpipe::view
