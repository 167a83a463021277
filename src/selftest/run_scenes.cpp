#include "selftest/run_scenes.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/try.h"
#include "selftest/checks.h"

namespace vorpipe::selftests {
namespace {

/// Number of runs of a scene that depends on a seed, each with another seed.
constexpr std::uint64_t rounds = 6, quick_rounds = 1, quick_often = 4;

std::string textOf(const Mask& mask) {
  std::string text;
  for (const auto& [name, value] : mask.limits) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", name, value);
  }
  return text;
}

/// A device, opened when a scene first needs it under a mask, and again after a failure.
class Opened {
 public:
  explicit Opened(OpenRuns open) : open_(std::move(open)) {}

  Result<Runs*> with(Masked masked, const Mask& mask) {
    std::unique_ptr<Runs>& runs = runs_[masked];
    if (!runs) {
      VORPIPE_VAR(opened, open_(mask));
      runs = std::move(opened);
    }
    return runs.get();
  }
  void close(Masked masked) { runs_.erase(masked); }

 private:
  OpenRuns open_;
  std::map<Masked, std::unique_ptr<Runs>> runs_;
};

/// One scene with one seed.
struct Round {
  const SceneKind& kind;
  Scale scale;
  Scene scene;
  Mask mask;

  [[nodiscard]] bool refusable() const { return kind.traits == Traits::extreme; }
};

tl::unexpected<Error> cancelled() { return tl::unexpected(Error{ErrorCode::cancelled, "cancelled"}); }

int subpixelBitsOf(const DeviceInfo& info) {
  for (const auto& [name, value] : info.limits) {
    if (name == "subPixelPrecisionBits") return static_cast<int>(value);
  }
  return allowed_subpixel_bits;
}

class Test {
 public:
  Test(std::span<const SceneKind> kinds, const std::vector<Tested>& tested, const OpenRuns& reference,
       const SelftestOptions& options, SelftestReport& report)
      : kinds_(kinds), tested_(tested), options_(options), report_(report), reference_(reference) {
    for (const Tested& device : tested) opened_.emplace_back(device.open);
  }

  Result<void> run() {
    VORPIPE_TRY(measureArithmetic());
    if (options_.group_done) options_.group_done(report_, {});
    for (std::size_t k = 0; k < kinds_.size(); k++) {
      VORPIPE_TRY(runKind(kinds_[k]));
      const bool ends_group = k + 1 == kinds_.size() || kinds_[k + 1].group != kinds_[k].group;
      if (ends_group && options_.group_done) options_.group_done(report_, kinds_[k].group);
    }
    return {};
  }

 private:
  Result<void> measureArithmetic() {
    for (std::size_t index = 0; index < tested_.size(); index++) {
      if (!continues("arithmetic")) return cancelled();
      const auto runs = opened_[index].with(Masked::nothing, {});
      auto measured = runs ? (*runs)->arithmetic() : tl::unexpected(runs.error());
      if (measured) {
        device(index).arithmetic_fault = arithmeticFault(*measured, subpixelBitsOf(device(index).info));
        device(index).arithmetic = std::move(*measured);
      } else {
        device(index).arithmetic_fault = measured.error().message;
        opened_[index].close(Masked::nothing);
      }
    }
    return {};
  }

  Result<void> runKind(const SceneKind& kind) {
    for (std::uint64_t k = 0; k < roundsOf(kind); k++) {
      const Scale scale{options_.quick, options_.seed + k};
      VORPIPE_TRY(runRound({kind, scale, kind.make(scale), maskOf(kind.masked, scale)}));
    }
    return {};
  }

  Result<void> runRound(const Round& round) {
    VORPIPE_LET(reference, referenceOf(round));
    if (failedWith(ErrorCode::cancelled, reference)) return cancelled();
    const std::string fault = faultByCheck(reference, round.scene, round.refusable(), options_.threads);
    for (std::size_t index = 0; index < tested_.size(); index++) {
      done_++;
      const bool means_nothing = round.kind.masked != Masked::nothing && !tested_[index].masked;
      if (means_nothing) continue;
      VORPIPE_TRY(runOn(index, round, reference, fault));
    }
    return {};
  }

  Result<Outcome> referenceOf(const Round& round) {
    VORPIPE_LET(runs, reference_.with(Masked::nothing, {}));
    return compute(*runs, round.scene, stopping(fmt::format("{} by cpu", round.kind.group)));
  }

