/// Shows pictures in a window, by Vulkan or by OpenGL.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vorpipe/picture.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

/// A rectangle of a window, in its pixels, from the left and from the top; it may reach beyond.
struct Placement {
  double left = 0, top = 0, width = 0, height = 0;
};

/// A corner of a triangle of the panel.
struct PanelVertex {
  float x = 0, y = 0;      ///< in pixels of the window
  float u = 0, v = 0;      ///< in the panel's texture, 0 to 1
  std::uint32_t rgba = 0;  ///< R in the lowest byte, straight alpha
};

/// Triangles that are cut off outside of a rectangle of the window.
struct PanelPart {
  std::uint32_t first_index = 0, indices = 0;
  std::int32_t left = 0, top = 0, right = 0, bottom = 0;
};

/// What is drawn over the picture: triangles, in order, each three indices.
struct PanelTriangles {
  std::vector<PanelVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<PanelPart> parts;
};

/// The coverage of each texel, 0 to 255: of the panel's letters. A texel of 255 is among them, for what is
/// filled.
struct PanelTexture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> alpha;
};

/// What a frame consists of.
struct Shown {
  const Image* picture = nullptr;  ///< nullptr: none yet
  std::uint64_t version = 0;       ///< of the picture: another number means another picture
  Placement placement{};           ///< of the picture: the whole window if it is sharp, pixel on pixel
  const PanelTriangles* panel = nullptr;
};

/// Draws into the window that it was made for; of the thread that made it.
class Presenter {
 public:
  virtual ~Presenter() = default;

  /// The panel's letters, before the first panel is shown.
  virtual Result<void> setTexture(const PanelTexture& texture) = 0;

  /// Shows a frame in a window of `width` x `height` pixels (0 x 0: it is minimized, nothing is shown). A
  /// picture whose placement is the whole window is copied, pixel on pixel; another one is scaled, linearly.
  /// What it does not cover is `background`.
  virtual Result<void> show(const Shown& frame, int width, int height) = 0;

  /// What the last show() drew, as the window has it: RGBA, row 0 at the top; `ids` is empty.
  virtual Result<Image> read() = 0;

  /// "Vulkan on llvmpipe", for the panel.
  [[nodiscard]] virtual std::string name() const = 0;

  /// What the validation layers said since the last call.
  virtual std::vector<std::string> validationMessages() { return {}; }
};

inline constexpr std::uint32_t background = 0xFF202020u;

enum class WindowApi : std::uint8_t { vulkan, opengl };

}  // namespace vorpipe::view
