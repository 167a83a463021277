#include "backend/opengl/picture.h"

#include <fmt/core.h>

#include <array>
#include <cassert>
#include <cstddef>

#include "backend/opengl/bindings.h"
#include "backend/view_uniform.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::opengl {
namespace {

using Entry = CellBatch<float>::Entry;
static_assert(offsetof(Entry, north) == offsetof(Entry, west) + 3 * sizeof(float));
static_assert(offsetof(Entry, origin_offset) == offsetof(Entry, reach) + sizeof(float));
static_assert(offsetof(Entry, count) == offsetof(Entry, first) + sizeof(std::uint32_t));
static_assert(offsetof(DrawMark, y) == offsetof(DrawMark, x) + sizeof(float));
static_assert(offsetof(DrawMark, palette_index) == offsetof(DrawMark, id) + sizeof(std::uint32_t));
static_assert(sizeof(HalfPlane<float>) == 4 * sizeof(float));

constexpr GLuint attributes = 5;

}  // namespace

// The inputs of cell.vert by location, as entries and marks lie in memory.
Batch::Batch()
    : entries_(GL_ARRAY_BUFFER, GL_STREAM_DRAW),
      marks_(GL_ARRAY_BUFFER, GL_STREAM_DRAW),
      lines_(GL_RGBA32F, lines_unit) {
  glGenVertexArrays(1, &vertices_);
  glBindVertexArray(vertices_);
  for (GLuint location = 0; location < attributes; ++location) glEnableVertexAttribArray(location);
  entries_.bind();
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Entry), bufferOffset(offsetof(Entry, west)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Entry), bufferOffset(offsetof(Entry, reach)));
  glVertexAttribIPointer(2, 2, GL_UNSIGNED_INT, sizeof(Entry), bufferOffset(offsetof(Entry, first)));
  marks_.bind();
  glVertexAttribPointer(3, 2, GL_FLOAT, GL_FALSE, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, x)));
  glVertexAttribIPointer(4, 2, GL_UNSIGNED_INT, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, id)));
}

Result<void> Batch::send(const CellBatch<float>& batch, std::span<const DrawMark> marks) {
  glBindVertexArray(vertices_);
  entries_.write(std::as_bytes(std::span(batch.entries)));
  // Shaders fetch marks even if none are sent.
  marks_.reserve(batch.entries.size() * sizeof(DrawMark));
  marks_.write(std::as_bytes(marks));
  lines_.write(std::as_bytes(std::span(batch.lines)));
  return takeErrors(fmt::format("sending {} entries with {} lines to the device", batch.entries.size(),
                                batch.lines.size()));
}

// The inputs of polygon.vert by location, as corners lie in memory.
Triangles::Triangles()
    : corners_(GL_ARRAY_BUFFER, GL_STREAM_DRAW), corner_of_(GL_ELEMENT_ARRAY_BUFFER, GL_STREAM_DRAW) {
  glGenVertexArrays(1, &vertices_);
  glBindVertexArray(vertices_);
  for (const GLuint location : {0U, 1U}) glEnableVertexAttribArray(location);
  corners_.bind();
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, x)));
  glVertexAttribIPointer(1, 2, GL_UNSIGNED_INT, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, id)));
}

Result<void> Triangles::draw(std::span<const DrawMark> corners, std::span<const std::uint32_t> corner_of) {
  VORPIPE_TRY(program_.use({shaders::polygon_vert_410(), {}, shaders::cell_frag_410(), {}}));
  glBindVertexArray(vertices_);
  corners_.write(std::as_bytes(corners));
  corner_of_.write(std::as_bytes(corner_of));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(corner_of.size()), GL_UNSIGNED_INT, bufferOffset(0));
  glFinish();
  return takeErrors("drawing triangles");
}

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
