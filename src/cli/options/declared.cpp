#include "cli/options/declared.h"

#include <algorithm>
#include <array>

namespace vorpipe::cli {

std::vector<std::string> inOrder(std::vector<std::string> groups) {
  constexpr std::array<std::string_view, 14> order = {
      "Input",  "Domain",      "Cells",      "Relaxation", "Masses", "Fluid", "Picture",
      "Window", "Measurement", "Comparison", "Output",     "Device", "Run",   help_group};
  // Unknown groups come before the device.
  constexpr std::size_t unknown = 10;
  const auto place = [&](const std::string& group) {
    const auto found = std::ranges::find(order, group);
    return found == order.end() ? unknown : static_cast<std::size_t>(found - order.begin());
  };
  std::ranges::stable_sort(groups, {}, place);
  return groups;
}

}  // namespace vorpipe::cli
