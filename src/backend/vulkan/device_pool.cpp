#include "backend/vulkan/device_pool.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <optional>
#include <utility>

#include "backend/cell_answers.h"
#include "backend/vulkan/error.h"
#include "base/parallel.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

/// A device that has finished this many takes the next.
constexpr std::size_t entries_at_once = std::size_t{1} << 16;
/// Fewer cells than this are not worth another device.
constexpr std::size_t cells_per_device = std::size_t{1} << 14;
constexpr std::size_t pixels_at_once = std::size_t{1} << 16;

/// One of the parts that make up all entries.
struct Part {
  std::size_t index, begin, end;
  [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Calls work with a part of the entries of a batch and their lines.
template <class Real, class Work>
Result<void> onSlice(const CellBatch<Real>& batch, const Part& part, const Work& work) {
  if (part.size() == batch.entries.size()) return work(batch);
  CellBatch<Real> cut;
  cut.entries.assign(batch.entries.begin() + static_cast<std::ptrdiff_t>(part.begin),
                     batch.entries.begin() + static_cast<std::ptrdiff_t>(part.end));
  std::uint32_t first = cut.entries.front().first;
  std::uint32_t last = first;
  for (const auto& entry : cut.entries) {
    first = std::min(first, entry.first);
    last = std::max(last, entry.first + entry.count);
  }
  cut.lines.assign(batch.lines.begin() + first, batch.lines.begin() + last);
  for (auto& entry : cut.entries) entry.first -= first;
  return work(cut);
}

/// Lets a device draw some of the triangles, with only the corners that they use.
Result<void> onTriangles(std::span<const DrawMark> corners, std::span<const std::uint32_t> corner_of,
                         Backend& device) {
  const auto [least, greatest] = std::ranges::minmax(corner_of);
  std::vector<std::uint32_t> own(corner_of.size());
  std::ranges::transform(corner_of, own.begin(), [first = least](auto corner) { return corner - first; });
  return device.drawTriangles(corners.subspan(least, greatest - least + 1), own);
}

class DevicePool final : public Backend {
 public:
  DevicePool(std::unique_ptr<Backend> first, OpenDevice open, int most_devices)
      : open_(std::move(open)), most_devices_(static_cast<std::size_t>(most_devices)) {
    devices_.push_back(std::move(first));
  }

  const BackendInfo& info() const override { return devices_[0]->info(); }

  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override {
    sites_ = &sites;
    palette_index_.assign(palette_index.begin(), palette_index.end());
    with_sites_ = 1;
    return devices_[0]->upload(sites, palette_index_);
  }

  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override {
    VORPIPE_TRY(giveSites(devicesFor(which.size())));
    return collect(
        which.size(),
        [&](Backend& device, const Part& part, CellNeighbors& found) {
          return device.cells(which.subspan(part.begin, part.size()), capacity, found);
        },
        out);
  }

  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override {
    return collect(
        batch.entries.size(),
        [&](Backend& device, const Part& part, CellNeighbors& found) {
          return onSlice(batch, part, [&](const auto& cut) { return device.cells(cut, found); });
        },
        out);
  }

  Result<void> begin(const View& view) override {
    view_ = view;
    drawings_ = 0;
    return each(devices_.size(), [&](Backend& device) { return device.begin(view); });
  }

  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override {
    VORPIPE_TRY(giveSites(devicesFor(which.size())));
    VORPIPE_TRY(spread(which.size(), [&](Backend& device, const Part& part) {
      return device.draw(which.subspan(part.begin, part.size()), capacity,
                         status.subspan(part.begin, part.size()));
    }));
    noteDrawings(status, [&](std::size_t entry) { return sites_->id[which[entry]]; });
    return {};
  }

  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
                    std::span<CellStatus> status) override {
    VORPIPE_TRY(spread(batch.entries.size(), [&](Backend& device, const Part& part) {
      return onSlice(batch, part, [&](const auto& cut) {
        return device.draw(cut, marks.subspan(part.begin, part.size()), capacity,
                           status.subspan(part.begin, part.size()));
      });
    }));
    noteDrawings(status, [&](std::size_t entry) { return marks[entry].id; });
    return {};
  }

  Result<void> drawTriangles(std::span<const DrawMark> corners,
                             std::span<const std::uint32_t> corner_of) override {
    VORPIPE_TRY(spread(corner_of.size() / 3, [&](Backend& device, const Part& part) {
      return onTriangles(corners, corner_of.subspan(3 * part.begin, 3 * part.size()), device);
    }));
    auto last = no_site;
    for (const DrawMark& corner : corners) {
      if (std::exchange(last, corner.id) != corner.id) ++drawings_;
      noteDrawing(corner.id);
    }
    return {};
  }

  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    VORPIPE_TRY(devices_[0]->read(rgba, ids));
    std::vector<std::uint32_t> other_rgba(rgba.size());
    std::vector<std::uint32_t> other_ids(ids.size());
    for (std::size_t device = 1; device < devices_.size(); ++device) {
      VORPIPE_TRY(devices_[device]->read(other_rgba, other_ids));
      parallelEach(ids.size(), pixels_at_once, 0, [&](std::size_t i) {
        if (other_ids[i] == no_site || drawnAt(ids[i]) > drawnAt(other_ids[i])) return;
        ids[i] = other_ids[i];
        rgba[i] = other_rgba[i];
      });
    }
    return {};
  }

