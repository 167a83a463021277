#include "view/painter.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "view/flow_colors.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::view {
namespace {

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

Progress Painter::progress() const {
  return [this](std::string_view /*stage*/, double /*fraction*/) { return !outdated_ || !outdated_(); };
}

Result<void> Painter::open(const Wish& wish, Answer& answer) {
  if (!wish.compared) compared_.close();
  const auto opened = main_.open(wish.backend, wish.not_cpu, [this] {
    relaxation_.reset();
    fluid_.reset();
  });
  if (!opened) return tl::unexpected(opened.error());
  if (*opened) {
    measured_.reset();
    answer.device = main_.session().device();
  }
  if (!wish.compared) return {};
  const auto other = compared_.open(*wish.compared);
  if (!other) return tl::unexpected(other.error());
  return {};
}

/// Whether the wish's sites are those of the relaxation's last step. Or of the step before, if the wish was
/// issued in the same gesture before the last step was known.
bool Painter::isAt(const Wish& wish) const {
  if (!relaxation_ || method_ != wish.method || density_ != wish.density) return false;
  return wish.sites == relaxed_ || (wish.sites == relaxed_before_ && wish.gesture == relaxed_gesture_);
}

Result<void> Painter::begin(const Wish& wish) {
  RelaxOptions options{};
  options.domain = wish.picture.domain;
  options.outline = wish.picture.outline;
  options.periodic = wish.picture.periodic;
  options.search = wish.picture.search;
  options.method = wish.method;
  if (wish.density) options.density = *wish.density;
  options.iterations = std::numeric_limits<std::uint32_t>::max();
  options.progress = progress();
  relaxation_.reset();
  auto begun = Relaxation::begin(main_.session(), *wish.sites, std::move(options));
  if (!begun) return tl::unexpected(std::move(begun.error()));
  relaxation_ = std::move(*begun);
  relaxed_ = wish.sites;
  relaxed_before_.reset();
  method_ = wish.method;
  density_ = wish.density;
  return {};
}

Result<void> Painter::step(const Wish& wish, Frame& frame) {
  if (!isAt(wish)) {
    VORPIPE_TRY(begin(wish));
  }
  // Rejected diagrams move no sites.
  const auto& trace = relaxation_->trace();
  Result<bool> more = relaxation_->step();
  while (more && *more && !trace.back().taken) more = relaxation_->step();
  if (more && !*more && relaxation_->end() == RelaxEnd::cancelled) {
    more = tl::unexpected(Error{ErrorCode::cancelled, "cancelled"});
  }
  if (!more) {
    // A new relaxation will continue from `relaxed_`.
    relaxation_.reset();
    return tl::unexpected(more.error());
  }
  frame.relaxed = !*more;
  frame.step = lastTaken(trace);
  frame.step->diagram = trace.back().diagram;
  frame.relaxed_from = frame.sites = relaxed_;
  if (!*more) return {};
  frame.sites = std::make_shared<const Sites>(relaxation_->sites());
  relaxed_before_ = std::exchange(relaxed_, frame.sites);
  relaxed_gesture_ = wish.gesture;
  return {};
}

Result<void> Painter::draw(const Wish& wish, Frame& frame, Answer& answer) {
  frame.picture = wish.picture;
  frame.flow_color = wish.flow_color;
  RenderOptions options = isColoredByFlow(frame) ? ofWhiteCells(wish.picture) : wish.picture;
  options.progress = progress();
  auto rendering = main_.render(frame.sites, options);
  if (!rendering) return tl::unexpected(std::move(rendering.error()));
  const auto keep = [&answer](const std::vector<std::string>& said) {
    answer.validation.insert(answer.validation.end(), said.begin(), said.end());
  };
  keep(rendering->report.validation_messages);
  VORPIPE_TRY(finish(frame, main_.threads(), rendering->image));
  frame.rendering = std::make_shared<const Rendering>(std::move(*rendering));
  if (!wish.compared) return {};
  auto compared = compared_.render(frame.sites, options);
  if (!compared) return tl::unexpected(std::move(compared.error()));
  keep(compared->report.validation_messages);
  VORPIPE_TRY(finish(frame, compared_.threads(), compared->image));
  frame.differing = countDifferent(frame.rendering->image, compared->image);
  frame.compared = std::make_shared<const Image>(std::move(compared->image));
  const DeviceInfo device = compared_.session().device();
  frame.compared_by = fmt::format("{} on {}", device.backend, device.name);
  return {};
}

Answer Painter::paint(const Wish& wish, const Outdated& outdated) {
  const Stopwatch watch;
  outdated_ = outdated;
  Answer answer{};
  answer.wish = wish.number;
  const auto fails = [&answer](Error& error) {
    answer.error = std::move(error);
    return answer;
  };
  if (auto opened = open(wish, answer); !opened) return fails(opened.error());
  Frame frame{wish.number, wish.sites};
  if (wish.fluid) {
    if (auto gone = fluid_.go(main_.session(), wish, progress(), frame); !gone) return fails(gone.error());
    if (const Report* const report = fluid_.report()) answer.validation = report->validation_messages;
  } else if (wish.motion != Motion::rests && wish.sites->size() > 0) {
    if (auto stepped = step(wish, frame); !stepped) return fails(stepped.error());
    answer.validation = relaxation_->report().validation_messages;
  }
  if (auto drawn = draw(wish, frame, answer); !drawn) return fails(drawn.error());
  painted_ = wish.picture;
  drawn_fluid_ = frame.fluid;
  frame.milliseconds = watch.milliseconds();
  answer.frame = std::move(frame);
  return answer;
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
