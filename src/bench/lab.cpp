#include "bench/lab.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>

#include "backend/registry/registry.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "bench/driver_threads.h"
#include "domain/cells_run.h"
#include "io/sites/site_source.h"
#include "picture/picture.h"

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

constexpr std::uint64_t seed = 1;

/// A run of fewer seconds is made twice, and only the second is measured: the first refills the caches after
/// the previous job.
constexpr double short_run = 0.02;

std::string keyOf(const Job& job) {
  return fmt::format("{} {} {} {} {} {} {}", job.backend, job.sites, job.side,
                     static_cast<int>(job.search.method), job.search.neighbors, job.threads,
                     static_cast<int>(job.detail));
}

/// CPU time of all threads of this process.
double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Width and height of a picture of the domain, whose longer side has `side` pixels.
std::pair<int, int> sizeOf(const Box& domain, int side) {
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  const auto shorter = [side](double part) {
    return std::max(1, static_cast<int>(std::lround(part * side)));
  };
  return width >= height ? std::pair(side, shorter(height / width))
                         : std::pair(shorter(width / height), side);
}

/// The figures of a run, whether of cells or of a picture.
struct Run {
  double seconds, cpu_seconds;
  Report report;
};

template <class Options, class Work>
Result<Run> timeRun(const Options& options, const Work& work) {
  const double cpu_before = cpuSeconds();
  const Stopwatch watch;
  VORPIPE_VAR(done, work(options));
  return Run{watch.seconds(), cpuSeconds() - cpu_before, std::move(done.report)};
}

Work workOf(const TimedBackend& backend, const TimedExactTier& exact, const Run& run) {
  Work work = backend.work();
  const auto at = [&work](Stage stage) -> StageWork& { return work[static_cast<std::size_t>(stage)]; };
  at(Stage::resolve) = exact.work();
  const Times& times = run.report.time_ms;
  at(Stage::order).seconds = 1e-3 * std::max(times.order, 0.0);
  at(Stage::search).seconds = 1e-3 * std::max(times.search, 0.0);
  double told = 0;
  for (const StageWork& stage : work) told += stage.seconds;
  at(Stage::rest).seconds = std::max(0.0, run.seconds - told);
  return work;
}

