/// The backend "vulkan-geometry".
#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "backend/backend.h"
#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/physical.h"
#include "backend/vulkan/pipelines.h"
#include "backend/vulkan/target.h"

namespace vorpipe::vulkan {

class GeometryBackend final : public Backend {
 public:
  /// Opens a usable device.
  static Result<std::unique_ptr<Backend>> open(Instance instance, const Physical& physical);

  const BackendInfo& info() const override { return info_; }
  /// Does nothing: the lines of a batch are all that the shaders need.
  Result<void> upload(const SiteSet& sites) override;
  Result<void> begin(const View& view) override;
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                    std::span<CellStatus> status) override;
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override;
  Result<void> cells(const CellBatch<double>& batch, CellPolygons& out) override;
  std::vector<std::string> validationMessages() override { return instance_.messages().take(); }

 private:
  struct Pass {
    VkPipeline pipeline;
    VkRenderPass pass;
    VkFramebuffer framebuffer;
    VkExtent2D extent;
  };

  GeometryBackend(Instance instance, Device device, Bindings bindings, Pipelines pipelines, BackendInfo info);

  Result<void> setView(const View& view);
  Result<void> createEmptyFramebuffer();
  Result<void> reserveBatch(std::size_t entries, std::size_t marks, std::size_t lines);
  Result<void> run(const Pass& pass, std::size_t first, std::size_t count);
  Result<void> runCells(const CellBatch<double>& batch, CellPolygons& out);
  void appendCells(std::size_t count, CellPolygons& out) const;
  [[nodiscard]] CellStatus statusAt(std::size_t entry) const;

  Instance instance_;
  Device device_;
  Bindings bindings_;
  Pipelines pipelines_;
  BackendInfo info_;
  Target target_;
  Handle<VkFramebuffer> empty_framebuffer_;
  Buffer view_, palette_, entries_, marks_, lines_, status_, host_status_, edges_;
};

}  // namespace vorpipe::vulkan
