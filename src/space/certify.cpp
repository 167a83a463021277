#include "space/certify.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "space/cell_check.h"
#include "space/exact_search.h"
#include "space/hidden.h"

namespace vorpipe::space {
namespace {

using SiteList = std::vector<std::uint32_t>;

/// Of the box's longest side, which is from 1 to 2 in a run.
constexpr double least_distance = 0x1p-80;

constexpr std::size_t rows_in_part = std::size_t{1} << 14;

void sortUnique(SiteList& sites) {
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
}

bool isOutside(const Places& places, std::size_t site) {
  const Point3& p = places.sites[site];
  const Box3& box = places.box;
  return p.x < box.xmin || p.x > box.xmax || p.y < box.ymin || p.y > box.ymax || p.z < box.zmin ||
         p.z > box.zmax;
}

class Certifier {
 public:
  Certifier(const SiteBins& bins, Records& records, const Progress& progress, int threads)
      : bins_(bins),
        records_(records),
        places_(bins.places()),
        lanes_(bins.lanes()),
        lines_(bins.linesOfCubes()),
        progress_(progress),
        threads_(threads),
        found_(bins),
        tied_(bins.sites.size(), 0),
        unmeasured_(bins.sites.size(), 0),
        in_double_(bins.sites.size(), 0),
        exact_(bins.sites.size(), 0),
        hidden_(bins.sites.size(), 0) {}

  Result<CertifiedRows> run() {
    VORPIPE_TRY(begin());
    VORPIPE_TRY(recompute(0.4, 0.5));
    records_.layOut(found_.rows, threads_);
    SiteList which = allSites();
    bool all = false;
    for (;;) {
      VORPIPE_TRY(check(which));
      if (disputed_.empty()) {
        if (cellsOfCorner(found_.rows, threads_) == 1 && !forgetsSite(found_.rows, hidden_, threads_)) break;
        if (all) return tl::unexpected(remains("the cells do not cover the box once"));
        all = true;
        disputed_ = allSites();
      }
      const std::uint32_t first = disputed_.front();
      std::erase_if(disputed_, [this](std::uint32_t i) { return exact_[i] != 0; });
      if (disputed_.empty()) {
        return tl::unexpected(
            remains("the cell of site " + std::to_string(bins_.input[first]) + " remains in dispute"));
      }
      which = around(disputed_);
      VORPIPE_TRY(recompute(0.8, 0.9));
      const SiteList after = around(which);
      which.insert(which.end(), after.begin(), after.end());
      sortUnique(which);
    }
    if (near_) return tl::unexpected(refuseNear(near_->first, near_->second));
    for (std::uint32_t i = 0; i < tied_.size(); ++i) {
      if (tied_[i] != 0) found_.tied.push_back(i);
      if (unmeasured_[i] != 0) found_.unmeasured.push_back(i);
    }
    return std::move(found_);
  }

 private:
  static Error remains(const std::string& what) {
    return {ErrorCode::device, what + " after exact arithmetic: a fault of vorpipe"};
  }

  [[nodiscard]] Error refuseNear(std::uint32_t a, std::uint32_t b) const {
    const auto at = [this](std::uint32_t site) {
      const Point3& p = bins_.sites[site];
      return Point3{p.x / bins_.scale, p.y / bins_.scale, p.z / bins_.scale};
    };
    if (bins_.input[a] > bins_.input[b]) std::swap(a, b);
    return nearSites(bins_.input[a], at(a), bins_.input[b], at(b));
  }

  /// Runs body(begin, end) for ranges of [0, count) on all threads, and tells progress in between, which goes
  /// from one part of the whole to another.
  template <class Body>
  Result<void> inSteps(std::size_t count, std::size_t grain, double from, double to, const Body& body) {
    // As long as a few tenths of a second at most, so that who wants to stop need not wait.
    const std::size_t step = 64 * grain;
    for (std::size_t begin = 0; begin < count; begin += step) {
      const std::size_t size = std::min(step, count - begin);
      parallelFor(size, std::min(grain, size), threads_,
                  [&](std::size_t first, std::size_t last) { body(begin + first, begin + last); });
      const double done = static_cast<double>(begin + size) / static_cast<double>(count);
      if (progress_ && !progress_("cells", from + (to - from) * done)) {
        return tl::unexpected(Error{ErrorCode::cancelled, "stopped"});
      }
    }
    return {};
  }