void keep(Outcome& outcome, Run run, const Work& work, bool has_clock) {
  outcome.seconds.push_back(run.seconds);
  outcome.cpu_seconds.push_back(run.cpu_seconds);
  for (std::size_t stage = 0; stage < stage_count; ++stage) {
    outcome.stages[stage].push_back(work[stage].seconds);
    if (has_clock) outcome.device[stage].push_back(work[stage].device_seconds);
  }
  outcome.last = work;
  outcome.report = std::move(run.report);
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

Result<void> TimedBackend::cells(std::span<const std::uint32_t> which, Capacity capacity,
                                 CellNeighbors& out) {
  auto done =
      timed(Stage::clip, bytesOf(which), [&] { return ForwardingBackend::cells(which, capacity, out); });
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

Result<void> TimedBackend::draw(std::span<const std::uint32_t> which, Capacity capacity,
                                std::span<CellStatus> status) {
  at(Stage::draw).received += bytesOf(status);
  return timed(Stage::draw, bytesOf(which), [&] { return ForwardingBackend::draw(which, capacity, status); });
}

Result<void> TimedBackend::draw(const CellBatch<float>& batch, std::span<const DrawMark> marks,
                                Capacity capacity, std::span<CellStatus> status) {
  at(Stage::draw).received += bytesOf(status);
  return timed(Stage::draw, bytesOf(batch) + bytesOf(marks),
               [&] { return ForwardingBackend::draw(batch, marks, capacity, status); });
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

struct Lab::Opened {
  OpenedBackend opened;
  std::unique_ptr<ExactTier> exact;
  int threads;
};

Lab::Lab(Settings settings) : settings_(std::move(settings)) {}
Lab::~Lab() = default;

Samples sumOf(const Outcome& outcome, std::initializer_list<Stage> stages) {
  Samples sums(outcome.seconds.size());
  for (const Stage stage : stages) {
    const Samples& part = outcome.stage(stage);
    std::transform(sums.begin(), sums.end(), part.begin(), sums.begin(), std::plus<>());
  }
  return sums;
}

Cell figure(const Outcome& outcome, Samples samples) {
  if (!outcome.failed.empty()) return Missing{outcome.failed};
  if (samples.empty()) return Missing{};
  return samples;
}

const Outcome& Lab::plan(const Job& job) {
  auto& outcome = outcomes_[keyOf(job)];
  if (outcome) return *outcome;
  outcome = std::make_unique<Outcome>(Outcome{job});
  const auto file = std::ranges::find(settings_.files, job.sites, &DataSet::name);
  outcome->sites = file != settings_.files.end() ? file->sites.size() : generatedCount(job.sites).value_or(0);
  if (settings_.refusal) outcome->failed = settings_.refusal(job, outcome->sites);
  return *outcome;
}

Result<void> Lab::measure(const std::string& what) {
  std::vector<Course> courses;
  std::vector<Outcome*> outcomes;
  double part = 0;
  progress_ = [&](std::string_view, double) { return !settings_.progress || settings_.progress(what, part); };
  for (auto& [key, outcome] : outcomes_) {
    if (outcome->measured() || !outcome->failed.empty()) continue;
    outcomes.push_back(outcome.get());
    courses.push_back({what, [this, outcome = outcome.get()](bool counts) -> Result<void> {
                         const bool is_short = outcome->last_seconds > 0 && outcome->last_seconds < short_run;
                         if (counts && is_short) {
                           VORPIPE_TRY(run(*outcome, false));
                         }
                         return run(*outcome, counts);
                       }});
  }
  const auto done = interleave(courses, settings_.repetitions, [&](std::string_view stage, double fraction) {
    part = fraction;
    return progress_(stage, fraction);
  });
  for (std::size_t i = 0; i < courses.size(); ++i) {
    outcomes[i]->failed = courses[i].failed;
    const Job& job = outcomes[i]->job;
    if (!courses[i].failed.empty())
      noteFailure(fmt::format("{}, {}: {}", job.backend, job.sites, courses[i].failed));
  }
  sites_.clear();
  opened_.clear();
  progress_ = nullptr;
  return done;
}

int Lab::threads() const { return threadCount(settings_.options.threads); }

Result<DataSet*> Lab::sitesNamed(const std::string& name) {
  const auto file = std::ranges::find(settings_.files, name, &DataSet::name);
  if (file != settings_.files.end()) return &*file;
  auto& known = sites_[name];
  if (!known) {
    VORPIPE_VAR(source, loadSites(name, seed));
    known = std::make_unique<DataSet>(DataSet{name, std::move(source.table.sites), {0, 0, 1, 1}});
  }
  return known.get();
}

Result<Lab::Opened*> Lab::open(const Job& job) {
  BackendOptions options = settings_.options;
  options.name = job.backend;
  if (job.threads > 0) options.threads = job.threads;
  auto& known = opened_[fmt::format("{} {}", options.name, options.threads)];
  if (!known) {
    setDriverThreads(options.threads);
    VORPIPE_VAR(opened, openBackend(options));
    known =
        std::make_unique<Opened>(Opened{std::move(opened), openExactTier(options.threads), options.threads});
  }
  return known.get();
}

Result<void> Lab::run(Outcome& outcome, bool counts) {
  const Job& job = outcome.job;
  try {
    VORPIPE_LET(set, sitesNamed(job.sites));
    VORPIPE_LET(opened, open(job));
    const DataSet& data = *set;
    outcome.sites = data.sites.size();
    TimedBackend backend(*opened->opened.backend);
    TimedExactTier exact(*opened->exact);
    const core::Machine machine{backend, exact, opened->threads};
    CellsOptions cells{};
    cells.domain = data.domain;
    cells.search = job.search;
    cells.detail = job.detail;
    cells.progress = progress_;
    RenderOptions picture{};
    picture.domain = data.domain;
    picture.search = job.search;
    picture.progress = progress_;
    std::tie(picture.width, picture.height) = sizeOf(data.domain, job.side);
    auto done =
        job.side > 0
            ? timeRun(picture,
                      [&](const auto& options) { return core::renderOn(machine, data.sites, options); })
            : timeRun(cells,
                      [&](const auto& options) { return core::cellsOn(machine, data.sites, options); });
    if (!done) return tl::unexpected(std::move(done.error()));
    if (const auto& said = done->report.validation_messages; !said.empty()) {
      return tl::unexpected(Error{ErrorCode::device, "validation: " + said.front()});
    }
    outcome.last_seconds = done->seconds;
    const Work work = workOf(backend, exact, *done);
    if (counts) keep(outcome, std::move(*done), work, backend.deviceSeconds() >= 0);
    return {};
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "out of memory"});
  }
}

}  // namespace vorpipe::bench
