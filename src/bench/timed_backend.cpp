#include "bench/timed_backend.h"

#include "base/stopwatch.h"

namespace vorpipe::bench {
namespace {

template <class T>
std::uint64_t bytesOf(const T& array) {
  return array.size() * sizeof(array[0]);
}

template <class Real>
std::uint64_t bytesOf(const CellBatch<Real>& batch) {
  return bytesOf(batch.entries) + bytesOf(batch.lines);
}

std::uint64_t bytesOf(const SiteSet& sites) {
  return bytesOf(sites.x) + bytesOf(sites.y) + bytesOf(sites.weight) + bytesOf(sites.grid.offsets) +
         bytesOf(sites.grid.heaviest);
}

std::uint64_t bytesOf(const CellNeighbors& found) {
  return bytesOf(found.status) + bytesOf(found.offsets) + bytesOf(found.neighbor);
}

}  // namespace

template <class Call>
Result<void> TimedBackend::timed(Stage stage, std::uint64_t sent, const Call& call) {
  const double device_before = deviceSeconds();
  const Stopwatch watch;
  auto done = call();
  StageWork& work = at(stage);
  work.seconds += watch.seconds();
  work.device_seconds += deviceSeconds() - device_before;
  work.sent += sent;
  ++work.calls;
  return done;
}

Result<void> TimedBackend::upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) {
  return timed(Stage::upload, bytesOf(sites) + bytesOf(palette_index),
               [&] { return ForwardingBackend::upload(sites, palette_index); });
}

Result<void> TimedBackend::cells(std::span<const std::uint32_t> which, Effort effort, CellNeighbors& out) {
  auto done =
      timed(Stage::clip, bytesOf(which), [&] { return ForwardingBackend::cells(which, effort, out); });
  at(Stage::clip).received += bytesOf(out);
  return done;
}

Result<void> TimedBackend::cells(const CellBatch<double>& batch, CellNeighbors& out) {
  auto done = timed(Stage::clip, bytesOf(batch), [&] { return ForwardingBackend::cells(batch, out); });
  at(Stage::clip).received += bytesOf(out);
  return done;
}

Result<void> TimedBackend::begin(const View& view) {
  return timed(Stage::draw, 0, [&] { return ForwardingBackend::begin(view); });
}

Result<void> TimedBackend::draw(std::span<const std::uint32_t> which, Effort effort,
                                std::span<CellStatus> status) {
  at(Stage::draw).received += bytesOf(status);
  return timed(Stage::draw, bytesOf(which), [&] { return ForwardingBackend::draw(which, effort, status); });
}

Result<void> TimedBackend::draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Effort effort,
                                std::span<CellStatus> status) {
  at(Stage::draw).received += bytesOf(status);
  return timed(Stage::draw, bytesOf(batch) + bytesOf(marks),
               [&] { return ForwardingBackend::draw(batch, marks, effort, status); });
}

Result<void> TimedBackend::drawTriangles(std::span<const DrawMark> corners,
                                         std::span<const std::uint32_t> corner_of) {
  return timed(Stage::draw, bytesOf(corners) + bytesOf(corner_of),
               [&] { return ForwardingBackend::drawTriangles(corners, corner_of); });
}

Result<void> TimedBackend::read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) {
  at(Stage::download).received += bytesOf(rgba) + bytesOf(ids);
  return timed(Stage::download, 0, [&] { return ForwardingBackend::read(rgba, ids); });
}

template <class Call>
void TimedExactTier::timed(const Call& call) {
  const Stopwatch watch;
  call();
  work_.seconds += watch.seconds();
  ++work_.calls;
}

void TimedExactTier::take(const SiteSet& sites) {
  timed([&] { timed_.take(sites); });
}

void TimedExactTier::cells(std::span<const std::uint32_t> which, Precision precision, CellNeighbors& out) {
  timed([&] { timed_.cells(which, precision, out); });
}

void TimedExactTier::nearest(const View& view, std::span<const std::uint32_t> pixels,
                             std::span<std::uint32_t> sites) {
  timed([&] { timed_.nearest(view, pixels, sites); });
}

}  // namespace vorpipe::bench
