#include "session/device_in_use.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorpipe::core {
namespace {

std::string lessText(const std::string& backend, const Bounds& bounds) {
  std::vector<std::string> most;
  const Bounds none;
  if (bounds.sites != none.sites) most.push_back(fmt::format("{} sites", bounds.sites));
  if (bounds.lines != none.lines) most.push_back(fmt::format("{} lines", bounds.lines));
  if (bounds.entries != none.entries) most.push_back(fmt::format("{} cells", bounds.entries));
  if (bounds.view != none.view) most.push_back(fmt::format("{0} x {0} pixels", bounds.view));
  return fmt::format("{} goes on with at most {} at a time", backend, fmt::join(most, ", "));
}

}  // namespace

Result<DeviceInUse> DeviceInUse::open(const BackendOptions& options) {
  auto opened = openBackend(options);
  if (!opened) return tl::unexpected(opened.error());
  return DeviceInUse(options, std::move(*opened));
}

DeviceInUse::DeviceInUse(BackendOptions options, OpenedBackend opened) : options_(std::move(options)) {
  others_ = std::move(opened.others);
  take(std::move(opened));
}

void DeviceInUse::take(OpenedBackend opened) {
  info_ = opened.backend->info().device;
  info_.beside_drivers = opened.beside_drivers;
  options_.name = info_.backend;
  choice_ = opened.choice;
  bounds_ = {};
  opened_ = std::move(opened);
  ++uploads_;
}

/// Opens a failed device again for the next run. A lost device may be back, and the memory that it held is
/// released in between.
Result<void> DeviceInUse::reopen() {
  if (opened_.backend) return {};
  auto opened = openBackend(options_);
  if (!opened) return tl::unexpected(opened.error());
  opened_.backend = std::move(opened->backend);
  ++uploads_;
  return {};
}

/// Switches to less at a time, or to the next backend, and adds a note; false if neither is left.
bool DeviceInUse::fallBack(const Error& failure, const BoundedBackend& failed,
                           std::vector<std::string>& notes) {
  const auto less = failure.out_of_memory ? failed.smaller() : std::nullopt;
  opened_.backend.reset();
  if (less && reopen()) {
    bounds_ = *less;
    // One line for all steps down.
    if (!notes.empty() && is_less_) notes.pop_back();
    is_less_ = true;
    notes.push_back(fmt::format("{}; {}", failure.message, lessText(info_.backend, bounds_)));
    return true;
  }
  is_less_ = false;
  const std::string before = info_.backend;
  while (!others_.empty()) {
    BackendOptions next = options_;
    next.name = others_.front();
    others_.erase(others_.begin());
    auto opened = openBackend(next);
    if (!opened) continue;
    opened->choice =
        fmt::format("{} took over from {}, which failed ({})", next.name, before, failure.message);
    notes.push_back(opened->choice);
    take(std::move(*opened));
    return true;
  }
  return false;
}

/// Adds the earlier tries to the message, in one line.
Error DeviceInUse::withEarlier(Error error, const std::vector<std::string>& notes) {
  if (!notes.empty()) error.message += fmt::format("; before that: {}", fmt::join(notes, "; "));
  return error;
}

}  // namespace vorpipe::core