  Result<void> runOn(std::size_t index, const Round& round, const Outcome& reference,
                     const std::string& reference_fault) {
    SelftestRun run;
    run.group = round.kind.group;
    run.scene = round.kind.name;
    run.masked = textOf(round.mask);
    run.sites = round.scene.sites.size();
    run.seed = round.scale.seed;
    if (tested_[index].is_reference) {
      run.fault = reference_fault;
      run.milliseconds = reference.milliseconds;
    } else if (auto runs = opened_[index].with(round.kind.masked, round.mask); !runs) {
      run.fault = runs.error().message;
    } else {
      const auto outcome =
          compute(**runs, round.scene,
                  stopping(fmt::format("{} by {}", round.kind.group, device(index).info.backend)));
      if (failedWith(ErrorCode::cancelled, outcome)) return cancelled();
      run.milliseconds = outcome.milliseconds;
      run.notes = notesOf(outcome);
      run.fault = faultByCheck(outcome, round.scene, round.refusable(), options_.threads);
      if (run.fault.empty()) run.fault = faultByReference(outcome, reference, round.scene);
      // The device's results pass the check, but the reference has no right results to compare them with.
      if (run.fault.empty() && !reference_fault.empty())
        run.fault = "cpu cannot judge it: " + reference_fault;
      if (failedWith(ErrorCode::device, outcome)) opened_[index].close(round.kind.masked);
    }
    device(index).runs.push_back(std::move(run));
    return {};
  }

  [[nodiscard]] bool continues(std::string_view what) {
    return !options_.progress || options_.progress(what, done_ / steps());
  }

  [[nodiscard]] double steps() const {
    double all = 0;
    for (const SceneKind& kind : kinds_) all += static_cast<double>(roundsOf(kind));
    return all * static_cast<double>(tested_.size());
  }

  [[nodiscard]] std::uint64_t roundsOf(const SceneKind& kind) const {
    if (kind.traits != Traits::random && kind.traits != Traits::often) return 1;
    if (!options_.quick) return rounds;
    return kind.traits == Traits::often ? quick_often : quick_rounds;
  }

  [[nodiscard]] SelftestDevice& device(std::size_t index) { return report_.devices[tested_[index].device]; }
  /// A progress for one run that reports `what` instead of the run's stages. It stops the run if the caller's
  /// progress asks for that.
  [[nodiscard]] Progress stopping(std::string what) {
    if (!options_.progress) return {};
    return [this, what = std::move(what)](std::string_view, double) { return continues(what); };
  }

  std::span<const SceneKind> kinds_;
  const std::vector<Tested>& tested_;
  const SelftestOptions& options_;
  SelftestReport& report_;
  Opened reference_;
  std::vector<Opened> opened_;
  double done_ = 0;  ///< number of rounds on devices done
};

}  // namespace

Result<void> runScenes(std::span<const SceneKind> kinds, const std::vector<Tested>& tested,
                       const OpenRuns& reference, const SelftestOptions& options, SelftestReport& report) {
  return Test(kinds, tested, reference, options, report).run();
}

std::string arithmeticFault(const Arithmetic& measured, int subpixel_bits) {
  struct Bound {
    std::string_view what;
    double found, allowed;
  };
  for (const auto& [what, found, allowed] :
       {Bound{"a quotient", measured.quotient, allowed_quotient},
        Bound{"a root", measured.root, allowed_root},
        Bound{"an inverse root", measured.inverse_root, allowed_inverse_root},
        Bound{"a product", measured.product, allowed_rounding},
        Bound{"a sum", measured.sum, allowed_rounding},
        Bound{"a sum of differences", measured.offset, allowed_rounding}}) {
    if (found > allowed)
      return fmt::format("{} is off by {:.2f} ULP, where {} are allowed", what, found, allowed);
  }
  // The measurement cannot distinguish more than most_subpixel_bits.
  if (measured.subpixel_bits && *measured.subpixel_bits < std::min(subpixel_bits, most_subpixel_bits)) {
    return fmt::format("vertices are snapped to {} sub-pixel bits, where {} are reported",
                       *measured.subpixel_bits, subpixel_bits);
  }
  if (measured.report.validation_messages.empty()) return {};
  return "validation: " + measured.report.validation_messages.front();
}

}  // namespace vorpipe::selftests