  RowArena takeArena() {
    const std::scoped_lock lock(mutex_);
    if (arenas_.empty()) return {};
    const RowArena arena = arenas_.back();
    arenas_.pop_back();
    return arena;
  }

  /// The same with body(begin, end, arena), each with an arena that no other thread uses.
  template <class Body>
  Result<void> inArenas(std::size_t count, std::size_t grain, double from, double to, const Body& body) {
    return inSteps(count, grain, from, to, [&](std::size_t begin, std::size_t end) {
      RowArena arena = takeArena();
      body(begin, end, arena);
      const std::scoped_lock lock(mutex_);
      arenas_.push_back(arena);
    });
  }
  void dispute(const SiteList& sites) {
    if (sites.empty()) return;
    const std::scoped_lock lock(mutex_);
    disputed_.insert(disputed_.end(), sites.begin(), sites.end());
  }

  [[nodiscard]] SiteList allSites() const {
    SiteList all(bins_.sites.size());
    auto to = all.begin();
    for (const auto [first, last] : lines_) {
      const auto end = to + (bins_.begin[last] - bins_.begin[first]);
      std::iota(to, end, bins_.begin[first]);
      to = end;
    }
    return all;
  }
  /// Proposes the cells of all sites, as quickly as is worth it, or disputes them all. In lattices float and
  /// double break ties otherwise than exact signs do.
  Result<void> begin() {
    auto precision = Precision::in_float;
    if (partInDispute(precision) > 0.3) {
      precision = Precision::in_double;
      std::ranges::fill(in_double_, 1);
      if (partInDispute(precision) > 0.5) {
        disputed_ = allSites();
        return {};
      }
    }
    const std::size_t grain = std::clamp<std::size_t>(lines_.size() / 16, 1, 256);
    return inArenas(lines_.size(), grain, 0, 0.4, [&](std::size_t begin, std::size_t end, RowArena& arena) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto [first, last] = lines_[k];
        dispute(propose(precision, first, bins_.begin[first], bins_.begin[last], arena));
      }
    });
  }

  /// Sets the rows that are proposed for some sites, the first of which is in a bin, and returns those
  /// without.
  SiteList propose(Precision precision, std::uint32_t bin, std::uint32_t first, std::uint32_t last,
                   RowArena& arena) {
    struct Taken {
      Certifier& certifier;
      RowArena& arena;
      SiteList left;
    } taken{*this, arena, {}};
    proposeCells(precision)(
        lanes_, bin, first, last,
        [](void* context, std::uint32_t site, const ProposedCell& cell) {
          auto& [certifier, into, left] = *static_cast<Taken*>(context);
          Rows& rows = certifier.found_.rows;
          if (cell.state == Proposed::whole &&
              rows.set(site, {cell.neighbor, static_cast<std::size_t>(cell.faces)}, cell.corner,
                       static_cast<std::size_t>(cell.vertices), into)) {
            return;
          }
          rows.clear(site);
          if (cell.state != Proposed::empty || !certifier.hides(site, std::to_array(cell.emptied_by)))
            left.push_back(site);
        },
        &taken);
    return std::move(taken.left);
  }

  /// Whether a site has no cell, for a reason that is to be proved. What is proved once remains so.
  bool hides(std::uint32_t site, const NoCell& reason) {
    if (hidden_[site] == 0 && leaveNothing(places_, static_cast<Label>(site), reason)) hidden_[site] = 1;
    return hidden_[site] != 0;
  }

