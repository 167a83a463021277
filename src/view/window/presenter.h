/// Shows pictures in a window, by Vulkan or by OpenGL.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vorpipe/picture.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

/// A rectangle in pixels from the window's left and top; it may extend beyond the window.
struct Placement {
  double left = 0, top = 0, width = 0, height = 0;
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// A corner of a triangle of the panel.
struct PanelVertex {
  float x = 0, y = 0;      ///< in pixels of the window
  float u = 0, v = 0;      ///< in the panel's texture, 0 to 1
  std::uint32_t rgba = 0;  ///< R in the lowest byte, straight alpha
  friend bool operator==(const PanelVertex&, const PanelVertex&) = default;
};

/// Triangles that are clipped to a rectangle of the window.
struct PanelPart {
  std::uint32_t first_index = 0, indices = 0;
  std::int32_t left = 0, top = 0, right = 0, bottom = 0;
  friend bool operator==(const PanelPart&, const PanelPart&) = default;
};

/// Triangles drawn over the picture, in order; three indices each.
struct PanelTriangles {
  std::vector<PanelVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<PanelPart> parts;
  friend bool operator==(const PanelTriangles&, const PanelTriangles&) = default;
};

/// The panel's font as coverage of each texel, 0 to 255. It contains a texel of 255, for filled areas.
struct PanelTexture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> alpha;
};

/// The contents of a frame.
struct Shown {
  const Image* picture = nullptr;  ///< nullptr: none yet
  std::uint64_t version = 0;       ///< of the picture: a different number means a different picture
  Placement placement{};           ///< of the picture: the whole window if it is sharp, pixel by pixel
  const PanelTriangles* panel = nullptr;
};

/// Draws into the window it was made for. Use it only on the thread that made it.
class Presenter {
 public:
  virtual ~Presenter() = default;

  /// Sets the panel's font; call before the first panel is shown.
  virtual Result<void> setTexture(const PanelTexture& texture) = 0;

  /// Shows a frame in a window of `width` x `height` pixels (0 x 0: minimized, shows nothing). A picture
  /// placed on the whole window is copied pixel by pixel; others are scaled linearly. The rest is
  /// `background`.
  virtual Result<void> show(const Shown& frame, int width, int height) = 0;

  /// Returns what the last show() drew in the window: RGBA, row 0 at the top; `ids` is empty.
  virtual Result<Image> read() = 0;

  /// Returns a name for the panel, e.g. "Vulkan on llvmpipe".
  [[nodiscard]] virtual std::string name() const = 0;

  /// Returns the messages of the validation layers since the last call.
  virtual std::vector<std::string> validationMessages() { return {}; }
};

inline constexpr std::uint32_t background = 0xFF202020u;

enum class WindowApi : std::uint8_t { vulkan, opengl };

}  // namespace vorpipe::view
