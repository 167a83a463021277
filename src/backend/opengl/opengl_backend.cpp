#include "backend/opengl/opengl_backend.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <new>
#include <utility>

#include "backend/opengl/cells.h"
#include "backend/opengl/device.h"
#include "backend/opengl/geometry.h"
#include "backend/opengl/gl.h"
#include "backend/opengl/picture.h"
#include "backend/opengl/sites.h"
#include "backend/to_float.h"
#include "base/try.h"

namespace vorpipe {
namespace {

using opengl::Context;
using opengl::Entries;

// All that lives in the context, which owns it.
struct Resources {
  opengl::Picture picture;
  opengl::Batch batch;
  opengl::Sites sites;
  opengl::Geometry geometry;
  opengl::Triangles triangles;
  opengl::Cells cells;
  opengl::Calculator calculator;
};

Result<Resources> makeResources(int subpixel_bits) {
  // All other state that matters is off in a new context.
  glDisable(GL_DITHER);
  glDisable(GL_MULTISAMPLE);
  VORPIPE_VAR(picture, opengl::Picture::create(subpixel_bits));
  Resources resources{std::move(picture), {}, {}, {}, {}, {}, {}};
  VORPIPE_TRY(opengl::takeErrors("making buffers"));
  return resources;
}

class OpenGlBackend final : public Backend {
 public:
  OpenGlBackend(BackendInfo info, Context context, Resources resources)
      : info_(std::move(info)), context_(std::move(context)), gl_(std::move(resources)) {}

  const BackendInfo& info() const override { return info_; }

  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override {
    assert(sites.size() <= info_.max_sites && sites.grid.offsets.size() <= info_.max_bins + 1);
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    gl_.picture.setDomain(sites.domain);
    return gl_.sites.upload(sites, palette_index);
  }

  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override {
    assert(which.size() <= info_.max_entries);
    return findCells(
        gl_.sites.entries(), capacity, which.size(), [&] { return gl_.sites.send(which); }, out);
  }

  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override {
    assert(batch.lines.size() <= info_.max_lines && batch.entries.size() <= info_.max_entries);
    return findCells(
        Entries::lists, Capacity::large, batch.entries.size(),
        [&] { return gl_.batch.send(toFloat(batch), {}); }, out);
  }

  Result<void> begin(const View& view) override {
    assert(std::max(view.width, view.height) <= info_.max_view);
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    return gl_.picture.begin(view);
  }

  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override {
    assert(status.size() == which.size() && which.size() <= info_.max_entries);
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    gl_.picture.bind();
    VORPIPE_TRY(gl_.sites.send(which));
    return gl_.geometry.draw(gl_.sites.entries(), capacity, status);
  }

  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
                    std::span<CellStatus> status) override {
    assert(batch.lines.size() <= info_.max_lines && batch.entries.size() <= info_.max_entries);
    assert(marks.size() == batch.entries.size() && status.size() == batch.entries.size());
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    gl_.picture.bind();
    VORPIPE_TRY(gl_.batch.send(batch, marks));
    return gl_.geometry.draw(Entries::lists, capacity, status);
  }

  Result<void> drawTriangles(std::span<const DrawMark> corners,
                             std::span<const std::uint32_t> corner_of) override {
    assert(corners.size() <= info_.max_lines && corner_of.size() <= 3 * info_.max_lines);
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    gl_.picture.bind();
    return gl_.triangles.draw(corners, corner_of);
  }

  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    return gl_.picture.read(rgba, ids);
  }

  Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) override {
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    gl_.picture.bind();
    return gl_.calculator.run(operands, out);
  }

 private:
  // send puts `count` entries on the device.
  template <class Send>
  Result<void> findCells(Entries entries, Capacity capacity, std::size_t count, const Send& send,
                         CellNeighbors& out) {
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    gl_.picture.bind();
    try {
      VORPIPE_TRY(send());
      return gl_.cells.run(entries, capacity, count, out);
    } catch (const std::bad_alloc&) {
      return tl::unexpected(
          Error{ErrorCode::device,
                fmt::format("opengl: not enough memory for {} cells; ask for fewer at a time", count), true});
    }
  }

  BackendInfo info_;
  Context context_;
  Resources gl_;
};

Result<std::unique_ptr<Backend>> open(opengl::Device device) {
  auto info = opengl::backendInfo(device);
  std::unique_ptr<Backend> backend;  // outlives the scope: a context goes after it is left
  Context context = std::move(*device.context);
  const auto scope = context.enter();
  if (!scope) return tl::unexpected(scope.error());
  VORPIPE_VAR(resources, makeResources(info.subpixel_bits));
  backend = std::make_unique<OpenGlBackend>(std::move(info), std::move(context), std::move(resources));
  return backend;
}

}  // namespace

Result<std::unique_ptr<Backend>> makeOpenGlBackend(const BackendOptions& options, Drivers drivers) {
  Capabilities any;
  VORPIPE_TRY(applyMask(any, options.mask));
  VORPIPE_VAR(device, opengl::chooseDevice(opengl::findDevices(options.mask, drivers), options.device));
  if (drivers == Drivers::hardware && device.info.type == "cpu") {
    return tl::unexpected(
        Error{ErrorCode::device, fmt::format("opengl: {} is a software driver", device.info.name)});
  }
  return open(std::move(device));
}

std::vector<DeviceInfo> listOpenGlDevices(const Mask& mask) {
  std::vector<DeviceInfo> infos;
  for (auto& device : opengl::findDevices(mask, Drivers::any)) infos.push_back(std::move(device.info));
  return infos;
}

}  // namespace vorpipe