  /// The part of a sample of cells that are not right if they are proposed so; 0 of few sites.
  double partInDispute(Precision precision) {
    constexpr std::uint32_t ranges = 32, bins_of_range = 4, least_bins = 2048;
    if (bins_.bins() < least_bins) return 0;
    RowArena arena;
    CellCheck cell_check(places_, found_.rows);
    std::size_t sites = 0, wrong = 0;
    for (std::uint32_t k = 0; k < ranges; ++k) {
      const std::uint32_t bin = bins_.bins() / ranges * k, first = bins_.begin[bin],
                          last = bins_.begin[bin + bins_of_range];
      propose(precision, bin, first, last, arena);
      for (std::uint32_t site = first; site < last; ++site) {
        ++sites;
        const bool right =
            found_.rows[site].faces == 0
                ? hidden_[site] != 0
                : cell_check.check(static_cast<Label>(site), Signs::all).broken == Broken::nothing;
        wrong += right ? 0 : 1;
        found_.rows.clear(site);
      }
    }
    return sites > ranges ? static_cast<double>(wrong) / static_cast<double>(sites) : 0;
  }

  /// One that no other thread uses: they keep what they know from one range of sites to the next.
  std::unique_ptr<ExactSearch> takeSearch() {
    const std::scoped_lock lock(mutex_);
    if (searches_.empty()) return std::make_unique<ExactSearch>(bins_);
    auto search = std::move(searches_.back());
    searches_.pop_back();
    return search;
  }

  /// Recomputes the cells in dispute: those by float in double, the others exactly.
  Result<void> recompute(double from, double to) {
    sortUnique(disputed_);
    std::atomic<std::uint64_t> made = 0;
    const std::size_t grain = std::clamp<std::size_t>(disputed_.size() / 256, 16, 512);
    const auto done =
        inArenas(disputed_.size(), grain, from, to, [&](std::size_t begin, std::size_t end, RowArena& arena) {
          std::unique_ptr<ExactSearch> search = takeSearch();
          for (std::size_t k = begin; k < end; ++k) {
            const std::uint32_t site = disputed_[k];
            if (in_double_[site] == 0) {
              in_double_[site] = 1;
              const std::uint32_t bin = bins_.indexOfBin(bins_.sites[site]);
              if (propose(Precision::in_double, bin, site, site + 1, arena).empty()) continue;
            }
            const ExactRow& row = search->rowOf(static_cast<Label>(site));
            exact_[site] = 1;
            ++made;
            found_.rows.clear(site);
            if (row.neighbors.empty()) {
              hides(site, search->emptiedBy());
            } else {
              found_.rows.set(site, row.neighbors, row.vertices, arena);
            }
          }
          const std::scoped_lock lock(mutex_);
          searches_.push_back(std::move(search));
        });
    VORPIPE_TRY(done);
    found_.exact += made;
    disputed_.clear();
    return {};
  }

