/// Names of keys, as Key::name has them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vorpipe::view {

/// The name of one of GLFW's keys by its place on an American keyboard; empty for keys that have none, such
/// as those that are held with others.
std::string_view nameOfKey(int key);

/// The key that gives a character, where it has a name: 'A' is "a", '?' is "question"; else empty. Blanks
/// have none: the key is named when it goes down.
std::string nameOfCharacter(std::uint32_t character);

/// Whether a key gives a character, which says better than its place what its name is.
bool givesCharacter(int key);

}  // namespace vorpipe::view
