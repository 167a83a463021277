#include "view/renderer.h"

#include <utility>

namespace vorpipe::view {
namespace {

bool isSame(const BackendOptions& a, const BackendOptions& b) {
  return a.name == b.name && a.device == b.device && a.threads == b.threads && a.validation == b.validation &&
         a.mask.disabled == b.mask.disabled && a.mask.limits == b.mask.limits;
}

/// Returns the picture of a domain without sites, which is white.
Rendering empty(const RenderOptions& options) {
  constexpr std::uint32_t white = 0xFFFFFFFF;
  Rendering rendering{};
  Image& image = rendering.image;
  image.width = options.width;
  image.height = options.height;
  const Box& domain = options.domain;
  const Box view = options.view.value_or(domain);
  for (int row = 0; row < image.height; ++row) {
    const double y = view.ymax - (row + 0.5) / image.height * (view.ymax - view.ymin);
    for (int column = 0; column < image.width; ++column) {
      const double x = view.xmin + (column + 0.5) / image.width * (view.xmax - view.xmin);
      const bool inside = x > domain.xmin && x < domain.xmax && y > domain.ymin && y < domain.ymax;
      image.rgba.push_back(inside ? white : 0);
    }
  }
  image.ids.assign(image.rgba.size(), no_site);
  return rendering;
}

}  // namespace

Result<bool> Renderer::open(const BackendOptions& backend, const std::string& not_cpu,
                            const std::function<void()>& end) {
  const bool is_open = session_ && isSame(backend, backend_);
  const bool may_do_better = is_open && session_->device().backend == "cpu" && not_cpu != not_cpu_;
  if (is_open && (not_cpu.empty() || !may_do_better)) return false;
  auto session = Session::open(backend);
  if (session && !not_cpu.empty() && session->device().backend == "cpu") {
    BackendOptions other = backend;
    other.name = not_cpu;
    if (auto better = Session::open(other)) session = std::move(better);
  }
  if (!session) return tl::unexpected(std::move(session.error()));
  if (end) end();
  close();
  session_ = std::make_unique<Session>(std::move(*session));
  backend_ = backend;
  not_cpu_ = not_cpu;
  return true;
}

void Renderer::close() {
  // The sites go before the session that keeps them.
  kept_.reset();
  kept_of_.reset();
  session_.reset();
}

Result<Rendering> Renderer::render(const FixedSites& sites, const RenderOptions& options) {
  if (sites->size() == 0) return empty(options);
  if (!kept_ || kept_of_ != sites) {
    kept_.emplace(*session_, *sites);
    kept_of_ = sites;
  }
  return kept_->render(options);
}

}  // namespace vorpipe::view
