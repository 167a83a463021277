#include "backend/cpu/cpu.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <optional>

#include "backend/cpu/batch_cells.h"
#include "backend/cpu/grid_cells.h"
#include "backend/cpu/grid_pixels.h"
#include "backend/cpu/picture.h"
#include "backend/view_uniform.h"
#include "base/parallel.h"
#include "base/words.h"
#include "layout.glsl"

namespace vorpipe {
namespace {

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const auto begin = line.find(": ");
    if (begin != std::string::npos) return line.substr(begin + 2);
  }
  return "processor";
}

class CpuBackend final : public Backend {
 public:
  explicit CpuBackend(int threads) : threads_(threads) {
    info_.device = cpuDevice();
    // A larger picture would be in memory twice.
    info_.max_view = 8192;
    info_.max_sites = std::numeric_limits<std::int32_t>::max();
    info_.max_bins = std::numeric_limits<std::int32_t>::max() - 1;
    info_.max_lines = std::uint64_t{1} << 26;
    info_.max_entries = 1u << 24;
    info_.most_edges = EDGES_MOST;
    info_.has_vertices = false;
  }

  const BackendInfo& info() const override { return info_; }

  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override {
    sites_ = &sites;
    palette_index_ = palette_index;
    nearest_.reset();
    return {};
  }

  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override {
    assert(sites_ != nullptr);
    cpu::findOnGrid(*sites_, which, capacity, threads_, out);
    return {};
  }

  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override {
    cpu::clipBatch(batch, threads_, out);
    return {};
  }

  Result<void> begin(const View& view) override {
    view_ = view;
    return {};
  }

  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override {
    assert(sites_ != nullptr);
    const auto uniform = viewUniform(view_, info_.subpixel_bits, sites_->domain);
    cpu::statusesOnGrid(*sites_, which, capacity, uniform.outset_x, uniform.outset_y, threads_, status);
    return {};
  }

  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark>, Capacity capacity,
                    std::span<CellStatus> status) override {
    const auto uniform = viewUniform(view_, info_.subpixel_bits, view_.box);
    cpu::clipStatuses(batch, uniform.outset_x, uniform.outset_y, capacity, threads_, status);
    return {};
  }

  Result<void> drawTriangles(std::span<const DrawMark>, std::span<const std::uint32_t>) override {
    return {};
  }

  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    assert(ids.size() == rgba.size());
    assert(sites_ != nullptr);
    const std::vector<std::uint32_t> left = cpu::nearestOnGrid(*sites_, view_, threads_, ids);
    if (!left.empty()) {
      if (!nearest_) nearest_.emplace(*sites_, threads_);
      std::vector<std::uint32_t> found(left.size());
      cpu::nearestSites(*nearest_, view_, left, threads_, found);
      for (std::size_t k = 0; k < left.size(); ++k) ids[left[k]] = found[k];
    }
    parallelEach(ids.size(), 1 << 16, threads_, [&](std::size_t i) {
      rgba[i] = ids[i] == no_site ? 0 : view_.palette[palette_index_[ids[i]]];
      if (ids[i] != no_site) ids[i] = sites_->id[ids[i]];
    });
    return {};
  }

  // One loop over plain arrays, which compilers may vectorize as they do the clipping.
  Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) override {
    for (std::size_t i = 0; i < operands.size(); ++i) {
      const auto [a, b, c, d] = operands[i];
      const float root = std::sqrt(std::abs(a));
      const float product_sum = a * b + c;
      out[i] = {a / b, root, 1.0F / root, a * b, a + b, product_sum, product_sum, (a - b) + (c - d)};
    }
    return {};
  }

 private:
  int threads_;
  BackendInfo info_;
  const SiteSet* sites_ = nullptr;
  std::optional<cpu::NearestSite> nearest_;  // made when first asked
  std::span<const std::uint8_t> palette_index_;
  View view_{};
};

}  // namespace

DeviceInfo cpuDevice() {
  DeviceInfo device;
  device.backend = "cpu";
  device.name = processorName();
  device.driver = "vorpipe " + std::string(version());
  device.type = "cpu";
  device.usable = true;
  device.limits = {{"threads", static_cast<std::uint64_t>(threadCount(0))}};
  return device;
}

Result<void> checkCpuDevice(std::string_view wanted) {
  const auto name = processorName();
  if (isIndexOrPartOf(wanted, 0, name)) return {};
  return tl::unexpected(Error{
      ErrorCode::device, "cpu: there is no device '" + std::string(wanted) + "', only 0 '" + name + "'"});
}

std::unique_ptr<Backend> makeCpuBackend(const BackendOptions& options) {
  return std::make_unique<CpuBackend>(options.threads);
}

}  // namespace vorpipe
