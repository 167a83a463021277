// Draws like the Vulkan presenter: on a canvas with row 0 at the top. The copy to the window is flipped, as
// OpenGL counts a window's rows from the bottom. The window's context owns all objects.
#include <fmt/core.h>

#include <array>
#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"
#include "backend/opengl/shader.h"
#include "base/try.h"
#include "shaders.h"
#include "view/window/frame_parts.h"
#include "view/window/window_parts.h"

namespace vorpipe::view {
namespace {

// R in the lowest byte of a word, whatever the machine's byte order.
constexpr GLenum rgba_word = GL_UNSIGNED_INT_8_8_8_8_REV;

struct Texture {
  GLuint name = 0;
  int width = 0, height = 0;
};

void makeTexture(Texture& texture) {
  glGenTextures(1, &texture.name);
  glBindTexture(GL_TEXTURE_2D, texture.name);
  for (const GLenum filter : std::array<GLenum, 2>{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }
  for (const GLenum wrap : std::array<GLenum, 2>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  }
}

// Makes room for pixels; the contents are lost if the size changes.
void resize(Texture& texture, int width, int height) {
  glBindTexture(GL_TEXTURE_2D, texture.name);
  if (texture.width == width && texture.height == height) return;
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, rgba_word, nullptr);
  texture.width = width;
  texture.height = height;
}

GLuint framebufferOf(const Texture& texture) {
  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name, 0);
  return framebuffer;
}

void clear(std::uint32_t color) {
  const auto channel = [&](int shift) { return static_cast<GLfloat>((color >> shift) & 0xFFU) / 255.0F; };
  const std::array<GLfloat, 4> channels = {channel(0), channel(8), channel(16), channel(24)};
  glClearBufferfv(GL_COLOR, 0, channels.data());
}

class OpenglPresenter final : public Presenter {
 public:
  OpenglPresenter(const Glfw& glfw, GLFWwindow* window) : glfw_(glfw), window_(window) {}

