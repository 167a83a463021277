/// Runs of vorpipe, measured stage by stage.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "backend/exact_tier.h"
#include "backend/forwarding_backend.h"
#include "bench/measured.h"
#include "vorpipe.h"

namespace vorpipe::bench {

/// The parts of a run. `order` and `search` are core's own, and so is `rest`; the others are calls of a
/// backend, and `resolve` is all calls of the exact tier.
enum class Stage : std::uint8_t { order, search, upload, clip, draw, download, resolve, rest };
inline constexpr std::size_t stage_count = 8;
inline constexpr std::array<const char*, stage_count> stage_names = {"order", "search",   "upload",  "clip",
                                                                     "draw",  "download", "resolve", "rest"};

struct StageWork {
  double seconds = 0;         ///< on the host's clock
  double device_seconds = 0;  ///< on the device's own, if it has one
  std::uint64_t calls = 0;
  std::uint64_t sent = 0, received = 0;  ///< bytes handed over in calls of the interface
};

using Work = std::array<StageWork, stage_count>;

/// Forwards every call to another backend, and measures how long it takes.
class TimedBackend final : public ForwardingBackend {
 public:
  using ForwardingBackend::ForwardingBackend;

  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override;
  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override;
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override;
  Result<void> begin(const View& view) override;
  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override;
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
                    std::span<CellStatus> status) override;
  Result<void> drawTriangles(std::span<const DrawMark> corners,
                             std::span<const std::uint32_t> corner_of) override;
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override;

  /// Returns the work so far, by stage.
  [[nodiscard]] const Work& work() const { return work_; }

 private:
  template <class Call>
  Result<void> timed(Stage stage, std::uint64_t sent, const Call& call);
  StageWork& at(Stage stage) { return work_[static_cast<std::size_t>(stage)]; }

  Work work_{};
};

/// Forwards every call to the exact tier, and measures how long all of them take.
class TimedExactTier final : public ExactTier {
 public:
  explicit TimedExactTier(ExactTier& timed) : timed_(timed) {}

  void take(const SiteSet& sites) override;
  void cells(std::span<const std::uint32_t> which, Precision precision, CellNeighbors& out) override;
  void nearest(const View& view, std::span<const std::uint32_t> pixels,
               std::span<std::uint32_t> sites) override;

  [[nodiscard]] const StageWork& work() const { return work_; }

 private:
  template <class Call>
  void timed(const Call& call);

  ExactTier& timed_;
  StageWork work_;
};

/// Sites from a file, not from a generator.
struct DataSet {
  std::string name;
  Sites sites;
  Box domain;
};

/// One run: its backend, its sites and its output.
struct Job {
  std::string backend;
  std::string sites;  ///< PATTERN:N, or the name of a data set
  int side = 0;       ///< of a square picture, in pixels; 0: cells as data
  SearchOptions search{};
  int threads = 0;  ///< 0: those of the settings
  Detail detail = Detail::measures;
};

struct Settings {
  std::vector<std::string> backends;  ///< names
  BackendOptions options;             ///< for all of them, except the name
  int repetitions = 7;
  std::uint64_t max_sites = 0;
  int max_side = 0;  ///< of pictures
  std::vector<DataSet> files;
  /// Returns why a job with this number of sites should not be tried: it would not fit. Empty otherwise.
  std::function<std::string(const Job&, std::uint64_t sites)> refusal;
  std::string program;  ///< of child processes
  Progress progress;    ///< may be empty
};

/// The result of a job.
struct Outcome {
  Job job;
  std::string failed{};                                 ///< why there are no figures
  std::uint64_t sites = 0;                              ///< their number
  Samples seconds{};                                    ///< of the whole run
  Samples cpu_seconds{};                                ///< of all threads together
  std::array<Samples, stage_count> stages{}, device{};  ///< seconds; device: empty without a clock of its own
  Work last{};                                          ///< the last run's, for bytes and calls
  Report report{};                                      ///< the last run's
  double last_seconds = 0;                              ///< of any run, to warm up too

  [[nodiscard]] bool measured() const { return !seconds.empty(); }
  [[nodiscard]] const Samples& stage(Stage stage) const { return stages[static_cast<std::size_t>(stage)]; }
};

/// Returns each run's sum of some stages, in the order of the samples.
Samples sumOf(const Outcome& outcome, std::initializer_list<Stage> stages);

/// Returns a cell of a table: the samples, or why there are none.
Cell figure(const Outcome& outcome, Samples samples);

class Lab {
 public:
  explicit Lab(Settings settings);
  ~Lab();
  Lab(const Lab&) = delete;
  Lab& operator=(const Lab&) = delete;

  [[nodiscard]] const Settings& settings() const { return settings_; }

  /// Records a job; the same job is measured once. The reference to the outcome stays valid.
  const Outcome& plan(const Job& job);

  /// Measures all jobs that were planned but not measured, interleaved; `what` is for the progress. Then
  /// releases their sites and sessions. Error (cancelled): progress requested it.
  Result<void> measure(const std::string& what);

  /// Records that something was tried and failed; jobs do so themselves.
  void noteFailure(const std::string& what) { failures_.push_back(what); }
  [[nodiscard]] const std::vector<std::string>& failures() const { return failures_; }

  /// Returns the threads of a run whose job does not specify their number.
  [[nodiscard]] int threads() const;

 private:
  struct Opened;
  Result<DataSet*> sitesNamed(const std::string& name);
  Result<Opened*> open(const Job& job);
  Result<void> run(Outcome& outcome, bool counts);

  Settings settings_;
  std::map<std::string, std::unique_ptr<Outcome>> outcomes_;  ///< by the properties that distinguish jobs
  std::map<std::string, std::unique_ptr<DataSet>> sites_;
  std::map<std::string, std::unique_ptr<Opened>> opened_;
  std::vector<std::string> failures_;
  Progress progress_;  ///< of what is measured now
};

}  // namespace vorpipe::bench
