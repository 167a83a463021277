#include "space/certify.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "space/exact_search.h"

namespace vorpipe::space {
namespace {

using SiteList = std::vector<std::uint32_t>;

/// Of the box's longest side, which is from 1 to 2 in a run.
constexpr double least_distance = 0x1p-80;

void sortUnique(SiteList& sites) {
  std::ranges::sort(sites);
  sites.erase(std::ranges::unique(sites).begin(), sites.end());
}

bool isOutside(const Places& places, std::size_t site) {
  const Point3& p = places.sites[site];
  const Box3& box = places.box;
  return p.x < box.xmin || p.x > box.xmax || p.y < box.ymin || p.y > box.ymax || p.z < box.zmin ||
         p.z > box.zmax;
}

class Certifier {
 public:
  Certifier(const SiteBins& bins, bool moments, const Progress& progress, int threads)
      : bins_(bins),
        places_(bins.places()),
        lanes_(bins.lanes()),
        propose_cells_(proposeCells()),
        progress_(progress),
        threads_(threads),
        found_(bins.sites.size()),
        tied_(bins.sites.size(), 0),
        careful_(bins.sites.size(), 0),
        exact_(bins.sites.size(), 0) {
    found_.face_areas.resize(bins.sites.size());
    if (moments) found_.moments.resize(bins.sites.size());
  }

