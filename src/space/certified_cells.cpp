#include "space/certified_cells.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "base/parallel.h"
#include "base/try.h"
#include "space/polyhedra.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_in_batch = 512;

/// From records of rows to those of the faces that remain of them.
class RecordEnd {
 public:
  RecordEnd(const ProvedCells& cells, const Contraction& contraction, Records& records, Detail3 detail,
            int threads, Diagram3& diagram)
      : cells_(cells),
        contraction_(contraction),
        records_(records),
        detail_(detail),
        threads_(threads),
        out_(diagram) {}

  void write() {
    out_.status.assign(cells_.status.begin(), cells_.status.end());
    out_.owner.assign(cells_.owner.begin(), cells_.owner.end());
    const auto without_room = measure();
    if (detail_ == Detail3::measures) cells_.rows.forgetRings();
    const auto changed = findChanged();
    const auto before = out_.face_offsets;
    makeRoom(changed, before);
    writeNeighbors([&] { moveAreas(changed, before); });
    writeAreas(without_room);
    clearEmpty();
  }

 private:
  [[nodiscard]] bool remains(std::uint32_t cell, std::size_t face) const {
    return cell == SharedVertices::nowhere || contraction_.remaining(cell, face) != 0;
  }

  /// The areas of a cell's faces, by face.
  struct Areas {
    std::uint32_t site;
    std::vector<double> of_face;
  };

  /// Measures the cells that the check left unmeasured. Returns the areas of faces of those whose row has
  /// another number of faces than when face_offsets were laid out: they do not fit there.
  std::vector<Areas> measure() {
    const auto& which = cells_.unmeasured;
    std::vector<Areas> without_room;
    std::mutex mutex;
    parallelFor(which.size(), cells_in_batch, threads_, [&](std::size_t begin, std::size_t end) {
      CarefulMeasures measures(cells_.places);
      for (const std::uint32_t i : which.subspan(begin, end - begin)) {
        const Row row = cells_.rows[i];
        if (row.faces == 0) continue;
        measures.measure(static_cast<Label>(i), row);
        records_.write(i, measures.measures(), measures.secondMoments());
        records_.writeBalls(i, measures.vertices(), [&](std::size_t v) { return measures.vertex(v); });
        if (!records_.hasRoom(i, row.faces)) {
          const std::scoped_lock lock(mutex);
          without_room.push_back({i, measures.areas()});
          continue;
        }
        for (std::size_t f = 0; f < row.faces; ++f) records_.writeArea(i, f, measures.areas()[f]);
      }
    });
    return without_room;
  }

  /// A cell whose range in face_offsets does not fit: ties removed some of its faces, or its row was replaced
  /// by one with another number of faces.
  struct Changed {
    std::uint32_t input, site;
    std::uint64_t faces;  ///< that remain
  };

  [[nodiscard]] std::vector<Changed> findChanged() const {
    std::vector<std::uint8_t> suspect(cells_.rows.size(), 0);
    for (const Label site : contraction_.cells()) suspect[static_cast<std::size_t>(site)] = 1;
    for (const std::uint32_t site : cells_.unmeasured) suspect[site] = 1;
    std::vector<Changed> changed;
    for (std::uint32_t i = 0; i < suspect.size(); ++i) {
      if (suspect[i] == 0) continue;
      const std::uint32_t cell = contraction_.cellOf(static_cast<Label>(i));
      const std::size_t of_row = cells_.rows[i].faces;
      std::size_t faces = 0;
      for (std::size_t f = 0; f < of_row; ++f) faces += std::size_t{remains(cell, f)};
      if (!records_.hasRoom(i, faces)) changed.push_back({cells_.input[i], i, faces});
    }
    std::ranges::sort(changed, {}, &Changed::input);
    return changed;
  }

  using Offsets = std::vector<std::uint64_t>;

  /// Lays face_offsets out anew, for the faces of each cell that remain. `before` are the old offsets.
  void makeRoom(std::span<const Changed> changed, const Offsets& before) {
    if (changed.empty()) return;
    std::uint64_t end = 0;
    for (auto [i, next] = std::pair(std::size_t{0}, changed.begin()); i < out_.size(); ++i) {
      const bool is_changed = next != changed.end() && next->input == i;
      end += is_changed ? next->faces : before[i + 1] - before[i];
      if (is_changed && next->faces == 0) out_.status[i] = Status::empty;
      next += is_changed ? 1 : 0;
      out_.face_offsets[i + 1] = end;
    }
  }

