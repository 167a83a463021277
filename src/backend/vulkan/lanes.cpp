#include "backend/vulkan/lanes.h"

#include <algorithm>
#include <optional>

#include "parallel.h"

namespace vorpipe::vulkan {
namespace {

/// Fewer entries than this are not worth another lane.
constexpr std::size_t entries_per_lane = std::size_t{1} << 14;
constexpr std::size_t pixels_at_once = std::size_t{1} << 16;

/// The entries [begin, end) of a batch with their lines.
CellBatch<float> slice(const CellBatch<float>& batch, std::size_t begin, std::size_t end) {
  CellBatch<float> part;
  part.entries.assign(batch.entries.begin() + static_cast<std::ptrdiff_t>(begin),
                      batch.entries.begin() + static_cast<std::ptrdiff_t>(end));
  std::uint32_t first = part.entries.front().first;
  std::uint32_t last = first;
  for (const auto& entry : part.entries) {
    first = std::min(first, entry.first);
    last = std::max(last, entry.first + entry.count);
  }
  part.lines.assign(batch.lines.begin() + first, batch.lines.begin() + last);
  for (auto& entry : part.entries) entry.first -= first;
  return part;
}

class Lanes final : public Backend {
 public:
  Lanes(std::unique_ptr<Backend> first, OpenLane open, int most_lanes)
      : open_(std::move(open)), most_lanes_(static_cast<std::size_t>(most_lanes)) {
    lanes_.push_back(std::move(first));
  }

  const BackendInfo& info() const override { return lanes_[0]->info(); }

  Result<void> upload(const SiteSet& sites) override { return lanes_[0]->upload(sites); }

  Result<void> begin(const View& view) override {
    view_ = view;
    drawings_ = 0;
    return each([&](std::size_t lane) { return lanes_[lane]->begin(view); });
  }

  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                    std::span<CellStatus> status) override {
    const auto count = batch.entries.size();
    const auto used = std::clamp<std::size_t>(count / entries_per_lane, 1, most_lanes_);
    if (auto opened = openLanes(used); !opened) return opened;
    if (used == 1) {
      if (auto drawn = lanes_[0]->draw(batch, marks, room, status); !drawn) return drawn;
    } else if (auto drawn = drawSlices(batch, marks, room, status, used); !drawn) {
      return drawn;
    }
    noteDrawings(marks, status);
    return {};
  }

  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    if (auto read = lanes_[0]->read(rgba, ids); !read) return read;
    std::vector<std::uint32_t> lane_rgba(rgba.size());
    std::vector<std::uint32_t> lane_ids(ids.size());
    for (std::size_t lane = 1; lane < lanes_.size(); ++lane) {
      if (auto read = lanes_[lane]->read(lane_rgba, lane_ids); !read) return read;
      parallelFor(ids.size(), pixels_at_once, 0, [&](std::size_t begin, std::size_t end) {
        for (auto i = begin; i < end; ++i) {
          if (lane_ids[i] == no_site || (ids[i] != no_site && drawn_[ids[i]] > drawn_[lane_ids[i]])) continue;
          ids[i] = lane_ids[i];
          rgba[i] = lane_rgba[i];
        }
      });
    }
    return {};
  }

  Result<void> cells(const CellBatch<double>& batch, CellPolygons& out) override {
    return lanes_[0]->cells(batch, out);
  }

  std::vector<std::string> validationMessages() override {
    std::vector<std::string> all;
    for (const auto& lane : lanes_) {
      for (auto& message : lane->validationMessages()) all.push_back(std::move(message));
    }
    return all;
  }

 private:
  /// Calls work(lane) for every open lane at the same time; returns the first lane's error.
  template <class Work>
  Result<void> each(const Work& work) {
    std::vector<Result<void>> results(lanes_.size());
    const auto threads = static_cast<int>(lanes_.size());
    parallelFor(lanes_.size(), 1, threads,
                [&](std::size_t lane, std::size_t) { results[lane] = work(lane); });
    for (auto& result : results) {
      if (!result) return result;
    }
    return {};
  }

  Result<void> openLanes(std::size_t count) {
    while (lanes_.size() < count) {
      auto lane = open_();
      if (!lane) return tl::unexpected(lane.error());
      if (auto begun = (*lane)->begin(*view_); !begun) return begun;
      lanes_.push_back(std::move(*lane));
    }
    return {};
  }

  Result<void> drawSlices(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                          std::span<CellStatus> status, std::size_t used) {
    const auto count = batch.entries.size();
    return each([&](std::size_t lane) -> Result<void> {
      const auto begin = std::min(count, count * lane / used);
      const auto end = std::min(count, count * (lane + 1) / used);
      if (begin == end) return {};
      return lanes_[lane]->draw(slice(batch, begin, end), marks.subspan(begin, end - begin), room,
                                status.subspan(begin, end - begin));
    });
  }

  void noteDrawings(std::span<const DrawMark> marks, std::span<const CellStatus> status) {
    for (std::size_t e = 0; e < marks.size(); ++e) {
      ++drawings_;
      if (marks[e].id >= drawn_.size()) drawn_.resize(marks[e].id + std::size_t{1});
      if (status[e] == CellStatus::certified) drawn_[marks[e].id] = drawings_;
    }
  }

  OpenLane open_;
  std::size_t most_lanes_;
  std::vector<std::unique_ptr<Backend>> lanes_;
  std::optional<View> view_;
  std::uint64_t drawings_ = 0;
  std::vector<std::uint64_t> drawn_;  ///< by id: when its cell was drawn last
};

}  // namespace

std::unique_ptr<Backend> makeLanes(std::unique_ptr<Backend> first, OpenLane open, int most_lanes) {
  return std::make_unique<Lanes>(std::move(first), std::move(open), most_lanes);
}

}  // namespace vorpipe::vulkan