  /// Checks cells, writes their records, and disputes those that are not proved.
  Result<void> check(const SiteList& which) {
    const std::size_t grain = std::clamp<std::size_t>(which.size() / 64, 1, 1024);
    VORPIPE_TRY(inSteps(which.size(), grain, 0.5, 0.8, [&](std::size_t begin, std::size_t end) {
      CellCheck cell_check(places_, found_.rows, records_.wantMoments());
      SiteList disputed;
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t site = which[k];
        if (k + 8 < end) records_.prefetchOffsets(which[k + 8]);
        if (k + 4 < end) {
          records_.prefetch(which[k + 4]);
          found_.rows.prefetch(which[k + 4]);
        }
        if (found_.rows[site].faces == 0) {
          if (hidden_[site] == 0) disputed.push_back(site);
          unmeasured_[site] = records_.hasRoom(site, 0) ? 0 : 1;
          continue;
        }
        const bool wanted = records_.wants(site);
        const Verdict verdict = cell_check.check(static_cast<Label>(site),
                                                 exact_[site] != 0 ? Signs::none : Signs::of_least, wanted);
        if (verdict.broken != Broken::nothing) {
          disputed.push_back(site);
          for (const Label with : verdict.with) {
            if (!isWallLabel(with)) disputed.push_back(static_cast<std::uint32_t>(with));
          }
          continue;
        }
        if (verdict.distance < least_distance) {
          const std::scoped_lock lock(mutex_);
          near_ =
              std::min(near_.value_or(std::pair(site, verdict.nearest)), std::pair(site, verdict.nearest));
        }
        tied_[site] = verdict.tied ? 1 : 0;
        const std::size_t faces = found_.rows[site].faces;
        const bool measured = !verdict.unsure && !isOutside(places_, site) && records_.hasRoom(site, faces);
        unmeasured_[site] = measured ? 0 : 1;
        if (!measured || !wanted) continue;
        records_.write(site, cell_check.measures(), cell_check.secondMoments());
        records_.writeBalls(site, cell_check.vertices(), [&](std::size_t v) { return cell_check.vertex(v); });
        for (std::size_t f = 0; f < faces; ++f) records_.writeArea(site, f, cell_check.faceArea(f));
      }
      dispute(disputed);
    }));
    sortUnique(disputed_);
    return {};
  }

  /// The sites, and the neighbors of their cells.
  [[nodiscard]] SiteList around(const SiteList& sites) const {
    SiteList all = sites;
    for (const std::uint32_t site : sites) {
      for (const Label label : found_.rows[site].neighbors()) {
        if (!isWallLabel(label)) all.push_back(static_cast<std::uint32_t>(label));
      }
    }
    sortUnique(all);
    return all;
  }

  const SiteBins& bins_;
  Records& records_;
  Places places_;
  LaneBins lanes_;
  std::vector<BinLine> lines_;
  const Progress& progress_;
  int threads_;
  CertifiedRows found_;
  std::vector<std::uint8_t> tied_, unmeasured_;  ///< by site
  std::vector<std::uint8_t> in_double_, exact_;  ///< by site: whether its cell was proposed or made so
  std::vector<std::uint8_t> hidden_;             ///< by site: whether it is proved to have no cell
  SiteList disputed_;
  std::vector<std::unique_ptr<ExactSearch>> searches_;  ///< that are idle
  std::vector<RowArena> arenas_;                        ///< with room left, that are idle
  std::optional<std::pair<std::uint32_t, std::uint32_t>>
      near_;  ///< two sites that are too near to each other
  std::mutex mutex_;
};

}  // namespace

std::size_t cellsOfCorner(const Rows& rows, int threads) {
  std::atomic<std::size_t> cells = 0;
  parallelEach(rows.size(), rows_in_part, threads, [&](std::size_t site) {
    const Row row = rows[site];
    if (row.faces == 0 || !isWallLabel(row.neighbor[0])) return;  // walls come first
    const std::size_t x = row.faceOf(labelOfWall(0)), y = row.faceOf(labelOfWall(2)),
                      z = row.faceOf(labelOfWall(4));
    if (x == row.faces || y == row.faces || z == row.faces) return;
    const Ring ring = row.ring(x);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t b = ring[k], c = ring[k + 1 == ring.size() ? 0 : k + 1];
      if ((b == y && c == z) || (b == z && c == y)) ++cells;
    }
  });
  return cells;
}

bool forgetsSite(const Rows& rows, std::span<const std::uint8_t> hidden, int threads) {
  std::atomic<bool> forgets = false;
  parallelEach(rows.size(), rows_in_part, threads, [&](std::size_t site) {
    if (rows[site].faces == 0 && hidden[site] == 0) forgets = true;
  });
  return forgets;
}

Error nearSites(std::uint32_t a, const Point3& at_a, std::uint32_t b, const Point3& at_b) {
  const auto text = [](const Point3& p) { return fmt::format("{}, {}, {}", p.x, p.y, p.z); };
  return refusal(Subject::sites,
                 fmt::format("sites {} and {}: {} and {} are not equal, but nearer to each other than {:.0e} "
                             "of the domain's longest side: make them equal, or move one",
                             a, b, text(at_a), text(at_b), least_distance));
}

Result<CertifiedRows> certify(const SiteBins& bins, Records& records, const Progress& progress, int threads) {
  return Certifier(bins, records, progress, threads).run();
}

}  // namespace vorpipe::space
