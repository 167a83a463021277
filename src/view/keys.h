/// What keys do, in one table: what the window looks up, its help shows, and the documents list.
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
  std::string what;  ///< what it does, as "shows all of the domain"
  std::variant<Action, void (*)(Settings&)> does;
};

const std::vector<KeyBinding>& keyBindings();

/// What a key does; nullptr: nothing. Shift is not looked at where the table has no key with it.
const KeyBinding* bindingOf(const Key& key);

/// "Ctrl+Shift+Z", as help names it.
std::string labelOf(const KeyBinding& binding);

struct HelpLine {
  std::string keys, what;
};

/// What the pointer and keys do, a line each; keys that do one and the same share theirs.
std::vector<HelpLine> helpLines();

}  // namespace vorpipe::view