  // All devices are one device.
  Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) override {
    return devices_[0]->compute(operands, out);
  }

  std::vector<PipelineTime> pipelinesMade() override { return ofAll(&Backend::pipelinesMade); }
  std::vector<std::string> validationMessages() override { return ofAll(&Backend::validationMessages); }

 private:
  /// Returns what each device reports, one after the other.
  template <class Said>
  std::vector<Said> ofAll(std::vector<Said> (Backend::*said)()) {
    std::vector<Said> all;
    for (const auto& device : devices_) {
      for (Said& one : ((*device).*said)()) all.push_back(std::move(one));
    }
    return all;
  }

  /// Calls work(lane) for the first `count` devices at the same time; returns the first device's error.
  template <class Work>
  Result<void> each(std::size_t count, const Work& work) {
    std::vector<Result<void>> results(count);
    parallelFor(count, 1, static_cast<int>(count),
                [&](std::size_t device, std::size_t) { results[device] = work(*devices_[device]); });
    for (auto& result : results) {
      if (!result) return result;
    }
    return {};
  }

  [[nodiscard]] std::size_t devicesFor(std::size_t count) const {
    return std::clamp<std::size_t>(count / cells_per_device, 1, most_devices_);
  }

  [[nodiscard]] std::size_t partsOf(std::size_t count) const {
    const auto devices = devicesFor(count);
    const auto size = std::clamp(count / (2 * devices), cells_per_device, entries_at_once);
    return devices == 1 ? 1 : (count + size - 1) / size;
  }

  /// Calls work(lane, part) for every part. A device takes one part after the other, in ascending order, so
  /// that its picture has what was drawn last on top.
  template <class Work>
  Result<void> spread(std::size_t count, const Work& work) {
    if (count == 0) return {};
    const auto devices = devicesFor(count);
    VORPIPE_TRY(openDevices(devices));
    const auto parts = partsOf(count);
    std::atomic<std::size_t> next = 0;
    return each(devices, [&](Backend& device) -> Result<void> {
      for (std::size_t part; (part = next.fetch_add(1)) < parts;) {
        VORPIPE_TRY(work(device, {part, count * part / parts, count * (part + 1) / parts}));
      }
      return {};
    });
  }

  /// Calls work(device, part, its cells) for every part; out becomes the cells of all.
  template <class Work>
  Result<void> collect(std::size_t count, const Work& work, CellNeighbors& out) {
    try {
      std::vector<CellNeighbors> found(partsOf(count));
      VORPIPE_TRY(spread(
          count, [&](Backend& device, const Part& part) { return work(device, part, found[part.index]); }));
      out = std::move(found[0]);
      if (out.offsets.empty()) out.offsets.push_back(0);
      for (std::size_t part = 1; part < found.size(); ++part) append(found[part], out);
      return {};
    } catch (const std::bad_alloc&) {
      return outOfMemory(count);
    }
  }

  /// Uploads the sites to `count` devices. A device gets them only when it is asked for cells by index. If it
  /// is opened for a batch, the sites of the last upload may be gone.
  Result<void> giveSites(std::size_t count) {
    if (sites_ == nullptr) return {};  // then no cell is asked for
    VORPIPE_TRY(openDevices(count));
    for (; with_sites_ < count; ++with_sites_)
      VORPIPE_TRY(devices_[with_sites_]->upload(*sites_, palette_index_));
    return {};
  }

  Result<void> openDevices(std::size_t count) {
    while (devices_.size() < count) {
      VORPIPE_VAR(device, open_());
      if (view_) VORPIPE_TRY(device->begin(*view_));
      devices_.push_back(std::move(device));
    }
    return {};
  }

  template <class IdOf>
  void noteDrawings(std::span<const CellStatus> status, const IdOf& id_of) {
    for (std::size_t entry = 0; entry < status.size(); ++entry) {
      ++drawings_;
      if (status[entry] == CellStatus::certified) noteDrawing(id_of(entry));
    }
  }

  void noteDrawing(std::size_t id) {
    if (id >= drawn_.size()) drawn_.resize(id + 1);
    drawn_[id] = drawings_;
  }

  /// Returns when the cell of an id was drawn last. A pixel with an invalid id was never drawn; core detects
  /// that.
  [[nodiscard]] std::uint64_t drawnAt(std::uint32_t id) const { return id < drawn_.size() ? drawn_[id] : 0; }

  OpenDevice open_;
  std::size_t most_devices_;
  std::vector<std::unique_ptr<Backend>> devices_;
  std::optional<View> view_;
  const SiteSet* sites_ = nullptr;
  std::size_t with_sites_ = 0;  ///< devices [0, with_sites_) have the sites of the last upload
  std::vector<std::uint8_t> palette_index_;
  std::uint64_t drawings_ = 0;
  std::vector<std::uint64_t> drawn_;  ///< by id: when its cell was drawn last
};

}  // namespace

std::unique_ptr<Backend> makeDevicePool(std::unique_ptr<Backend> first, OpenDevice open, int most_devices) {
  return std::make_unique<DevicePool>(std::move(first), std::move(open), most_devices);
}

}  // namespace vorpipe::vulkan
