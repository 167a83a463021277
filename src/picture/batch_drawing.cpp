#include "picture/batch_drawing.h"

#include <algorithm>

#include "backend/precision.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/answers.h"
#include "cells/bisectors.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t batch_drawing_grain = std::size_t{1} << 14;

/// Limits the reach of a batch's cells so that float rounding loses no more than is allowed. A cell that is
/// not smaller becomes unsecured.
void boundReach(double allowed, int threads, CellBatch<float>& batch) {
  const auto most = static_cast<float>(2 * allowed / reach_rounding);
  for (auto& entry : batch.entries) entry.reach = std::min(entry.reach, most);
  parallelFor(batch.lines.size(), batch_drawing_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto l = begin; l < end; ++l) batch.lines[l].bound = std::min(batch.lines[l].bound, most);
  });
}

}  // namespace

Result<std::vector<CellStatus>> BatchDrawing::draw(const View& view, const Candidates& candidates,
                                                   Effort effort) {
  const auto& info = canvas_.backend.info();
  const auto entries = candidates.site.size();
  std::vector<CellStatus> status(entries, CellStatus::missing);
  for (std::size_t begin = 0, end = 0; begin < entries; begin = end) {
    while (end < entries && end - begin < info.max_entries &&
           candidates.offsets[end + 1] - candidates.offsets[begin] <= info.max_lines) {
      ++end;
    }
    if (end == begin) {
      ++end;
      continue;
    }
    packBatch(canvas_.sites, candidates, begin, end, canvas_.threads, batch_);
    boundReach(lossAllowed(view, info.subpixel_bits), canvas_.threads, batch_);
    const auto count = end - begin;
    VORPIPE_TRY(drawBatch(view, batch_, std::span(candidates.site).subspan(begin, count), effort,
                          std::span(status).subspan(begin, count)));
  }
  return status;
}

Result<void> BatchDrawing::drawBatch(const View& view, const CellBatch<float>& batch,
                                     std::span<const std::uint32_t> site, Effort effort,
                                     std::span<CellStatus> status) {
  const auto& box = view.box;
  const Point center{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const Point scale{2 / (box.xmax - box.xmin), 2 / (box.ymax - box.ymin)};
  marks_.resize(site.size());
  parallelFor(site.size(), batch_drawing_grain, canvas_.threads, [&](std::size_t begin, std::size_t end) {
    for (auto e = begin; e < end; ++e) {
      const auto origin = cellOrigin(canvas_.sites, site[e]);
      marks_[e] = {static_cast<float>(((origin.x - view.corner.x) - center.x) * scale.x),
                   static_cast<float>(((origin.y - view.corner.y) - center.y) * scale.y),
                   canvas_.sites.id[site[e]], canvas_.palette_index[site[e]]};
    }
  });
  const Stopwatch watch;
  VORPIPE_TRY(askToDraw(canvas_.backend, batch, marks_, effort, status));
  seconds_ += watch.seconds();
  return {};
}

}  // namespace vorpipe::core
