#include "backend/opengl/opengl_backend.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "backend/opengl/device.h"
#include "backend/opengl/geometry.h"
#include "backend/opengl/picture.h"

namespace vorpipe {
namespace {

using opengl::Context;
using opengl::Geometry;
using opengl::Picture;

class OpenGlBackend final : public Backend {
 public:
  // Called, as every constructor of GL objects, while the context is current.
  OpenGlBackend(BackendInfo info, Context context, Geometry geometry)
      : info_(std::move(info)), context_(std::move(context)), geometry_(std::move(geometry)) {}

  const BackendInfo& info() const override { return info_; }

  // Entries bring all that the geometry pipeline needs to know about a site.
  Result<void> upload(const SiteSet&) override { return {}; }

  Result<void> begin(const View& view) override {
    assert(std::max(view.width, view.height) <= info_.max_view);
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    return picture_.begin(view, info_.subpixel_bits);
  }

  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                    std::span<CellStatus> status) override {
    assert(batch.lines.size() <= info_.max_lines && batch.entries.size() <= info_.max_entries);
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    picture_.bind();
    return geometry_.draw(batch, marks, room, status);
  }

  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    const auto scope = context_.enter();
    if (!scope) return tl::unexpected(scope.error());
    return picture_.read(rgba, ids);
  }

  Result<void> cells(const CellBatch<double>&, CellPolygons&) override {
    return tl::unexpected(Error{ErrorCode::device, "opengl: not yet"});
  }

 private:
  BackendInfo info_;
  Context context_;  // owns the GL objects of what follows
  Geometry geometry_;
  Picture picture_;
};

// The state that never changes; all else of it is off in a new context.
void setState() {
  glDisable(GL_DITHER);
  glDisable(GL_MULTISAMPLE);
}

}  // namespace

Result<std::unique_ptr<Backend>> makeOpenGlBackend(const BackendOptions& options) {
  Capabilities any;
  if (auto known = applyMask(any, options.mask); !known) return tl::unexpected(known.error());
  auto device = opengl::chooseDevice(opengl::findDevices(options.mask), options.device);
  if (!device) return tl::unexpected(device.error());
  auto info = opengl::backendInfo(*device);
  Context context = std::move(*device->context);
  std::unique_ptr<Backend> backend;
  const auto scope = context.enter();
  if (!scope) return tl::unexpected(scope.error());
  setState();
  auto geometry = Geometry::create();
  if (!geometry) return tl::unexpected(geometry.error());
  backend = std::make_unique<OpenGlBackend>(std::move(info), std::move(context), std::move(*geometry));
  if (auto made = opengl::takeErrors("making the picture"); !made) return tl::unexpected(made.error());
  return backend;
}

std::vector<DeviceInfo> listOpenGlDevices(const Mask& mask) {
  std::vector<DeviceInfo> infos;
  for (auto& device : opengl::findDevices(mask)) infos.push_back(std::move(device.info));
  return infos;
}

}  // namespace vorpipe
