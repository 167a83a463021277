/// A panel that tests click on, in front of what a window would be.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "view/panel.h"

namespace vorpipe::view {

inline DeviceInfo device(const std::string& backend, const std::string& name,
                         const std::string& reason = "") {
  DeviceInfo info;
  info.backend = backend;
  info.name = name;
  info.usable = reason.empty();
  info.reason = reason;
  return info;
}

/// A panel, in front of what a window would be.
class PanelTest : public ::testing::Test {
 protected:
  PanelTest() {
    input_.width = 1280;
    input_.height = 1000;
    input_.settings.picture.color = ColorBy::area;
    input_.devices = {device("vulkan-compute", "llvmpipe"), device("opengl", "", "libEGL.so.1 is missing"),
                      device("vulkan-geometry", "Radeon 1"), device("vulkan-geometry", "Radeon 2"),
                      device("cpu", "2 threads")};
    input_.sites = 1234;
    input_.keys = {{"E", "edges"}, {"?", "this list"}};
    draw();
  }

  PanelResult draw() {
    PanelResult result = panel_.draw(input_, triangles_);
    expectSound();
    return result;
  }

  /// Indices within vertices, parts within indices and the window, texture coordinates within the texture.
  void expectSound() const {
    std::size_t next = 0;
    for (const PanelPart& part : triangles_.parts) {
      EXPECT_EQ(part.first_index, next);
      EXPECT_EQ(part.indices % 3, 0U);
      EXPECT_GT(part.indices, 0U);
      next += part.indices;
      EXPECT_TRUE(0 <= part.left && part.left < part.right && part.right <= input_.width);
      EXPECT_TRUE(0 <= part.top && part.top < part.bottom && part.bottom <= input_.height);
    }
    EXPECT_EQ(next, triangles_.indices.size());
    for (const std::uint32_t index : triangles_.indices) ASSERT_LT(index, triangles_.vertices.size());
    for (const PanelVertex& vertex : triangles_.vertices) {
      EXPECT_TRUE(vertex.u >= 0 && vertex.u <= 1 && vertex.v >= 0 && vertex.v <= 1);
    }
  }

  [[nodiscard]] Position middleOf(const std::string& name) const {
    const auto found = panel_.placements().find(name);
    EXPECT_NE(found, panel_.placements().end()) << name;
    if (found == panel_.placements().end()) return {-1, -1};
    const Placement& at = found->second;
    return {at.left + at.width / 2, at.top + at.height / 2};
  }

  bool take(Position to, bool press) {
    panel_.take(Move{to});
    return press ? panel_.take(Press{}) : panel_.take(Release{});
  }

  /// Presses and lets go in the middle of what has a name; what changes is what the next frame begins with.
  PanelResult click(const std::string& name) {
    const Position at = middleOf(name);
    EXPECT_TRUE(take(at, true)) << name;
    EXPECT_TRUE(take(at, false)) << name;
    PanelResult result = draw();
    input_.settings = result.settings;
    return result;
  }

  Panel panel_;
  PanelInput input_;
  PanelTriangles triangles_;
};

}  // namespace vorpipe::view
