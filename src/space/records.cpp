#include "space/records.h"

#include <algorithm>

#include "base/big_vector.h"
#include "base/parallel.h"

namespace vorpipe::space {

Records::Records(const Places& places, double unit, std::span<const std::uint32_t> input,
                 std::span<const Point3> callers_sites, Detail3 detail, int threads, Diagram3& diagram)
    : places_(places),
      unit_(unit),
      input_(input),
      moments_(detail == Detail3::polyhedra),
      out_(diagram),
      wanted_(callers_sites.size()) {
  const std::size_t n = callers_sites.size();
  reserveAll(out_.volume, n, threads);
  reserveAll(out_.surface, n, threads);
  reserveAll(out_.centroid, n, threads);
  out_.volume.assign(n, 0);
  out_.surface.assign(n, 0);
  out_.centroid.assign(callers_sites.begin(), callers_sites.end());
  if (moments_) {
    reserveAll(out_.second_moments, n, threads);
    out_.second_moments.assign(n, {});
  }
}

void Records::layOut(const Rows& rows, int threads) {
  constexpr std::size_t grain = 4096;
  auto& offsets = out_.face_offsets;
  reserveAll(offsets, out_.volume.size() + 1, threads);
  offsets.assign(out_.volume.size() + 1, 0);
  parallelEach(rows.size(), grain, threads, [&](std::size_t i) { offsets[input_[i] + 1] = rows[i].faces; });
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) offsets[i + 1] += offsets[i];
  // With room for some more, which cells in dispute may turn out to have.
  constexpr std::uint64_t one_in = 4096;
  reserveAll(out_.face_areas, offsets.back() + offsets.back() / one_in, threads);
  out_.face_areas.resize(offsets.back());
}

void Records::write(std::size_t site, const CellMeasures& measures, const std::array<double, 6>& moments) {
  const std::uint32_t to = input_[site];
  const double square = unit_ * unit_;
  const Point3 &from = places_.sites[site], &centroid = measures.centroid;
  // Rounding may make less than nothing of a cell without thickness.
  out_.volume[to] = std::max(measures.volume, 0.0) * unit_ * square;
  out_.surface[to] = measures.surface * square;
  out_.centroid[to] = {(from.x + centroid.x) * unit_, (from.y + centroid.y) * unit_,
                       (from.z + centroid.z) * unit_};
  if (!moments_) return;
  for (std::size_t e = 0; e < moments.size(); ++e)
    out_.second_moments[to][e] = moments[e] * unit_ * square * square;
}

}  // namespace vorpipe::space
