#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "io/base/quoted.h"
#include "view/command.h"
#include "view/viewer.h"

namespace vorpipe::view {
namespace {

/// Returns an unused file name in the current folder: vorpipe.png, vorpipe-2.png and so on.
std::string freeName(std::string_view stem, std::string_view extension) {
  std::string name = fmt::format("{}{}", stem, extension);
  std::error_code ignored;
  for (int number = 2; std::filesystem::exists(name, ignored); ++number) {
    name = fmt::format("{}-{}{}", stem, number, extension);
  }
  return name;
}

}  // namespace

void Viewer::save(const char* extension) { to_save_.emplace_back(extension); }

/// Saves requested pictures once the shown one is sharp.
void Viewer::saveSettled() {
  const bool sharp = frame_ && frame_->sites == document_.sites() && wanted_ == Wanted::nothing &&
                     (completed_ == requested_ || settings_.motion == Motion::runs);
  if (!sharp || files_ > 0) return;
  // One at a time, so that each finds a free name.
  if (to_save_.empty()) return;
  const std::string extension = std::move(to_save_.front());
  to_save_.erase(to_save_.begin());
  ++files_;
  const char* const stem = extension == ".csv" ? "sites" : extension == ".npz" ? "fluid" : "vorpipe";
  frames_.save({freeName(stem, extension), frame_->sites, frame_->picture, frame_->rendering,
                extension == ".npz" ? document_.fluid() : frame_->fluid, frame_->flow_color});
}

/// Returns the backend for the command line, where `auto` may resolve to a different one.
BackendOptions Viewer::drawnBy() const {
  BackendOptions backend = settings_.backend;
  const bool otherwise = device_ && device_->type == "cpu" && device_->backend != "cpu";
  if (backend.name == "auto" && backend.device.empty() && otherwise) backend.name = device_->backend;
  return backend;
}

/// Copies a command line that makes the picture or continues the fluid. Sites that are not in a file, and
/// fluids, are written first.
void Viewer::copyCommand() {
  const FixedFluid& fluid = document_.fluid();
  const bool is_file = !fluid && document_.isAsOpened() && !document_.opened().arguments.empty();
  if (!is_file && document_.sites()->size() == 0) {
    message_ = "There are no sites yet.";
    return;
  }
  const bool is_written = !command_sites_.empty() && command_revision_ == document_.revision();
  if (!is_file && !is_written) {
    command_sites_ = fluid ? freeName("vorpipe-fluid", ".npz") : freeName("vorpipe-sites", ".csv");
  }
  if (fluid) {
    command_ = shellLine(commandForFluid(command_sites_, picture(), settings_.flow_color, drawnBy()));
  } else {
    CommandFiles files{command_sites_, {}};
    if (!is_file && !document_.opened().outline.empty()) {
      files.outline = freeName("vorpipe-outline", ".wkt");
      if (const auto written = writeOutline(files.outline, document_.opened().outline); !written) {
        message_ = written.error().message;
        return;
      }
    }
    command_ = shellLine(commandFor(document_, picture(), drawnBy(), files));
  }
  if (is_file || is_written) return publishCommand();
  command_revision_ = document_.revision();
  command_waits_ = true;
  ++files_;
  frames_.save({command_sites_, document_.sites(), picture(), {}, fluid});
}

void Viewer::publishCommand() {
  command_waits_ = false;
  if (options_.copy) options_.copy(command_);
  if (options_.print) options_.print(command_);
  message_ = document_.fluid() ? "Copied, and printed: the command line that draws the fluid from here on."
                               : "Copied, and printed: the command line that makes this picture.";
}

}  // namespace vorpipe::view
