/// The table of key bindings, for the window, its help and the documents.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "view/settings.h"
#include "view/window/event.h"

namespace vorpipe::view {

struct KeyBinding {
  std::string key;  ///< as Key::name
  Modifiers with{};
  std::string what;  ///< what it does, e.g. "shows all of the domain"
  std::variant<Action, void (*)(Settings&)> does;
};

const std::vector<KeyBinding>& keyBindings();

/// Returns the binding of a key; nullptr: none. Ignores Shift if the table has no such key with Shift.
const KeyBinding* bindingOf(const Key& key);

std::string labelOf(const KeyBinding& binding);  ///< in the help, e.g. "Ctrl+Shift+Z"

/// Returns keys and what they do, for each action of pointer and keys; keys with the same action share a
/// line.
std::vector<std::pair<std::string, std::string>> helpLines();

}  // namespace vorpipe::view
