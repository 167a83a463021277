#include "view/frames/painter.h"

#include <limits>
#include <utility>

#include "base/stopwatch.h"

namespace vorpipe::view {
namespace {

bool isSame(const BackendOptions& a, const BackendOptions& b) {
  return a.name == b.name && a.device == b.device && a.threads == b.threads && a.validation == b.validation &&
         a.mask.disabled == b.mask.disabled && a.mask.limits == b.mask.limits;
}

/// A picture of a domain without sites: it is white.
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

Progress Painter::progress() const {
  return [this](std::string_view /*stage*/, double /*fraction*/) { return !outdated_ || !outdated_(); };
}

Result<void> Painter::open(const BackendOptions& backend, Answer& answer) {
  if (session_ && isSame(backend, backend_)) return {};
  auto session = Session::open(backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  relaxation_.reset();
  kept_.reset();
  kept_of_.reset();
  measured_.reset();
  session_ = std::make_unique<Session>(std::move(*session));
  backend_ = backend;
  answer.device = session_->device();
  return {};
}

/// Whether the sites are where the relaxation has come to; or where it was before, of a wish that was made in
/// the same gesture before its last step was known.
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
  auto begun = Relaxation::begin(*session_, *wish.sites, std::move(options));
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
    if (auto begun = begin(wish); !begun) return begun;
  }
  // Diagrams that are taken back move nothing.
  const auto& trace = relaxation_->trace();
  Result<bool> more = relaxation_->step();
  while (more && *more && !trace.back().taken) more = relaxation_->step();
  if (more && !*more && relaxation_->end() == RelaxEnd::cancelled) {
    more = tl::unexpected(Error{ErrorCode::cancelled, "cancelled"});
  }
  if (!more) {
    // It goes on from `relaxed_` as a new one.
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

Result<Rendering> Painter::render(const FixedSites& sites, RenderOptions options) {
  if (sites->size() == 0) return empty(options);
  if (!kept_ || kept_of_ != sites) {
    kept_.emplace(*session_, *sites);
    kept_of_ = sites;
  }
  options.progress = progress();
  return kept_->render(options);
}

Answer Painter::paint(const Wish& wish, const Outdated& outdated) {
  const Stopwatch watch;
  outdated_ = outdated;
  Answer answer{};
  answer.wish = wish.number;
  if (auto opened = open(wish.backend, answer); !opened) {
    answer.error = std::move(opened.error());
    return answer;
  }
  Frame frame{wish.number, wish.sites};
  if (wish.motion != Motion::rests && wish.sites->size() > 0) {
    if (auto stepped = step(wish, frame); !stepped) {
      answer.error = std::move(stepped.error());
      return answer;
    }
  }
  auto rendering = render(frame.sites, wish.picture);
  if (!rendering) {
    answer.error = std::move(rendering.error());
    return answer;
  }
  answer.validation = rendering->report.validation_messages;
  if (frame.step) {
    const auto& more = relaxation_->report().validation_messages;
    answer.validation.insert(answer.validation.end(), more.begin(), more.end());
  }
  frame.picture = painted_ = wish.picture;
  frame.rendering = std::make_shared<const Rendering>(std::move(*rendering));
  frame.milliseconds = watch.milliseconds();
  answer.frame = std::move(frame);
  return answer;
}

std::shared_ptr<const Measures> Painter::measure(const Outdated& outdated) {
  if (!kept_ || measured_ == kept_of_) return {};
  outdated_ = outdated;
  CellsOptions options = cellsOptions(painted_);
  options.progress = progress();
  const auto cells = kept_->measures(options);
  if (!cells) {
    if (cells.error().code != ErrorCode::cancelled) measured_ = kept_of_;
    return {};
  }
  measured_ = kept_of_;
  const Diagram& diagram = **cells;
  auto measures = std::make_shared<Measures>();
  measures->sites = kept_of_;
  measures->area = diagram.area;
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