  Result<void> start() {
    enter();
    // Like Vulkan's FIFO: one frame per screen refresh.
    glfw_.swapInterval(1);
    const auto* const renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    name_ = fmt::format("OpenGL on {}", renderer == nullptr ? "a device without a name" : renderer);
    glActiveTexture(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (Texture* const texture : {&canvas_, &picture_, &panel_}) makeTexture(*texture);
    resize(canvas_, 1, 1);
    resize(picture_, 1, 1);
    canvas_framebuffer_ = framebufferOf(canvas_);
    picture_framebuffer_ = framebufferOf(picture_);
    vertices_.emplace(GL_ARRAY_BUFFER, GL_STREAM_DRAW);
    indices_.emplace(GL_ELEMENT_ARRAY_BUFFER, GL_STREAM_DRAW);
    glGenVertexArrays(1, &attributes_);
    glBindVertexArray(attributes_);
    vertices_->bind();
    indices_->bind();
    for (const GLuint location : {0U, 1U, 2U}) glEnableVertexAttribArray(location);
    constexpr GLsizei stride = sizeof(PanelVertex);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, opengl::bufferOffset(offsetof(PanelVertex, x)));
    glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, opengl::bufferOffset(offsetof(PanelVertex, u)));
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride,
                          opengl::bufferOffset(offsetof(PanelVertex, rgba)));
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    VORPIPE_TRY(useProgram());
    return opengl::takeErrors("preparing the window");
  }

  Result<void> setTexture(const PanelTexture& texture) override {
    assert(texture.alpha.size() ==
           static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
    enter();
    glBindTexture(GL_TEXTURE_2D, panel_.name);
    constexpr std::array<GLint, 4> white = {GL_ONE, GL_ONE, GL_ONE, GL_RED};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, white.data());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, texture.width, texture.height, 0, GL_RED, GL_UNSIGNED_BYTE,
                 texture.alpha.data());
    panel_.width = texture.width;
    panel_.height = texture.height;
    return opengl::takeErrors("taking the panel's letters");
  }

  Result<void> show(const Shown& frame, int width, int height) override {
    if (width <= 0 || height <= 0) return {};
    enter();
    resize(canvas_, width, height);
    if (hasPicture(frame)) takePicture(frame);
    if (isSharp(frame, width, height)) {
      glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_framebuffer_);
      glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas_framebuffer_);
      glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    } else {
      glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas_framebuffer_);
      clear(background);
    }
    VORPIPE_TRY(drawTriangles(trianglesOf(frame, width, height)));
    copyToWindow();
    drawn_ = true;
    auto shown = opengl::takeErrors("showing a frame");
    glfw_.swapBuffers(window_);
    return shown;
  }

  Result<Image> read() override {
    if (!drawn_) {
      return tl::unexpected(Error{ErrorCode::device, "the window shows nothing that could be read"});
    }
    enter();
    Image shown;
    shown.width = canvas_.width;
    shown.height = canvas_.height;
    shown.rgba.resize(static_cast<std::size_t>(shown.width) * static_cast<std::size_t>(shown.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas_framebuffer_);
    glReadPixels(0, 0, shown.width, shown.height, GL_RGBA, rgba_word, shown.rgba.data());
    VORPIPE_TRY(opengl::takeErrors("reading the window"));
    return shown;
  }

  [[nodiscard]] std::string name() const override { return name_; }

 private:
  // A session on this thread may have made its own context current.
  void enter() const {
    if (glfw_.getCurrentContext() != window_) glfw_.makeContextCurrent(window_);
  }

  Result<void> useProgram() {
    return program_.use({shaders::panel_vert_410(), {}, shaders::panel_frag_410(), {}});
  }

  void takePicture(const Shown& frame) {
    if (version_ == frame.version) return;
    const Image& picture = *frame.picture;
    opaque_.resize(picture.rgba.size());
    putOverBackground(picture, opaque_);
    resize(picture_, picture.width, picture.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture.width, picture.height, GL_RGBA, rgba_word,
                    opaque_.data());
    version_ = frame.version;
  }

  Result<void> drawTriangles(const FrameTriangles& triangles) {
    if (triangles.parts.empty()) return {};
    VORPIPE_TRY(useProgram());
    glViewport(0, 0, canvas_.width, canvas_.height);
    glBindVertexArray(attributes_);
    vertices_->write(std::as_bytes(std::span(triangles.vertices)));
    indices_->write(std::as_bytes(std::span(triangles.indices)));
    glEnable(GL_BLEND);
    glEnable(GL_SCISSOR_TEST);
    for (const TrianglePart& part : triangles.parts) {
      assert(part.surface == Surface::picture || panel_.width > 0);  // setTexture() comes first
      glBindTexture(GL_TEXTURE_2D, part.surface == Surface::picture ? picture_.name : panel_.name);
      glScissor(part.left, part.top, part.width, part.height);
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(part.indices), GL_UNSIGNED_INT,
                     opengl::bufferOffset(part.first_index * sizeof(std::uint32_t)));
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    return {};
  }

  // If the window has grown meanwhile, the new area is black until the resize event arrives.
  void copyToWindow() const {
    int width = 0, height = 0;
    glfw_.getFramebufferSize(window_, &width, &height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas_framebuffer_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    if (width > canvas_.width || height > canvas_.height) clear(0xFF000000U);
    glBlitFramebuffer(0, 0, canvas_.width, canvas_.height, 0, height, canvas_.width, height - canvas_.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }

  const Glfw& glfw_;
  GLFWwindow* window_;
  std::string name_;
  opengl::Program program_;
  std::optional<opengl::Buffer> vertices_, indices_;
  GLuint attributes_ = 0, canvas_framebuffer_ = 0, picture_framebuffer_ = 0;
  Texture canvas_, picture_, panel_;
  std::optional<std::uint64_t> version_;  ///< of the picture in picture_
  std::vector<std::uint32_t> opaque_;
  bool drawn_ = false;
};

}  // namespace

Result<std::unique_ptr<Presenter>> makeOpenglPresenter(const Glfw& glfw, GLFWwindow* window) {
  auto presenter = std::make_unique<OpenglPresenter>(glfw, window);
  VORPIPE_TRY(presenter->start());
  return presenter;
}

}  // namespace vorpipe::view
