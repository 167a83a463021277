#include "view/viewer.h"

#include <algorithm>
#include <utility>

#include "view/keys.h"
#include "view/settings.h"
#include "vorpipe/legend.h"

namespace vorpipe::view {
namespace {

/// Distance in pixels within which the pointer grabs the line between two pictures.
constexpr double split_reach = 5;

}  // namespace

Viewer::Viewer(ViewerOptions options, int width, int height, std::function<void()> wake)
    : options_(std::move(options)),
      document_(std::move(options_.opened)),
      settings_(std::move(options_.settings)),
      density_(std::move(options_.density)),
      camera_(document_.opened().domain, width, height),
      frames_(std::move(wake), options_.load) {
  if (document_.fluid() && settings_.motion == Motion::rests) message_ = how_to_flow;
}

void Viewer::want(Changed changed) {
  if (changed == Changed::nothing) return;
  const bool continues = changed == Changed::view || changed == Changed::drag;
  wanted_ = std::max(wanted_, continues ? Wanted::same_gesture : Wanted::other);
}

void Viewer::take(const Event& event) {
  if (const auto* const key = std::get_if<Key>(&event)) {
    if (key->name == "escape" && settings_.help) {
      settings_.help = false;
    } else if (const KeyBinding* const binding = bindingOf(*key)) {
      message_.clear();
      Settings changed = settings_;
      if (const auto* const action = std::get_if<Action>(&binding->does)) return act(*action);
      std::get<void (*)(Settings&)>(binding->does)(changed);
      change(changed);
    }
    return;
  }
  if (const auto* const drop = std::get_if<Drop>(&event)) {
    for (const std::string& path : drop->paths) {
      ++files_;
      frames_.load(path);
    }
    return;
  }
  if (std::holds_alternative<Close>(event)) closes_ = true;
  const bool moves_split = settings_.compared && split_view_.take(event, pointer_.position(), camera_.width(),
                                                                  split_reach * scale_, settings_.split);
  if (moves_split && !std::holds_alternative<Move>(event)) return;
  const std::uint32_t owner = pointer_.position() ? ownerAt(*pointer_.position()) : no_site;
  changed(pointer_.take(event, document_, camera_, owner));
}

void Viewer::act(Action action) {
  switch (action) {
    case Action::undo:
    case Action::redo:
      return undoOrRedo(action);
    case Action::fit:
      camera_.fit();
      return want(Changed::view);
    case Action::step:
    case Action::run:
    case Action::pause: {
      Settings changed = settings_;
      changed.motion = action == Action::step  ? Motion::steps_once
                       : action == Action::run ? Motion::runs
                                               : Motion::rests;
      return change(changed);
    }
    case Action::save_png:
      return save(".png");
    case Action::save_svg:
      return save(".svg");
    case Action::begin_again:
      return beginAgain();
    case Action::save_sites:
      return save(".csv");
    case Action::save_fluid:
      if (document_.fluid()) return save(".npz");
      message_ = no_fluid;
      return;
    case Action::copy_command:
      return copyCommand();
    case Action::next_backend:
      return nextBackend();
    case Action::compare:
      return compare();
    case Action::close:
      closes_ = true;
  }
}

void Viewer::undoOrRedo(Action action) {
  const Box before = document_.opened().domain;
  pointer_.release();
  settings_.motion = Motion::rests;
  strokes_.clear();
  step_.reset();
  action == Action::undo ? document_.undo() : document_.redo();
  if (!isEqual(before, document_.opened().domain)) camera_.setDomain(document_.opened().domain);
  want(Changed::sites);
}

void Viewer::change(const Settings& settings) {
  const bool moves_otherwise = settings.motion != settings_.motion || settings.method != settings_.method ||
                               settings.density_path != settings_.density_path;
  // This runs every frame: sites already at rest must not end a drag or turns of the wheel.
  const bool pauses = settings.motion == Motion::rests && settings_.motion != Motion::rests;
  if (pauses) document_.settle();
  if (!settings.compared) split_view_.release();
  if (settings.density_path.empty()) density_.reset();
  if (moves_otherwise || !drawTheSame(settings, settings_)) want(Changed::sites);
  settings_ = settings;
}

/// Returns the backend after the present one among those that work here; empty if unknown.
std::string Viewer::backendAfter() const {
  std::vector<std::string> names;
  for (const DeviceInfo& device : devices_) {
    if (device.usable && std::ranges::find(names, device.backend) == names.end()) {
      names.push_back(device.backend);
    }
  }
  if (names.empty() || !device_) return {};
  const auto now = std::ranges::find(names, device_->backend);
  return now == names.end() || now + 1 == names.end() ? names.front() : *(now + 1);
}

/// Compares with the next backend that works here, or ends the comparison.
void Viewer::compare() {
  Settings changed = settings_;
  if (changed.compared) {
    changed.compared.reset();
  } else {
    const std::string name = backendAfter();
    if (name.empty()) return;
    changed.compared = comparedWith(settings_.backend, name, "");
  }
  change(changed);
}

void Viewer::nextBackend() {
  const std::string name = backendAfter();
  if (name.empty()) return;
  settings_.backend.name = name;
  settings_.backend.device.clear();
  want(Changed::sites);
}

void Viewer::resize(int width, int height) {
  minimized_ = width <= 0 || height <= 0;
  if (minimized_ || (width == camera_.width() && height == camera_.height())) return;
  camera_.resize(width, height);
  want(Changed::sites);
}

void Viewer::setCovered(double left, double right) {
  const Box before = camera_.view();
  camera_.setCovered(left, right);
  if (!isEqual(before, camera_.view())) want(Changed::view);
}

void Viewer::setScale(double scale) {
  scale_ = scale;
  pointer_.setScale(scale);
}

void Viewer::drawAgain() { want(Changed::sites); }

double Viewer::hintShows() const {
  constexpr double stays = 8, fades = 1.5;  // seconds
  if (options_.is_played) return 0;
  return std::clamp((stays + fades - open_.seconds()) / fades, 0.0, 1.0);
}

RenderOptions Viewer::picture() const {
  RenderOptions options = settings_.picture;
  const Opened& opened = document_.opened();
  options.domain = opened.domain;
  options.outline = opened.outline;
  options.periodic = opened.periodic;
  options.width = camera_.width();
  options.height = camera_.height();
  options.view = camera_.view();
  options.fit = Fit::stretch;
  options.fill = settings_.cells;
  // Without colors there is no legend, and a small window has no room for it.
  const bool has_room =
      options.width >= least_with_legend.width && options.height >= least_with_legend.height;
  options.legend = options.legend && options.fill && has_room && colorsHaveKey(options.color);
  return options;
}

void Viewer::request() {
  joinPictures();
  const bool in_flight = completed_ < requested_;
  const bool moves = (settings_.motion != Motion::rests || !strokes_.empty()) && !in_flight;
  if (minimized_ || closes_ || (wanted_ == Wanted::nothing && !moves)) return;
  if (settings_.picture.color == ColorBy::weight && document_.sites()->weight.empty()) {
    settings_.picture.color = ColorBy::site;
    settings_.picture.legend = false;
    message_ = "The sites have no weights to color by; Ctrl+Wheel over a cell changes its weight.";
  }
  if (std::exchange(wanted_, Wanted::nothing) == Wanted::other) ++gesture_;
  FrameRequest request{++requested_, gesture_, document_.sites(), picture(), settings_.backend};
  // Without a GPU `auto` resolves to cpu, which is slow if cells have weights (decision D133).
  const bool weighs = document_.fluid() || !document_.sites()->weight.empty();
  if (settings_.backend.name == "auto" && weighs) request.not_cpu = options_.shown_by;
  request.compared = settings_.compared;
  request.motion = pointer_.holdsSite() ? Motion::rests : settings_.motion;
  request.several_steps = !options_.is_played && request.motion == Motion::runs;
  request.method = settings_.method;
  request.density = density_;
  request.fluid = document_.fluid();
  request.flow_color = settings_.flow_color;
  request.strokes = strokes_;
  requested_settings_ = settings_;
  frames_.request(std::move(request));
}

bool Viewer::isSettled(std::uint64_t request) const {
  if (minimized_) return files_ == 0;
  const bool is_drawn = completed_ >= (settings_.motion == Motion::runs ? request : requested_);
  return is_drawn && wanted_ == Wanted::nothing && files_ == 0 && to_save_.empty() &&
         settings_.motion != Motion::steps_once && (strokes_.empty() || settings_.motion == Motion::runs);
}

}  // namespace vorpipe::view
