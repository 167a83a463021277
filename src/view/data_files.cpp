#include <fmt/format.h>

#include <iterator>

#include "base/try.h"
#include "io/base/output_file.h"
#include "view/command.h"

namespace vorpipe::view {
namespace {

Result<void> writeText(const std::string& path, std::string_view text) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  VORPIPE_TRY(file->write(text));
  return file->commit();
}

}  // namespace

Result<void> writeSites(const std::string& path, const Sites& sites) {
  const bool weighted = !sites.weight.empty();
  std::string text = weighted ? "x,y,weight\n" : "x,y\n";
  for (std::size_t i = 0; i < sites.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{}", sites.x[i], sites.y[i]);
    if (weighted) fmt::format_to(std::back_inserter(text), ",{}", sites.weight[i]);
    text += '\n';
  }
  return writeText(path, text);
}

Result<void> writeOutline(const std::string& path, const Outline& outline) {
  std::string text = "MULTIPOLYGON (";
  for (std::size_t polygon = 0; polygon + 1 < outline.polygon_offsets.size(); ++polygon) {
    text += polygon > 0 ? ", (" : "(";
    const auto first_ring = outline.polygon_offsets[polygon];
    for (auto ring = first_ring; ring < outline.polygon_offsets[polygon + 1]; ++ring) {
      text += ring > first_ring ? ", (" : "(";
      const auto first = outline.ring_offsets[ring], end = outline.ring_offsets[ring + 1];
      for (auto i = first; i < end; ++i) {
        fmt::format_to(std::back_inserter(text), "{} {}, ", outline.points[i].x, outline.points[i].y);
      }
      fmt::format_to(std::back_inserter(text), "{} {})", outline.points[first].x, outline.points[first].y);
    }
    text += ')';
  }
  return writeText(path, text + ")\n");
}

}  // namespace vorpipe::view
