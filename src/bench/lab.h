/// Runs of vorpipe, measured stage by stage.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/measured.h"
#include "bench/timed_backend.h"
#include "vorpipe.h"

namespace vorpipe::bench {

/// Sites from a file, not from a generator.
struct DataSet {
  std::string name;
  Sites sites;
  Box domain;
};

/// One run: which backend, on what, to what end.
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
  BackendOptions options;             ///< for all of them, but for the name
  int repetitions = 7;
  std::uint64_t max_sites = 0;
  int max_side = 0;  ///< of pictures
  std::vector<DataSet> files;
  /// Why a job with this number of sites is not to be tried: it would not fit; empty otherwise.
  std::function<std::string(const Job&, std::uint64_t sites)> refusal;
  std::string program;  ///< of child processes
  Progress progress;    ///< may be empty
};

/// What became of a job.
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

/// The median of the runs' sums of some stages; in the order of the samples.
Samples sumOf(const Outcome& outcome, std::initializer_list<Stage> stages);

/// A cell of a table: the samples, or why there are none.
Cell figure(const Outcome& outcome, Samples samples);

class Lab {
 public:
  explicit Lab(Settings settings);
  ~Lab();
  Lab(const Lab&) = delete;
  Lab& operator=(const Lab&) = delete;

  [[nodiscard]] const Settings& settings() const { return settings_; }

  /// Notes a job down; the same job is measured once. The outcome stays where it is.
  const Outcome& plan(const Job& job);

  /// Measures all jobs that were planned and not measured, interleaved; `what` is for the progress. What
  /// they needed, sites and sessions, is let go. Error (cancelled): the progress said so.
  Result<void> measure(const std::string& what);

  /// Notes down that something was tried and failed; jobs do so by themselves.
  void noteFailure(const std::string& what) { failures_.push_back(what); }
  [[nodiscard]] const std::vector<std::string>& failures() const { return failures_; }

  /// The threads of a run whose job does not name their number.
  [[nodiscard]] int threads() const;

 private:
  struct Opened;
  Result<DataSet*> sitesNamed(const std::string& name);
  Result<Opened*> open(const Job& job);
  Result<void> run(Outcome& outcome, bool counts);

  Settings settings_;
  std::map<std::string, std::unique_ptr<Outcome>> outcomes_;  ///< by what tells jobs apart
  std::map<std::string, std::unique_ptr<DataSet>> sites_;
  std::map<std::string, std::unique_ptr<Opened>> opened_;
  std::vector<std::string> failures_;
  Progress progress_;  ///< of what is measured now
};

}  // namespace vorpipe::bench
