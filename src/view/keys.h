/// The table of key bindings, for the window, its help and the documents.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "view/action.h"
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

/// Returns the label in the help, e.g. "Ctrl+Shift+Z".
std::string labelOf(const KeyBinding& binding);

struct HelpLine {
  std::string keys, what;
};

/// Returns a line for each action of pointer and keys; keys with the same action share a line.
std::vector<HelpLine> helpLines();

}  // namespace vorpipe::view
