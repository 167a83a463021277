#include <fmt/format.h>

#include <array>
#include <string_view>

#include "view/script.h"
#include "view/words.h"

namespace vorpipe::view {
namespace {

std::string named(const Modifiers& held) {
  std::string names;
  if (held.shift) names += " shift";
  if (held.control) names += " control";
  if (held.alt) names += " alt";
  return names;
}

std::string_view named(Button button) {
  constexpr std::array<std::string_view, 3> names = {"left", "right", "middle"};
  return names.at(static_cast<std::size_t>(button));
}

struct LineOf {
  std::string operator()(const Move& e) const { return fmt::format("move {} {}", e.to.x, e.to.y); }
  std::string operator()(const Press& e) const {
    return fmt::format("press {}{}", named(e.button), named(e.with));
  }
  std::string operator()(const Release& e) const { return fmt::format("release {}", named(e.button)); }
  std::string operator()(const Scroll& e) const { return fmt::format("scroll {}{}", e.by, named(e.with)); }
  std::string operator()(const Key& e) const { return fmt::format("key {}{}", e.name, named(e.with)); }
  std::string operator()(const Text& e) const { return "text " + e.utf8; }
  std::string operator()(const Resize& e) const { return fmt::format("resize {} {}", e.width, e.height); }
  std::string operator()(const Minimize& /*e*/) const { return "minimize"; }
  std::string operator()(const Restore& /*e*/) const { return "restore"; }
  std::string operator()(const Drop& e) const {
    std::string line = "drop";
    for (const std::string& path : e.paths) line += ' ' + wordFor(path);
    return line;
  }
  std::string operator()(const Close& /*e*/) const { return "close"; }
  std::string operator()(const Wait& e) const {
    return e.seconds > 0 ? fmt::format("wait {}", e.seconds) : "wait";
  }
  std::string operator()(const Screenshot& e) const {
    return fmt::format("screenshot {}{}", wordFor(e.path), e.panel ? " panel" : "");
  }
};

}  // namespace

std::string scriptLine(const Event& event) { return std::visit(LineOf{}, event); }

}  // namespace vorpipe::view
