#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "view/cell_border.h"
#include "view/keys.h"
#include "view/settings.h"
#include "view/viewer.h"
#include "vorpipe/legend.h"

namespace vorpipe::view {
namespace {

/// Number of frames whose times the panel draws.
constexpr std::size_t history_length = 120;

}  // namespace

void Viewer::accept(Frame& frame) {
  if (frame.fluid && !acceptFluid(frame)) return;
  if (frame.relaxed_from && frame.relaxed_from != frame.sites) {
    const bool fits = settings_.motion != Motion::rests && document_.relax(frame.relaxed_from, frame.sites);
    // Something else has changed the sites meanwhile, so this picture shows other sites.
    if (!fits) return;
    // What was requested meanwhile shows the sites before this step, so it is requested again.
    if (frame.request < requested_) want(Changed::view);
  }
  if (frame.step) step_ = frame.step;
  if (frame.relaxed) message_ = "No site moves any more.";
  if (frame.relaxed || (frame.step && settings_.motion == Motion::steps_once)) {
    settings_.motion = Motion::rests;
    document_.settle();
  }
  if (frame.request == requested_) drawn_settings_ = requested_settings_;
  if (!frame.rendering->report.notes.empty()) message_ = frame.rendering->report.notes.front();
  history_.push_back(static_cast<float>(frame.milliseconds));
  if (history_.size() > history_length) history_.erase(history_.begin());
  ++pictures_;
  frame_ = std::move(frame);
  preview_.reset();
  ++shown_version_;
}

/// Joins the pictures of two compared backends into one. The line between them is fixed in the window,
/// wherever the pictures lie.
void Viewer::joinPictures() {
  const Frame* const frame = seen();
  if (frame == nullptr || !frame->compared || !settings_.compared) {
    if (std::exchange(joined_, nullptr) != nullptr) ++shown_version_;
    return;
  }
  const Image& image = frame->rendering->image;
  const Placement at = camera_.placementOf(*frame->picture.view);
  const double along = (settings_.split * camera_.width() - at.left) / at.width;
  const int column = static_cast<int>(std::lround(std::clamp(along, 0.0, 1.0) * image.width));
  if (joined_ != nullptr && column == joined_column_ && shown_version_ == joined_version_) return;
  joined_ = &split_view_.join(image, *frame->compared, column);
  joined_column_ = column;
  joined_version_ = ++shown_version_;
}

void Viewer::handleError(const RenderResult& result) {
  if (!frame_ && result.request > 0) {
    fault_ = result.error;
    return;
  }
  message_ = result.error->message;
  if (result.request == 0) return;
  // The picture that remains is sharp.
  if (std::exchange(preview_, std::nullopt)) ++shown_version_;
  settings_.motion = Motion::rests;
  document_.settle();
  if (document_.fluid() && !document_.fluid()->is_begun && document_.canUndo()) {
    const std::string why = message_;
    undoOrRedo(Action::undo);
    message_ = why;
    return;
  }
  if (result.request < requested_ || drawTheSame(settings_, drawn_settings_)) return;
  // Return to the settings of the last picture that could be drawn.
  settings_.picture = drawn_settings_.picture;
  settings_.backend = drawn_settings_.backend;
  settings_.compared = drawn_settings_.compared;
  settings_.cells = drawn_settings_.cells;
  want(Changed::sites);
}

void Viewer::open(Loaded loaded, const std::string& path) {
  if (loaded.density) {
    density_ = std::move(loaded.density);
    settings_.density_path = path;
    message_ = fmt::format("Sites relax by the density of {}.", path);
    return;
  }
  replaceContents(std::move(*loaded.opened));
  message_ = "Opened " + path;
}

/// Replaces the contents by what was opened.
void Viewer::replaceContents(Opened opened) {
  pointer_.release();
  settings_.motion = Motion::rests;
  step_.reset();
  strokes_.clear();
  steps_.clear();
  if (opened.fluid) {
    settings_.flow_color = usualFlowColor(opened.fluid->setup.state, settings_.picture.color);
  }
  document_.open(std::move(opened));
  camera_.setDomain(document_.opened().domain);
  want(Changed::sites);
}

void Viewer::accept(RenderResult& result) {
  completed_ = std::max(completed_, result.request);
  if (!result.saved.empty() || !result.loaded_path.empty() || (result.error && result.request == 0)) --files_;
  std::ranges::move(result.validation, std::back_inserter(validation_));
  if (result.device) device_ = std::move(result.device);
  if (!result.devices.empty()) devices_ = std::move(result.devices);
  if (result.measures) measures_ = std::move(result.measures);
  if (result.frame) accept(*result.frame);
  if (result.preview && frame_) {
    preview_ = std::move(result.preview);
    ++shown_version_;
  }
  if (result.error) handleError(result);
  if (result.loaded) open(std::move(*result.loaded), result.loaded_path);
  if (!result.saved.empty()) {
    if (command_waits_ && result.saved == command_sites_) {
      publishCommand();
    } else {
      message_ = "Saved " + result.saved;
    }
  }
}

bool Viewer::takeResults() {
  bool any = false;
  while (auto result = frames_.next()) {
    any = true;
    accept(*result);
  }
  if (any) joinPictures();
  saveSettled();
  return any;
}

Shown Viewer::shown() const {
  const Frame* const frame = seen();
  if (frame == nullptr) return {};
  const Image* const image = joined_ != nullptr ? joined_ : &frame->rendering->image;
  return {image, shown_version_, camera_.placementOf(*frame->picture.view)};
}

std::uint32_t Viewer::ownerAt(Position position) const {
  const Frame* const frame = seen();
  if (frame == nullptr || frame->sites != document_.sites()) return no_site;
  const Image& image = frame->rendering->image;
  const Placement stands = camera_.placementOf(*frame->picture.view);
  const double column = std::floor((position.x - stands.left) / stands.width * image.width);
  const double row = std::floor((position.y - stands.top) / stands.height * image.height);
  if (!(column >= 0 && column < image.width && row >= 0 && row < image.height)) return no_site;
  return image.ids[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                   static_cast<std::size_t>(column)];
}

std::optional<Hovered> Viewer::hovered() const {
  if (!pointer_.position() || !measures_ || measures_->sites != document_.sites()) return std::nullopt;
  const std::uint32_t site = ownerAt(*pointer_.position());
  if (site == no_site) return std::nullopt;
  return Hovered{site,
                 document_.position(site),
                 document_.weight(site),
                 measures_->area[site],
                 measures_->neighbors[site],
                 borderAt(*pointer_.position())};
}

/// Returns the line around the cell at a position, in the window.
std::vector<Position> Viewer::borderAt(Position position) const {
  const Frame& frame = *seen();
  const Image& image = frame.rendering->image;
  const Placement stands = camera_.placementOf(*frame.picture.view);
  const double across = stands.width / image.width, down = stands.height / image.height;
  const auto step = [](double at) { return static_cast<int>(std::floor(at)); };
  std::vector<Position> line =
      borderAround(image, step((position.y - stands.top) / down), step((position.x - stands.left) / across));
  for (Position& at : line) at = {stands.left + across * at.x, stands.top + down * at.y};
  return line;
}

PanelInput Viewer::panelInput(const std::string& presenter, double present_milliseconds) const {
  PanelInput input{settings_, hovered()};
  if (frame_) {
    const Times& times = frame_->rendering->report.time_ms;
    const auto part = [](double time) { return std::max(time, 0.0); };
    input.times = {frame_->milliseconds,
                   part(times.order),
                   part(times.search) + part(times.cells),
                   part(times.draw),
                   part(times.download),
                   present_milliseconds,
                   history_};
  }
  input.devices = devices_;
  input.presenter = presenter;
  input.message = message_;
  if (!document_.fluid()) input.hint = what_to_do;
  input.hint_shows = hintShows();
  input.sites = document_.sites()->size();
  input.relaxed = step_;
  input.fluid = fluidShown();
  if (settings_.compared && frame_ && frame_->compared) {
    input.compared = Compared{frame_->differing, frame_->compared->rgba.size(), frame_->compared_by};
  }
  if (frame_ && frame_->picture.legend && frame_->rendering->key) {
    const RenderOptions& drawn = frame_->picture;
    const Legend legend = legendOf(*frame_->rendering->key, drawn);
    const LegendBox& box = legend.boxes.front();
    input.legend = Placement{box.left, box.top, box.width, box.height};
  }
  input.scale = scale_;
  input.can_undo = document_.canUndo();
  input.can_redo = document_.canRedo();
  input.width = camera_.width();
  input.height = camera_.height();
  if (device_) input.computed_by = fmt::format("{} on {}", device_->backend, device_->name);
  input.keys = helpLines();
  return input;
}

}  // namespace vorpipe::view
