#include "core/batch_drawing.h"

#include <fmt/format.h>

#include "core/answers.h"
#include "core/pack.h"
#include "core/stopwatch.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = std::size_t{1} << 14;

}  // namespace

Result<std::vector<CellStatus>> BatchDrawing::draw(const View& view, const Candidates& candidates,
                                                   Effort effort) {
  const auto& info = canvas_.backend.info();
  const auto entries = candidates.site.size();
  std::vector<CellStatus> status(entries, CellStatus::missing);
  for (std::size_t begin = 0, end = 0; begin < entries; begin = end) {
    while (end < entries && end - begin < info.max_entries &&
           candidates.first[end + 1] - candidates.first[begin] <= info.max_lines) {
      ++end;
    }
    if (end == begin) {
      ++end;
      continue;
    }
    packBatch(canvas_.sites, candidates, begin, end, canvas_.threads, batch_);
    const auto count = end - begin;
    if (auto drawn = drawBatch(view, batch_, std::span(candidates.site).subspan(begin, count), effort,
                               std::span(status).subspan(begin, count));
        !drawn) {
      return tl::unexpected(drawn.error());
    }
  }
  return status;
}

Result<void> BatchDrawing::draw(const View& view, const Pieces& pieces) {
  std::vector<CellStatus> status(pieces.site.size(), CellStatus::missing);
  if (auto drawn = drawBatch(view, pieces.batch, pieces.site, Effort::roomy, status); !drawn) return drawn;
  for (std::size_t piece = 0; piece < status.size(); ++piece) {
    if (status[piece] == CellStatus::certified) continue;
    return tl::unexpected(Error{ErrorCode::device, fmt::format("{} could not draw the cell of site {}",
                                                               canvas_.backend.info().device.backend,
                                                               canvas_.sites.id[pieces.site[piece]])});
  }
  return {};
}

Result<void> BatchDrawing::drawBatch(const View& view, const CellBatch<float>& batch,
                                     std::span<const std::uint32_t> site, Effort effort,
                                     std::span<CellStatus> status) {
  const auto& box = view.box;
  const Point center{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const Point scale{2 / (box.xmax - box.xmin), 2 / (box.ymax - box.ymin)};
  marks_.resize(site.size());
  parallelFor(site.size(), grain, canvas_.threads, [&](std::size_t begin, std::size_t end) {
    for (auto e = begin; e < end; ++e) {
      const auto origin = cellOrigin(canvas_.sites, site[e]);
      marks_[e] = {static_cast<float>((origin.x - center.x) * scale.x),
                   static_cast<float>((origin.y - center.y) * scale.y), canvas_.sites.id[site[e]],
                   canvas_.shade[site[e]]};
    }
  });
  const Stopwatch watch;
  if (auto drawn = askToDraw(canvas_.backend, batch, marks_, effort, status); !drawn) return drawn;
  seconds_ += watch.seconds();
  return {};
}

}  // namespace vorpipe
