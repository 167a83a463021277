#include "backend/opengl/picture.h"

#include <fmt/core.h>

#include <array>
#include <cassert>

#include "backend/opengl/bindings.h"
#include "backend/view_uniform.h"
#include "base/try.h"

namespace vorpipe::opengl {
namespace {

constexpr GLenum color_attachment = GL_COLOR_ATTACHMENT0;
constexpr GLenum id_attachment = GL_COLOR_ATTACHMENT1;

// R in the lowest byte of a word, whatever the machine's byte order.
constexpr GLenum rgba_word = GL_UNSIGNED_INT_8_8_8_8_REV;

}  // namespace

Picture::Picture(int subpixel_bits)
    : subpixel_bits_(subpixel_bits),
      view_(GL_UNIFORM_BUFFER, GL_STREAM_DRAW),
      palette_(GL_RGBA8, palette_unit) {
  glGenFramebuffers(1, &framebuffer_);
  glGenRenderbuffers(1, &color_);
  glGenRenderbuffers(1, &id_);
}

Result<Picture> Picture::create(int subpixel_bits) {
  Picture picture(subpixel_bits);
  // Until the caller's first view: OpenGL draws nothing, and clips nothing, without a framebuffer.
  VORPIPE_TRY(picture.begin(picture.shown_));
  return picture;
}

Result<void> Picture::resize(int width, int height) {
  glBindRenderbuffer(GL_RENDERBUFFER, color_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glBindRenderbuffer(GL_RENDERBUFFER, id_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_R32UI, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, color_attachment, GL_RENDERBUFFER, color_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, id_attachment, GL_RENDERBUFFER, id_);
  constexpr std::array<GLenum, 2> targets = {color_attachment, id_attachment};
  glDrawBuffers(static_cast<GLsizei>(targets.size()), targets.data());
  width_ = 0;
  height_ = 0;
  const auto size = fmt::format("making a picture of {} x {} pixels", width, height);
  VORPIPE_TRY(takeErrors(size));
  if (const GLenum state = glCheckFramebufferStatus(GL_FRAMEBUFFER); state != GL_FRAMEBUFFER_COMPLETE) {
    return tl::unexpected(
        Error{ErrorCode::device,
              fmt::format("opengl: {}: the framebuffer is incomplete ({:#x}); try another device or backend",
                          size, state)});
  }
  width_ = width;
  height_ = height;
  return {};
}

void Picture::sendView() {
  const ViewUniform uniform = viewUniform(shown_, subpixel_bits_, domain_);
  view_.write(std::as_bytes(std::span(&uniform, 1)));
}

void Picture::setDomain(const Box& domain) {
  domain_ = domain;
  sendView();
}

Result<void> Picture::begin(const View& view) {
  if (view.width != width_ || view.height != height_) {
    VORPIPE_TRY(resize(view.width, view.height));
  }
  shown_ = view;
  sendView();
  palette_.write(std::as_bytes(std::span(view.palette)));
  bind();
  constexpr std::array<GLfloat, 4> no_color = {0, 0, 0, 0};
  constexpr std::array<GLuint, 4> no_id = {no_site, no_site, no_site, no_site};
  glClearBufferfv(GL_COLOR, 0, no_color.data());
  glClearBufferuiv(GL_COLOR, 1, no_id.data());
  return takeErrors("clearing the picture");
}

void Picture::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_, height_);
  glBindBufferBase(GL_UNIFORM_BUFFER, view_binding, view_.name());
}

Result<void> Picture::read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) const {
  assert(rgba.size() == static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  assert(ids.size() == rgba.size());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glReadBuffer(color_attachment);
  glReadPixels(0, 0, width_, height_, GL_RGBA, rgba_word, rgba.data());
  glReadBuffer(id_attachment);
  glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
  return takeErrors("reading the picture");
}

}  // namespace vorpipe::opengl
