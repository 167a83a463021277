/// The backend "vulkan-geometry".
#pragma once

#include <volk.h>

#include <array>
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
#include "backend/vulkan/device.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/painter.h"
#include "backend/vulkan/physical.h"
#include "backend/vulkan/pipelines.h"
#include "backend/vulkan/target.h"
#include "backend/vulkan/uploaded_sites.h"

namespace vorpipe::vulkan {

class GeometryBackend final : public Backend {
 public:
  /// Opens a usable device.
  static Result<std::unique_ptr<Backend>> open(Instance instance, const Physical& physical);

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
  /// Where a pipeline draws to, and the vertex buffers that it draws from.
  struct Pass {
    VkPipeline pipeline;
    VkRenderPass pass;
    VkFramebuffer framebuffer;
    VkExtent2D extent;
    std::array<VkBuffer, 2> vertices;  ///< the second may be the first again
    VkDeviceSize stride;               ///< of the first
  };
  struct CellWork {
    Capacity capacity;
    Entries entries;
    VkBuffer vertices;
    VkDeviceSize stride;
    std::size_t count;
  };

  GeometryBackend(Instance instance, Device device, Bindings bindings, Pipelines pipelines, BackendInfo info);

  [[nodiscard]] Entries siteEntries() const {
    return sites_.weighted() ? Entries::weighted_sites : Entries::sites;
  }
  Result<void> setView(const View& view);
  Result<void> createEmptyFramebuffer();
  Result<void> sendBatch(const CellBatch<float>& batch, std::span<const DrawMark> marks);
  Result<void> sendWhich(std::span<const std::uint32_t> which);
  Result<void> reserveStatus(std::size_t entries);
  Result<void> drawEntries(Entries entries, Capacity capacity, std::array<VkBuffer, 2> vertices,
                           std::span<CellStatus> status);
  Result<void> findCells(const CellWork& work, CellNeighbors& out);
  Result<void> run(const Pass& pass, std::size_t first, std::size_t count);

  Instance instance_;
  Device device_;
  Bindings bindings_;
  Pipelines pipelines_;
  BackendInfo info_;
  std::optional<Painter> painter_;  ///< made when first asked for
  Target target_;
  UploadedSites sites_;
  View shown_{{0, 0, 1, 1}, 1, 1, {}};
  Box domain_{0, 0, 1, 1};  ///< of the sites
  Handle<VkFramebuffer> empty_framebuffer_;
  Buffer view_, palette_, entries_, marks_, lines_, which_, status_, host_status_, edges_;
};

}  // namespace vorpipe::vulkan