  /// Moves face_areas from the offsets `before` to the new ones, in place: first ranges that move to higher
  /// indices, from the last to the first; then the others, from the first on. So none is overwritten before
  /// it has moved.
  void moveAreas(std::span<const Changed> changed, const Offsets& before) {
    if (changed.empty()) return;
    const auto& offsets = out_.face_offsets;
    out_.face_areas.resize(std::max(before.back(), offsets.back()));
    const auto goesUp = [&](std::size_t cell) { return offsets[cell] > before[cell]; };
    // The cells between two that changed, and one that changed.
    const auto firstBetween = [&](std::size_t k) {
      return k == 0 ? std::size_t{0} : changed[k - 1].input + std::size_t{1};
    };
    const auto moveBetween = [&](std::size_t k) {
      const std::size_t first = firstBetween(k), last = k == changed.size() ? out_.size() : changed[k].input;
      double* const areas = out_.face_areas.data();
      std::memmove(areas + offsets[first], areas + before[first],
                   (before[last] - before[first]) * sizeof(double));
    };
    std::vector<double> kept;
    const auto moveOf = [&](const Changed& cell) {
      const std::uint64_t from = before[cell.input], room = before[cell.input + std::size_t{1}] - from;
      if (room != cells_.rows[cell.site].faces) return;  // it is measured anew
      const std::uint32_t contracted = contraction_.cellOf(static_cast<Label>(cell.site));
      kept.clear();
      for (std::size_t f = 0; f < room; ++f) {
        if (remains(contracted, f)) kept.push_back(out_.face_areas[from + f]);
      }
      std::ranges::copy(kept, out_.face_areas.data() + offsets[cell.input]);
    };
    for (std::size_t k = changed.size() + 1; k-- > 0;) {
      if (goesUp(firstBetween(k))) moveBetween(k);
      if (k > 0 && goesUp(changed[k - 1].input)) moveOf(changed[k - 1]);
    }
    for (std::size_t k = 0; k <= changed.size(); ++k) {
      if (k > 0 && !goesUp(changed[k - 1].input)) moveOf(changed[k - 1]);
      if (!goesUp(firstBetween(k))) moveBetween(k);
    }
    out_.face_areas.resize(offsets.back());
  }

  void writeAreas(const std::vector<Areas>& of_cells) {
    for (const auto& [i, of_face] : of_cells) {
      const std::uint32_t contracted = contraction_.cellOf(static_cast<Label>(i));
      std::size_t kept = 0;
      for (std::size_t f = 0; f < of_face.size(); ++f) {
        if (remains(contracted, f)) records_.writeArea(i, kept++, of_face[f]);
      }
    }
  }

  /// A cell may have lost its faces, or its row after it was measured.
  void clearEmpty() {
    for (std::size_t i = 0; i < out_.size(); ++i) {
      if (out_.face_offsets[i] != out_.face_offsets[i + 1]) continue;
      out_.volume[i] = out_.surface[i] = 0;
      out_.centroid[i] = cells_.sites[i];
      if (detail_ == Detail3::polyhedra) out_.second_moments[i] = {};
    }
  }

  /// Writes them while one thread does `meanwhile`.
  template <class Meanwhile>
  void writeNeighbors(const Meanwhile& meanwhile) {
    reserveAll(out_.neighbors, out_.face_offsets.back(), threads_);
    out_.neighbors.resize(out_.face_offsets.back());
    parallelFor(cells_.rows.size() + cells_in_batch, cells_in_batch, threads_,
                [&](std::size_t begin, std::size_t end) {
                  if (begin == 0) {
                    meanwhile();
                    return;
                  }
                  for (std::size_t i = begin - cells_in_batch; i < end - cells_in_batch; ++i)
                    writeNeighborsOf(i);
                });
  }

  void writeNeighborsOf(std::size_t i) {
    const Row row = cells_.rows[i];
    const std::uint32_t cell = contraction_.cellOf(static_cast<Label>(i));
    std::uint64_t to = out_.face_offsets[cells_.input[i]];
    for (std::size_t f = 0; f < row.faces; ++f) {
      if (remains(cell, f)) out_.neighbors[to++] = publicNumber(cells_, row.neighbor[f]);
    }
  }

  const ProvedCells& cells_;
  const Contraction& contraction_;
  Records& records_;
  Detail3 detail_;
  int threads_;
  Diagram3& out_;
};

}  // namespace

Result<TieCounts> writeDiagram(const ProvedCells& cells, Records& records, Detail3 detail, int threads,
                               Diagram3& diagram) {
  const bool polyhedra = detail == Detail3::polyhedra;
  auto contraction = Contraction::of(cells.places, cells.rows, cells.tied, threads);
  if (!contraction) return tl::unexpected(std::move(contraction).error());
  if (!polyhedra) contraction->forgetRings();
  RecordEnd(cells, *contraction, records, detail, threads, diagram).write();
  diagram.flat = contraction->counts().flat;
  if (polyhedra) VORPIPE_TRY(Polyhedra(cells, *contraction, threads, diagram).write());
  return contraction->counts();
}

}  // namespace vorpipe::space
