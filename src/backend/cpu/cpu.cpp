#include "backend/cpu/cpu.h"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <optional>

#include "backend/cpu/cells.h"
#include "backend/cpu/picture.h"
#include "backend/view_uniform.h"
#include "layout.glsl"
#include "parallel.h"

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
    info_.max_view = 32768;
    info_.max_lines = std::uint64_t{1} << 26;
    info_.max_entries = 1u << 20;
    info_.most_edges = EDGES_MOST;
  }

  const BackendInfo& info() const override { return info_; }

  Result<void> upload(const SiteSet& sites) override {
    sites_ = &sites;
    nearest_.emplace(sites);
    const auto last = std::max_element(sites.id.begin(), sites.id.end());
    shade_.assign(last == sites.id.end() ? 0 : *last + std::size_t{1}, 0);
    return {};
  }

  Result<void> begin(const View& view) override {
    view_ = view;
    return {};
  }

  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                    std::span<CellStatus> status) override {
    const auto uniform = viewUniform(view_, info_.subpixel_bits);
    cpu::clipStatuses(batch, uniform.outset_x, uniform.outset_y, room, threads_, status);
    for (const auto& mark : marks) shade_[mark.id] = static_cast<std::uint8_t>(mark.shade);
    return {};
  }

  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    assert(nearest_ && ids.size() == rgba.size());
    cpu::nearestSites(*nearest_, view_, threads_, ids);
    parallelFor(ids.size(), 1 << 16, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        ids[i] = sites_->id[ids[i]];
        rgba[i] = view_.palette[shade_[ids[i]]];
      }
    });
    return {};
  }

  Result<void> cells(const CellBatch<double>& batch, CellPolygons& out) override {
    cpu::clipPolygons(batch, threads_, out);
    return {};
  }

 private:
  int threads_;
  BackendInfo info_;
  const SiteSet* sites_ = nullptr;
  std::optional<cpu::NearestSite> nearest_;
  std::vector<std::uint8_t> shade_;  // by site, in input order
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

std::unique_ptr<Backend> makeCpuBackend(const BackendOptions& options) {
  return std::make_unique<CpuBackend>(options.threads);
}

}  // namespace vorpipe
