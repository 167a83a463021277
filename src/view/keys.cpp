#include "view/keys.h"

#include <algorithm>
#include <cctype>

namespace vorpipe::view {
namespace {

constexpr Modifiers plain{}, control{.control = true}, control_shift{.shift = true, .control = true};

void nextColormap(Settings& settings) {
  const std::vector<std::string> names = colormaps();
  const auto now = std::ranges::find(names, colormapOf(settings.picture));
  settings.picture.colormap = now == names.end() || now + 1 == names.end() ? names.front() : *(now + 1);
}

std::vector<KeyBinding> table() {
  return {
      {"question", plain, "lists what keys and the pointer do", [](Settings& s) { s.help = !s.help; }},
      {"f1", plain, "lists what keys and the pointer do", [](Settings& s) { s.help = !s.help; }},
      {"tab", plain, "hides the panel, or shows it", [](Settings& s) { s.panel = !s.panel; }},
      {"home", plain, "shows all of the domain", Action::fit},
      {"f", plain, "shows all of the domain", Action::fit},
      {"c", plain, "fills cells with colors, or not", [](Settings& s) { s.cells = !s.cells; }},
      {"e", plain, "draws edges", [](Settings& s) { s.picture.edges = !s.picture.edges; }},
      {"s", plain, "draws sites", [](Settings& s) { s.picture.show_sites = !s.picture.show_sites; }},
      {"d", plain, "draws the dual: lines between sites whose cells meet",
       [](Settings& s) { s.picture.dual = !s.picture.dual; }},
      {"l", plain, "writes the index of each site",
       [](Settings& s) { s.picture.labels = !s.picture.labels; }},
      {"1", plain, "colors by site", [](Settings& s) { colorBy(ColorBy::site, s); }},
      {"2", plain, "colors by area", [](Settings& s) { colorBy(ColorBy::area, s); }},
      {"3", plain, "colors by the number of neighbors", [](Settings& s) { colorBy(ColorBy::neighbors, s); }},
      {"4", plain, "colors by weight", [](Settings& s) { colorBy(ColorBy::weight, s); }},
      {"5", plain, "colors a fluid by density", [](Settings& s) { s.flow_color = FlowColor::density; }},
      {"6", plain, "colors a fluid by speed", [](Settings& s) { s.flow_color = FlowColor::speed; }},
      {"m", plain, "takes the next colors", nextColormap},
      {"b", plain, "takes the next backend that works here", Action::next_backend},
      {"w", plain, "compares with the next backend, side by side; again, it does not", Action::compare},
      {"space", plain, "relaxes sites to the centers of their cells, or has a fluid flow; again, it pauses",
       [](Settings& s) { s.motion = s.motion == Motion::runs ? Motion::rests : Motion::runs; }},
      {"n", plain, "relaxes or flows by one step", Action::step},
      {"r", plain, "begins the fluid again", Action::begin_again},
      {"z", control, "undoes", Action::undo},
      {"y", control, "does again what was undone", Action::redo},
      {"z", control_shift, "does again what was undone", Action::redo},
      {"s", control, "saves the picture as PNG", Action::save_png},
      {"s", control_shift, "saves the picture as SVG", Action::save_svg},
      {"e", control, "saves the sites as CSV", Action::save_sites},
      {"e", control_shift, "saves the fluid, for vorpipe fluid --resume", Action::save_fluid},
      {"c", control, "copies the command line that makes this picture, or goes on with the fluid",
       Action::copy_command},
      {"q", control, "closes the window", Action::close},
      {"escape", plain, "closes the window", Action::close},
  };
}

}  // namespace

const std::vector<KeyBinding>& keyBindings() {
  static const std::vector<KeyBinding> bindings = table();
  return bindings;
}

const KeyBinding* bindingOf(const Key& key) {
  const auto find = [&](Modifiers with) -> const KeyBinding* {
    const auto found = std::ranges::find_if(keyBindings(), [&](const KeyBinding& binding) {
      return binding.key == key.name && binding.with == with;
    });
    return found == keyBindings().end() ? nullptr : &*found;
  };
  if (const KeyBinding* const exact = find(key.with)) return exact;
  // A question mark needs Shift on many keyboards.
  Modifiers without = key.with;
  without.shift = false;
  return key.with.shift && !key.with.control ? find(without) : nullptr;
}

std::string labelOf(const KeyBinding& binding) {
  std::string label;
  if (binding.with.control) label += "Ctrl+";
  if (binding.with.shift) label += "Shift+";
  if (binding.with.alt) label += "Alt+";
  if (binding.key == "question") return label + "?";
  std::string name = binding.key;
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return label + name;
}

std::vector<std::pair<std::string, std::string>> helpLines() {
  std::vector<std::pair<std::string, std::string>> lines = {
      {"Left click", "adds a site, where there is none"},
      {"Left drag", "stirs a fluid; else moves the site under the pointer, or what is shown"},
      {"Middle drag", "moves what is shown"},
      {"Right click", "removes the site under the pointer, or that of the cell"},
      {"Wheel", "zooms to the pointer"},
      {"Ctrl+Wheel", "changes the weight of the cell under the pointer"},
      {"Drop a file", "opens its sites"}};
  for (const KeyBinding& binding : keyBindings()) {
    if (lines.back().second == binding.what) {
      lines.back().first += " or " + labelOf(binding);
    } else {
      lines.emplace_back(labelOf(binding), binding.what);
    }
  }
  return lines;
}

}  // namespace vorpipe::view