  Result<CertifiedRows> run() {
    VORPIPE_TRY(tiesAreEverywhere() ? disputeAll() : propose());
    VORPIPE_TRY(recompute(0.4, 0.5));
    SiteList which = allSites();
    bool all = false;
    for (;;) {
      VORPIPE_TRY(check(which));
      if (disputed_.empty()) {
        if (cellsOfCorner(found_.rows) == 1 && !forgetsSite(places_, found_.rows, exact_)) break;
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
    if (near_) return tl::unexpected(nearSites(near_->first, near_->second));
    for (std::uint32_t i = 0; i < careful_.size(); ++i) {
      if (tied_[i] != 0) found_.tied.push_back(i);
      if (careful_[i] != 0) found_.careful.push_back(i);
    }
    return std::move(found_);
  }

 private:
  static Error remains(const std::string& what) {
    return {ErrorCode::device, what + " after exact arithmetic: a fault of vorpipe"};
  }

  [[nodiscard]] Error nearSites(std::uint32_t a, std::uint32_t b) const {
    const auto text = [this](std::uint32_t site) {
      const Point3& p = bins_.sites[site];
      return fmt::format("{}, {}, {}", p.x / bins_.scale, p.y / bins_.scale, p.z / bins_.scale);
    };
    if (bins_.input[a] > bins_.input[b]) std::swap(a, b);
    return refusal(
        Subject::sites,
        fmt::format("sites {} and {}: {} and {} are not equal, but nearer to each other than {:.0e} "
                    "of the domain's longest side: make them equal, or move one",
                    bins_.input[a], bins_.input[b], text(a), text(b), least_distance));
  }

  /// Runs body(begin, end) for ranges of [0, count) on all threads, and tells progress in between, which goes
  /// from one part of the whole to another.
  template <class Body>
  Result<void> inSteps(std::size_t count, std::size_t grain, double from, double to, const Body& body) {
    // As long as a few hundredths of a second, so that who wants to stop need not wait.
    const std::size_t step = std::max<std::size_t>(std::size_t{1} << 14, grain);
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

  /// The same with body(begin, end, arena), each with an arena of its own.
  template <class Body>
  Result<void> inArenas(std::size_t count, std::size_t grain, double from, double to, const Body& body) {
    return inSteps(count, grain, from, to, [&](std::size_t begin, std::size_t end) {
      RowArena arena;
      body(begin, end, arena);
      const std::scoped_lock lock(mutex_);
      found_.arenas.push_back(std::move(arena));
    });
  }
  void dispute(SiteList sites) {
    const std::scoped_lock lock(mutex_);
    disputed_.insert(disputed_.end(), sites.begin(), sites.end());
  }

  [[nodiscard]] SiteList allSites() const {
    SiteList all(bins_.sites.size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  Result<void> disputeAll() {
    disputed_ = allSites();
    return {};
  }

  Result<void> propose() {
    const std::size_t grain = std::clamp<std::size_t>(bins_.bins() / 16, 1, 2048);
    return inArenas(bins_.bins(), grain, 0, 0.4, [this](std::size_t begin, std::size_t end, RowArena& arena) {
      dispute(proposeBins(begin, end, arena));
    });
  }

  /// Sets the rows that are proposed for some bins, and returns the sites without.
  SiteList proposeBins(std::size_t begin, std::size_t end, RowArena& arena) {
    struct Taken {
      Rows& rows;
      RowArena& arena;
      SiteList left;
    } taken{found_.rows, arena, {}};
    propose_cells_(
        lanes_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
        [](void* context, std::uint32_t site, const ProposedCell& cell) {
          auto& [rows, into, left] = *static_cast<Taken*>(context);
          if (cell.state == Proposed::whole &&
              rows.set(site, {cell.neighbor, static_cast<std::size_t>(cell.faces)}, cell.corner,
                       static_cast<std::size_t>(cell.vertices), into)) {
            return;
          }
          left.push_back(site);
        },
        &taken);
    return std::move(taken.left);
  }

  /// Whether nearly all cells of a sample have ties, as in lattices: float breaks them otherwise than exact
  /// signs do, so that proposals are in vain.
  bool tiesAreEverywhere() {
    constexpr std::size_t ranges = 32, bins_of_range = 4, least_bins = 2048;
    if (bins_.bins() < least_bins) return false;
    RowArena arena;
    CellCheck cell_check(places_, found_.rows);
    std::size_t sites = 0, tied = 0;
    for (std::size_t k = 0; k < ranges; ++k) {
      const std::size_t bin = bins_.bins() / ranges * k;
      tied += proposeBins(bin, bin + bins_of_range, arena).size();
      for (std::uint32_t site = bins_.begin[bin]; site < bins_.begin[bin + bins_of_range]; ++site) {
        ++sites;
        if (found_.rows[site].faces == 0) continue;
        const Verdict verdict = cell_check.check(static_cast<Label>(site), true);
        tied += verdict.tied || verdict.unsure || verdict.broken == Broken::rings ? 1 : 0;
        found_.rows.clear(site);
      }
    }
    return sites > ranges && tied > sites - sites / 8;
  }

  /// One that no other thread uses: they keep what they know from one range of sites to the next.
  std::unique_ptr<ExactSearch> takeSearch() {
    const std::scoped_lock lock(mutex_);
    if (searches_.empty()) return std::make_unique<ExactSearch>(bins_);
    auto search = std::move(searches_.back());
    searches_.pop_back();
    return search;
  }

  /// Recomputes the cells in dispute exactly.
  Result<void> recompute(double from, double to) {
    sortUnique(disputed_);
    const std::size_t grain = std::clamp<std::size_t>(disputed_.size() / 256, 16, 4096);
    const auto done =
        inArenas(disputed_.size(), grain, from, to, [&](std::size_t begin, std::size_t end, RowArena& arena) {
          std::unique_ptr<ExactSearch> search = takeSearch();
          for (std::size_t k = begin; k < end; ++k) {
            const std::uint32_t site = disputed_[k];
            const ExactRow& row = search->rowOf(static_cast<Label>(site));
            exact_[site] = 1;
            found_.rows.clear(site);
            if (!row.neighbors.empty()) found_.rows.set(site, row.neighbors, row.vertices, arena);
          }
          const std::scoped_lock lock(mutex_);
          searches_.push_back(std::move(search));
        });
    VORPIPE_TRY(done);
    found_.exact += disputed_.size();
    disputed_.clear();
    return {};
  }

  /// Checks cells, keeps their measures, and disputes those that are not proved.
  Result<void> check(const SiteList& which) {
    const std::size_t grain = std::clamp<std::size_t>(which.size() / 16, 1, 4096);
    VORPIPE_TRY(inSteps(which.size(), grain, 0.5, 0.8, [&](std::size_t begin, std::size_t end) {
      const bool moments = !found_.moments.empty();
      CellCheck cell_check(places_, found_.rows, moments);
      SiteList disputed;
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t site = which[k];
        if (found_.rows[site].faces == 0) {
          if (exact_[site] == 0) disputed.push_back(site);
          continue;
        }
        const Verdict verdict = cell_check.check(static_cast<Label>(site), exact_[site] != 0);
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
        careful_[site] = verdict.unsure || isOutside(places_, site) ? 1 : 0;
        found_.measures[site] = cell_check.measures();
        if (moments) found_.moments[site] = cell_check.secondMoments();
        auto& areas = found_.face_areas[site];
        areas.resize(found_.rows[site].faces);
        for (std::size_t f = 0; f < areas.size(); ++f) areas[f] = cell_check.faceArea(f);
      }
      dispute(std::move(disputed));
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
  Places places_;
  LaneBins lanes_;
  ProposeCells propose_cells_;
  const Progress& progress_;
  int threads_;
  CertifiedRows found_;
  std::vector<std::uint8_t> tied_, careful_, exact_;  ///< by site
  SiteList disputed_;
  std::vector<std::unique_ptr<ExactSearch>> searches_;  ///< that are idle
  std::optional<std::pair<std::uint32_t, std::uint32_t>>
      near_;  ///< two sites that are too near to each other
  std::mutex mutex_;
};

}  // namespace

std::size_t cellsOfCorner(const Rows& rows) {
  std::size_t cells = 0;
  for (std::size_t site = 0; site < rows.size(); ++site) {
    const Row row = rows[site];
    const std::size_t x = row.faceOf(labelOfWall(0)), y = row.faceOf(labelOfWall(2)),
                      z = row.faceOf(labelOfWall(4));
    if (x == row.faces || y == row.faces || z == row.faces) continue;
    const Ring ring = row.ring(x);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t b = ring[k], c = ring[k + 1 == ring.size() ? 0 : k + 1];
      cells += (b == y && c == z) || (b == z && c == y) ? 1 : 0;
    }
  }
  return cells;
}

bool forgetsSite(const Places& places, const Rows& rows, std::span<const std::uint8_t> exact) {
  for (std::size_t site = 0; site < rows.size(); ++site) {
    if (rows[site].faces == 0 && (exact[site] == 0 || !isOutside(places, site))) return true;
  }
  return false;
}

Result<CertifiedRows> certify(const SiteBins& bins, bool moments, const Progress& progress, int threads) {
  return Certifier(bins, moments, progress, threads).run();
}

}  // namespace vorpipe::space
