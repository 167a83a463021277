/// The backend "vulkan-compute": cells and pictures without a geometry shader.
#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backend/backend.h"
#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/compute_kernels.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/painter.h"
#include "backend/vulkan/physical.h"
#include "backend/vulkan/sorted_sites.h"
#include "backend/vulkan/target.h"
#include "backend/vulkan/triangle_list.h"
#include "backend/vulkan/uploaded_sites.h"

namespace vorpipe::vulkan {

/// Where the sites of an upload are sorted into the bins of their grid. The host always sorts sites with
/// weights.
enum class SiteSorter : std::uint8_t { host, device };

class ComputeBackend final : public Backend {
 public:
  /// Opens a usable device.
  static Result<std::unique_ptr<Backend>> open(Instance instance, const Physical& physical,
                                               SiteSorter sorter);

  const BackendInfo& info() const override { return info_; }
  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override;
  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override;
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override;
  Result<void> begin(const View& view) override;
  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override;
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
                    std::span<CellStatus> status) override;
  Result<void> drawTriangles(std::span<const DrawMark> corners,
                             std::span<const std::uint32_t> corner_of) override;
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override;
  Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) override;
  [[nodiscard]] double deviceSeconds() const override { return device_.seconds(); }
  std::vector<PipelineTime> pipelinesMade() override { return device_.pipelines().take(); }
  std::vector<std::string> validationMessages() override { return instance_.messages().take(); }

 private:
  /// Everything that is created before the backend.
  struct Parts {
    Instance instance;
    Device device;
    Bindings sites, lists;
    std::optional<SortedSites> sorted;  ///< if the device sorts sites
    ComputeKernels kernels;
    TriangleList triangles;
    Painter painter;
  };
  /// The entries in a buffer, and how they are clipped.
  struct ClipJob {
    Bindings& bindings;
    ComputeKernels::Code code;
    std::size_t room;  ///< for edges
    std::size_t count;
    bool weighted = false;
  };

  static std::size_t roomOf(Capacity capacity) {
    return capacity == Capacity::small ? EDGES_FAST : EDGES_MOST;
  }

  ComputeBackend(Parts parts, BackendInfo info, std::uint64_t storage_range);

  Result<void> setView(const View& view);
  Result<void> sendWhich(std::span<const std::uint32_t> which);
  Result<void> sendBatch(const CellBatch<float>& batch);
  void bindPolygons(Bindings& bindings) const;
  Result<void> findCells(const ClipJob& job, CellNeighbors& out);
  Result<void> drawCells(const ClipJob& job, std::span<CellStatus> status);
  [[nodiscard]] std::size_t sliceOf(std::size_t most_entries, std::size_t bytes_of_entry) const;

  Instance instance_;
  Device device_;
  Bindings sites_bindings_, lists_bindings_;
  ComputeKernels kernels_;
  TriangleList triangles_;
  Painter painter_;
  BackendInfo info_;
  std::uint64_t storage_range_;  ///< of an allocation
  Target target_;
  UploadedSites sites_;
  std::optional<SortedSites> sorted_;
  bool sorted_here_ = false;  ///< whether sorted_ sorted the sites of the upload
  bool weighted_ = false;
  View shown_{{0, 0, 1, 1}, 1, 1, {}};
  Box domain_{0, 0, 1, 1};  ///< of the sites
  Buffer view_, entries_, lines_, marks_, answers_, vertices_;
};

}  // namespace vorpipe::vulkan
