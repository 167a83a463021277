/// An image with its memory, and how it changes from one use to another.
#pragma once

#include <volk.h>

#include <span>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"

namespace vorpipe::vulkan {

struct Plane {
  Handle<VkDeviceMemory> memory;
  Handle<VkImage> image;
  Handle<VkImageView> view;
};

struct PlaneKind {
  VkFormat format;
  VkImageUsageFlags usage;
  VkComponentMapping components{};  ///< of the view; zero: as they are
};

/// An image of one layer and one level, with a view; its layout is undefined.
Result<Plane> createPlane(const Device& device, const PlaneKind& kind, VkExtent2D extent);

inline constexpr VkImageSubresourceRange whole_plane{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

/// What is done with an image.
struct Use {
  VkImageLayout layout;
  VkPipelineStageFlags stage;
  VkAccessFlags access;
};

inline constexpr Use drawn{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                           VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                           VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
/// Cleared, or copied to.
inline constexpr Use cleared{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                             VK_ACCESS_TRANSFER_WRITE_BIT};
inline constexpr Use copied{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                            VK_ACCESS_TRANSFER_READ_BIT};
inline constexpr Use sampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                             VK_ACCESS_SHADER_READ_BIT};
/// The drawn contents are no longer needed.
inline constexpr Use forgotten{VK_IMAGE_LAYOUT_UNDEFINED, drawn.stage, drawn.access};

/// Records that images go from one use to another.
void change(const VolkDeviceTable& api, VkCommandBuffer commands, std::span<const VkImage> images,
            const Use& from, const Use& to);

}  // namespace vorpipe::vulkan
