#include "session/device_in_use.h"
#include "base/try.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <new>

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
  VORPIPE_VAR(opened, openBackend(options));
  return DeviceInUse(options, std::move(opened));
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
  VORPIPE_VAR(opened, openBackend(options_));
  opened_.backend = std::move(opened.backend);
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

namespace {

/// Views smaller than this need so little memory that something else must shrink.
constexpr int small_view = 512;

/// Lowers the bound to half of the given amount. Returns whether that lowers it.
template <class Number>
bool halve(std::uint64_t given, Number least, Number& bound) {
  const auto half = std::max<std::uint64_t>(given / 2, static_cast<std::uint64_t>(least));
  if (half >= given || half >= static_cast<std::uint64_t>(bound)) return false;
  bound = static_cast<Number>(half);
  return true;
}

}  // namespace

BoundedBackend::BoundedBackend(Backend& backend, const Bounds& bounds, std::uint64_t* uploads)
    : ForwardingBackend(backend), bounds_(bounds), uploads_(uploads), info_(backend.info()) {
  info_.max_sites = std::min(info_.max_sites, bounds.sites);
  info_.max_bins = std::min(info_.max_bins, bounds.sites);
  info_.max_lines = std::min(info_.max_lines, bounds.lines);
  info_.max_entries = std::min(info_.max_entries, bounds.entries);
  info_.max_view = std::min(info_.max_view, bounds.view);
}

template <class Make>
Result<void> BoundedBackend::call(Call kind, const Make& make) {
  Result<void> done;
  try {
    done = make();
  } catch (const std::bad_alloc&) {
    done = tl::unexpected(Error{ErrorCode::device,
                                fmt::format("{}: the host has no memory for what the device is given at a "
                                            "time: free some, or lower --limit maxTexelBufferElements",
                                            info_.device.backend),
                                true});
  }
  if (!done && !failure_) {
    failure_ = done.error();
    failed_ = kind;
  }
  return done;
}

Result<void> BoundedBackend::upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) {
  given_.sites = sites.size();
  given_.bins = sites.grid.offsets.size();
  if (uploads_ != nullptr) ++*uploads_;
  return call(Call::upload, [&] { return ForwardingBackend::upload(sites, palette_index); });
}

Result<void> BoundedBackend::cells(std::span<const std::uint32_t> which, Capacity capacity,
                                   CellNeighbors& out) {
  given_.entries = which.size();
  return call(Call::clip, [&] { return ForwardingBackend::cells(which, capacity, out); });
}

Result<void> BoundedBackend::cells(const CellBatch<double>& batch, CellNeighbors& out) {
  given_.entries = batch.entries.size();
  given_.lines = batch.lines.size();
  return call(Call::clip, [&] { return ForwardingBackend::cells(batch, out); });
}

Result<void> BoundedBackend::begin(const View& view) {
  given_.view = std::max(view.width, view.height);
  return call(Call::picture, [&] { return ForwardingBackend::begin(view); });
}

Result<void> BoundedBackend::draw(std::span<const std::uint32_t> which, Capacity capacity,
                                  std::span<CellStatus> status) {
  given_.entries = which.size();
  return call(Call::clip, [&] { return ForwardingBackend::draw(which, capacity, status); });
}

Result<void> BoundedBackend::draw(const CellBatch<float>& batch, std::span<const DrawMark> marks,
                                  Capacity capacity, std::span<CellStatus> status) {
  given_.entries = batch.entries.size();
  given_.lines = batch.lines.size();
  return call(Call::clip, [&] { return ForwardingBackend::draw(batch, marks, capacity, status); });
}

Result<void> BoundedBackend::drawTriangles(std::span<const DrawMark> corners,
                                           std::span<const std::uint32_t> corner_of) {
  given_.lines = corners.size();
  return call(Call::clip, [&] { return ForwardingBackend::drawTriangles(corners, corner_of); });
}

Result<void> BoundedBackend::read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) {
  return call(Call::picture, [&] { return ForwardingBackend::read(rgba, ids); });
}

/// An earlier call may have caused the lack of memory.
std::optional<Bounds> BoundedBackend::smaller() const {
  if (!failure_) return std::nullopt;
  Bounds bounds = bounds_;
  bool any = false;
  const auto lower = [&any](bool lowered) { any = any || lowered; };
  const bool few_pixels = given_.view <= small_view;
  if (failed_ != Call::picture || few_pixels) {
    lower(halve(std::max(given_.sites, given_.bins), least_bounds.sites, bounds.sites));
  }
  if (failed_ == Call::clip) {
    lower(halve(given_.entries, least_bounds.entries, bounds.entries));
    lower(halve(given_.lines, least_bounds.lines, bounds.lines));
  }
  // If nothing else can shrink, a picture's view must.
  if (failed_ == Call::picture || !any) {
    lower(halve(static_cast<std::uint64_t>(given_.view), least_bounds.view, bounds.view));
  }
  return any ? std::optional(bounds) : std::nullopt;
}

}  // namespace vorpipe::core
