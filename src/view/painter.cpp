#include "view/painter.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::view {
namespace {

/// Returns the picture of a domain without sites, which is white.
Rendering emptyPicture(const RenderOptions& options) {
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

/// Returns in how many pixels two pictures of the same size differ.
std::uint64_t countDifferent(const Image& a, const Image& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    if (a.rgba[i] != b.rgba[i] || a.ids[i] != b.ids[i]) ++count;
  }
  return count;
}

bool hasFreeSurface(const FixedFluid& fluid) {
  return fluid && fluid->setup.options.surface == vorpipe::Surface::free;
}

bool isColoredByFlow(const Frame& frame) {
  return frame.fluid && frame.flow_color != FlowColor::none && frame.picture.fill;
}

/// Adds to a picture what only pictures of fluids have.
Result<void> finish(const Frame& frame, int threads, Image& image) {
  if (isColoredByFlow(frame)) {
    const auto colored = colorFlow(frame.fluid->setup.state, frame.flow_color, frame.picture, image);
    if (!colored) return colored;
  }
  if (hasFreeSurface(frame.fluid)) whitenAir(*frame.sites, frame.picture, image, threads);
  return {};
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
  if (sites->size() == 0) return emptyPicture(options);
  if (!kept_ || kept_of_ != sites) {
    kept_.emplace(*session_, *sites);
    kept_of_ = sites;
  }
  return kept_->render(options);
}

Progress Painter::progress() const {
  return [this](std::string_view /*stage*/, double /*fraction*/) { return !outdated_ || !outdated_(); };
}

Result<void> Painter::open(const FrameRequest& request, RenderResult& result) {
  if (!request.compared) compared_.close();
  const auto opened = main_.open(request.backend, request.not_cpu, [this] {
    relaxation_.reset();
    fluid_.reset();
  });
  if (!opened) return tl::unexpected(opened.error());
  if (*opened) {
    measured_.reset();
    result.device = main_.session().device();
  }
  if (!request.compared) return {};
  const auto other = compared_.open(*request.compared);
  if (!other) return tl::unexpected(other.error());
  return {};
}

/// Whether the request's sites are those of the relaxation's last step. Or of the step before, if the request
/// was issued in the same gesture before the last step was known.
bool Painter::isAt(const FrameRequest& request) const {
  if (!relaxation_ || method_ != request.method || density_ != request.density) return false;
  return request.sites == relaxed_ ||
         (request.sites == relaxed_before_ && request.gesture == relaxed_gesture_);
}

Result<void> Painter::begin(const FrameRequest& request) {
  RelaxOptions options{};
  options.domain = request.picture.domain;
  options.outline = request.picture.outline;
  options.periodic = request.picture.periodic;
  options.search = request.picture.search;
  options.method = request.method;
  if (request.density) options.density = *request.density;
  options.iterations = std::numeric_limits<std::uint32_t>::max();
  options.progress = progress();
  relaxation_.reset();
  VORPIPE_VAR(begun, Relaxation::begin(main_.session(), *request.sites, std::move(options)));
  relaxation_ = std::move(begun);
  relaxed_ = request.sites;
  relaxed_before_.reset();
  method_ = request.method;
  density_ = request.density;
  return {};
}

Result<void> Painter::step(const FrameRequest& request, Frame& frame) {
  if (!isAt(request)) {
    VORPIPE_TRY(begin(request));
  }
  // Rejected diagrams move no sites.
  const auto& trace = relaxation_->trace();
  const Stopwatch watch;
  const double seconds = stepSeconds(request);
  bool moved = false;
  Result<bool> more = true;
  do {
    more = relaxation_->step();
    moved = moved || (more && *more && trace.back().taken);
  } while (more && *more && (!moved || watch.seconds() < seconds));
  if (more && !*more && relaxation_->end() == RelaxEnd::cancelled) {
    more = tl::unexpected(Error{ErrorCode::cancelled, "cancelled"});
  }
  if (!more) {
    // A new relaxation will continue from `relaxed_`.
    relaxation_.reset();
    return tl::unexpected(more.error());
  }
  // Where the end follows other steps, the next request finds it.
  frame.relaxed = !*more && !moved;
  frame.step = lastTaken(trace);
  frame.step->diagram = trace.back().diagram;
  frame.relaxed_from = frame.sites = relaxed_;
  if (!moved) return {};
  frame.sites = std::make_shared<const Sites>(relaxation_->sites());
  relaxed_before_ = std::exchange(relaxed_, frame.sites);
  relaxed_gesture_ = request.gesture;
  return {};
}

double Painter::stepSeconds(const FrameRequest& request) const {
  constexpr double most = 0.1;  // pictures keep coming
  return request.several_steps ? std::min(drawn_in_, most) : 0;
}

Result<void> Painter::draw(const FrameRequest& request, Frame& frame, RenderResult& result) {
  frame.picture = request.picture;
  frame.flow_color = request.flow_color;
  RenderOptions options = isColoredByFlow(frame) ? ofWhiteCells(request.picture) : request.picture;
  options.progress = progress();
  VORPIPE_VAR(rendering, main_.render(frame.sites, options));
  const auto keep = [&result](const std::vector<std::string>& said) {
    result.validation.insert(result.validation.end(), said.begin(), said.end());
  };
  keep(rendering.report.validation_messages);
  VORPIPE_TRY(finish(frame, main_.threads(), rendering.image));
  frame.rendering = std::make_shared<const Rendering>(std::move(rendering));
  if (!request.compared) return {};
  VORPIPE_VAR(compared, compared_.render(frame.sites, options));
  keep(compared.report.validation_messages);
  VORPIPE_TRY(finish(frame, compared_.threads(), compared.image));
  frame.differing = countDifferent(frame.rendering->image, compared.image);
  frame.compared = std::make_shared<const Image>(std::move(compared.image));
  const DeviceInfo device = compared_.session().device();
  frame.compared_by = fmt::format("{} on {}", device.backend, device.name);
  return {};
}

RenderResult Painter::paint(const FrameRequest& request, const Outdated& outdated) {
  const Stopwatch watch;
  outdated_ = outdated;
  RenderResult result{};
  result.request = request.number;
  const auto fails = [&result](Error& error) {
    result.error = std::move(error);
    return result;
  };
  if (auto opened = open(request, result); !opened) return fails(opened.error());
  Frame frame{request.number, request.sites};
  if (request.fluid) {
    if (auto gone = fluid_.go(main_.session(), request, progress(), stepSeconds(request), frame); !gone)
      return fails(gone.error());
    if (const Report* const report = fluid_.report()) result.validation = report->validation_messages;
  } else if (request.motion != Motion::rests && request.sites->size() > 0) {
    if (auto stepped = step(request, frame); !stepped) return fails(stepped.error());
    result.validation = relaxation_->report().validation_messages;
  }
  const Stopwatch draw_watch;
  if (auto drawn = draw(request, frame, result); !drawn) return fails(drawn.error());
  drawn_in_ = draw_watch.seconds();
  painted_ = request.picture;
  drawn_fluid_ = frame.fluid;
  frame.milliseconds = watch.milliseconds();
  result.frame = std::move(frame);
  return result;
}

std::shared_ptr<const Measures> Painter::measure(const Outdated& outdated) {
  KeptSites* const kept = main_.kept();
  if (kept == nullptr || measured_ == main_.keptOf()) return {};
  outdated_ = outdated;
  CellsOptions options = cellsOptions(painted_);
  options.progress = progress();
  const auto cells = kept->measures(options);
  if (!cells) {
    if (cells.error().code != ErrorCode::cancelled) measured_ = main_.keptOf();
    return {};
  }
  measured_ = main_.keptOf();
  const Diagram& diagram = **cells;
  auto measures = std::make_shared<Measures>();
  measures->sites = measured_;
  // With a free surface, the diagram's cells include the air.
  measures->area = hasFreeSurface(drawn_fluid_) ? drawn_fluid_->setup.state.volume : diagram.area;
  measures->neighbors.resize(diagram.size());
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    std::uint32_t& count = measures->neighbors[i];
    for (std::uint64_t k = diagram.cell_offsets[i]; k < diagram.cell_offsets[i + 1]; ++k) {
      if (!isWall(diagram.neighbors[k])) ++count;
    }
  }
  return measures;
}

}  // namespace vorpipe::view
