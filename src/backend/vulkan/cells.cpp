// The part of the backend "vulkan-geometry" that hands cells back as data.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <new>
#include <utility>

#include "backend/vulkan/error.h"
#include "backend/vulkan/geometry.h"
#include "backend/vulkan/structure.h"

namespace vorpipe::vulkan {
namespace {

// One edge as edges.geom writes it.
struct EdgeRecord {
  float x, y;
  std::int32_t line;
  std::uint32_t count;  ///< edges of the entry
};
constexpr std::size_t entry_bytes = EDGES_MOST * sizeof(EdgeRecord);

// Entries whose edges are on the device at one time: some 10 MiB of them.
constexpr std::size_t slice_entries = 65536;

CellBatch<float>::Entry toFloat(const CellBatch<double>::Entry& entry) {
  const auto f = [](double value) { return static_cast<float>(value); };
  return {entry.first,   entry.count,    f(entry.west),  f(entry.south),
          f(entry.east), f(entry.north), f(entry.reach), f(entry.shift)};
}

Line<float> toFloat(const Line<double>& line) {
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(line.nx), f(line.ny), f(line.h), f(line.bound)};
}

// Converts into mapped memory, which holds no objects yet.
template <class To, class From>
void convert(const std::vector<From>& from, std::byte* to) {
  for (std::size_t k = 0; k < from.size(); k++) {
    const To converted = toFloat(from[k]);
    std::memcpy(to + k * sizeof(To), &converted, sizeof(To));
  }
}

}  // namespace

Result<void> GeometryBackend::cells(const CellBatch<double>& batch, CellPolygons& out) {
  try {
    out = {};
    out.first.push_back(0);
    return runCells(batch, out);
  } catch (const std::bad_alloc&) {
    return deviceError("not enough memory for " + std::to_string(batch.entries.size()) +
                       " cells: free some, or ask for fewer cells at a time");
  }
}

Result<void> GeometryBackend::runCells(const CellBatch<double>& batch, CellPolygons& out) {
  const std::size_t count = batch.entries.size();
  if (count == 0) return {};
  VORPIPE_TRY(createEmptyFramebuffer());
  VORPIPE_TRY(reserveBatch(count, 1, batch.lines.size()));
  convert<CellBatch<float>::Entry>(batch.entries, entries_.data());
  convert<Line<float>>(batch.lines, lines_.data());
  const std::size_t range = info_.max_entries * sizeof(std::uint32_t);
  const std::size_t slice = std::min({count, slice_entries, range / entry_bytes});
  VORPIPE_TRY(edges_.reserve(device_, slice * entry_bytes, slice_entries * entry_bytes));
  bindings_.setStorage(device_, binding_edges, edges_.get(), slice * entry_bytes);
  const Result<VkPipeline> pipeline = pipelines_.edges(device_, bindings_.layout());
  if (!pipeline) return tl::unexpected(pipeline.error());
  for (std::size_t first = 0; first < count; first += slice) {
    const std::size_t here = std::min(slice, count - first);
    VORPIPE_TRY(run({*pipeline, pipelines_.emptyPass(), empty_framebuffer_.get(), {1, 1}}, first, here));
    appendCells(here, out);
  }
  return {};
}

Result<void> GeometryBackend::createEmptyFramebuffer() {
  if (empty_framebuffer_) return {};
  auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  info.renderPass = pipelines_.emptyPass();
  info.width = 1;
  info.height = 1;
  info.layers = 1;
  Result<Handle<VkFramebuffer>> framebuffer =
      create(device_.handle(), device_.api().vkCreateFramebuffer, device_.api().vkDestroyFramebuffer, info,
             "vkCreateFramebuffer");
  if (!framebuffer) return tl::unexpected(std::move(framebuffer).error());
  empty_framebuffer_ = std::move(*framebuffer);
  return {};
}

// Takes over the cells that run() has left in host_status_ and edges_.
void GeometryBackend::appendCells(std::size_t count, CellPolygons& out) const {
  std::array<EdgeRecord, EDGES_MOST> records{};
  for (std::size_t entry = 0; entry < count; entry++) {
    const CellStatus status = statusAt(entry);
    const bool has_edges =
        status == CellStatus::certified || status == CellStatus::unsecured || status == CellStatus::open;
    std::size_t edge_count = 0;
    if (has_edges) {
      std::memcpy(records.data(), edges_.data() + entry * entry_bytes, entry_bytes);
      edge_count = std::min<std::size_t>(records[0].count, EDGES_MOST);
    }
    for (std::size_t edge = 0; edge < edge_count; edge++) {
      out.x.push_back(static_cast<double>(records[edge].x));
      out.y.push_back(static_cast<double>(records[edge].y));
      out.line.push_back(records[edge].line);
    }
    out.status.push_back(status);
    out.first.push_back(static_cast<std::uint32_t>(out.x.size()));
  }
}

}  // namespace vorpipe::vulkan
