#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/sites/outline_file.h"

namespace vorpipe {
namespace {

/// Adds some polygons of an outline to another.
void addPolygons(const Outline& from, std::uint64_t begin, std::uint64_t end, Outline& to) {
  if (to.empty()) to.ring_offsets = to.polygon_offsets = {0};
  for (auto polygon = begin; polygon < end; ++polygon) {
    for (auto ring = from.polygon_offsets[polygon]; ring < from.polygon_offsets[polygon + 1]; ++ring) {
      const auto first = from.points.begin() + static_cast<std::ptrdiff_t>(from.ring_offsets[ring]);
      const auto last = from.points.begin() + static_cast<std::ptrdiff_t>(from.ring_offsets[ring + 1]);
      to.points.insert(to.points.end(), first, last);
      to.ring_offsets.push_back(to.points.size());
    }
    to.polygon_offsets.push_back(to.ring_offsets.size() - 1);
  }
}

}  // namespace

Result<NamedOutlines> outlinesBy(const OutlineFile& file, const std::string& name) {
  const Attribute* const named = findNamed(file.attributes, name);
  if (named == nullptr) {
    std::vector<std::string> names;
    for (const Attribute& attribute : file.attributes) names.push_back(inQuotes(attribute.name()));
    return inputError(fmt::format("its features have no attribute {}{}{}", inQuotes(name),
                                  names.empty() ? "" : "; they have ", fmt::join(names, ", ")));
  }
  NamedOutlines parts{Attribute(named->name(), named->type()), {}, 0, 0};
  std::map<std::optional<std::string_view>, std::size_t> part_of;
  for (std::size_t f = 0; f < named->size(); ++f) {
    const std::uint64_t begin = file.feature_polygons[f], end = file.feature_polygons[f + 1];
    if (begin == end) {
      ++parts.empty;
      continue;
    }
    const auto value = named->at(f);
    const auto [part, added] = part_of.try_emplace(value, parts.outlines.size());
    if (added) {
      parts.names.add(value);
      parts.outlines.emplace_back();
    } else {
      ++parts.same;
    }
    addPolygons(file.outline, begin, end, parts.outlines[part->second]);
  }
  return parts;
}

}  // namespace vorpipe
