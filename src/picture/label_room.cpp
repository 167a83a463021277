#include "vorpipe/label_room.h"

#include <fmt/core.h>

#include <cstdint>
#include <vector>

namespace vorpipe {

std::string noteOnRoom(const Diagram& cells, const RenderOptions& options, const SiteLabels& labels) {
  if (!hasNames(options)) return {};
  const PicturePlaces places(options);
  std::vector<bool> has_label(cells.size());
  for (const SiteLabel& label : labels.labels) has_label[label.site] = true;
  std::uint64_t count = 0;
  for (const Cell cell : cells) {
    if (has_label[cell.index()] || options.texts[cell.index()].empty() || cell.rings().empty()) continue;
    if (!shownCopies(boxOf(cell.vertices()), options, places).empty()) ++count;
  }
  if (count == 0) return {};
  return fmt::format("labels: {} name{} no room, and {} left out", count, count == 1 ? " has" : "s have",
                     count == 1 ? "is" : "are");
}

}  // namespace vorpipe
