#include "cli/transport_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/try.h"
#include "cli/options/error_line.h"
#include "cli/progress.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/sites/weights_file.h"
#include "vorpipe/masses.h"

namespace vorpipe::cli {

namespace {

constexpr std::string_view skip_advice = "; --skip-zero leaves such sites out";

bool isOfZero(std::string_view message) { return message.find("is no mass") != std::string_view::npos; }

ZeroMass zeroOf(const MassOptions& masses) { return masses.skip_zero ? ZeroMass::taken : ZeroMass::refused; }

/// Returns advice on what unreadable masses may have meant.
std::string adviceOn(const Error& error, const MassOptions& masses, const Input& input) {
  const auto has_name = [&](const Attribute& attribute) { return attribute.name() == masses.file; };
  if (!masses.file.empty() && std::ranges::any_of(input.attributes, has_name)) {
    return fmt::format("; @{} is the attribute of the sites", masses.file);
  }
  return isOfZero(error.message) ? std::string(skip_advice) : "";
}

/// Removes the sites whose mass is 0.
Result<void> skipZero(std::vector<double>& masses, Input& input) {
  std::vector<bool> kept;
  for (const double mass : masses) kept.push_back(mass > 0);
  const auto zeros = std::erase(masses, 0.0);
  if (zeros == 0) return {};
  if (masses.empty()) return inputError("--masses: no site has any");
  input.notes.push_back(
      fmt::format("--skip-zero: {} of {} sites, whose mass is 0, are left out", zeros, input.sites.size()));
  keepSites(input, input.attributes, kept);
  return {};
}

}  // namespace

bool wantsAttributes(const MassOptions& masses) {
  return !masses.attribute.empty() || (!masses.file.empty() && inputExtension(masses.file).empty());
}

std::optional<NeededAttribute> neededFor(const MassOptions& masses) {
  if (masses.attribute.empty()) return std::nullopt;
  return NeededAttribute{masses.attribute, [zero = zeroOf(masses)](std::string_view text) {
                           return checkMass(text, zero).map_error([](std::string what) {
                             return isOfZero(what) ? what.append(skip_advice) : what;
                           });
                         }};
}

Result<std::vector<double>> loadMasses(const MassOptions& masses, Input& input) {
  if (masses.areEqual()) return {};
  const ZeroMass zero = zeroOf(masses);
  auto read = masses.file.empty() ? massesIn(input.attributes, masses.attribute, zero)
                                  : readMasses(masses.file, input.sites.size(), zero);
  if (!read) {
    read.error().message += adviceOn(read.error(), masses, input);
    return named("--masses", std::move(read.error()));
  }
  if (masses.skip_zero) {
    VORPIPE_TRY(skipZero(*read, input));
  }
  return read;
}

Result<void> fitMasses(const MassOptions& masses, std::size_t sites, Session& session,
                       TransportOptions& options) {
  if (!masses.normalize && !masses.fill) return {};
  return fillDomain(session, sites, masses.fill.value_or(1), options);
}

const TransportStep& lastKept(const std::vector<TransportStep>& trace) {
  const auto kept = std::find_if(trace.rbegin(), trace.rend(), [](const auto& step) { return step.taken; });
  return kept == trace.rend() ? trace.back() : *kept;
}

std::uint64_t newtonSteps(const std::vector<TransportStep>& trace) {
  std::uint64_t most = 0;
  for (const TransportStep& step : trace) most = std::max(most, step.newton);
  return most;
}

std::string_view wordOf(TransportEnd end) {
  constexpr std::array<std::string_view, 4> words{"converged", "stagnated", "diagrams", "cancelled"};
  return words[static_cast<std::size_t>(end)];
}

double partDone(const TransportStep& step, double first_worst, double tolerance) {
  const double way = std::log(first_worst / tolerance), done = std::log(first_worst / step.worst);
  return std::isfinite(done) && way > 0 ? std::clamp(done / way, 0.0, 1.0) : 0;
}

Error withAdvice(Error error, const MassOptions& masses) {
  if (error.subject == Subject::masses && !masses.areEqual()) {
    error.message +=
        masses.around() == Surface::free ? "; --fill V scales them" : "; --normalize scales them";
  }
  return error;
}

std::string summaryOf(const Transported& found) {
  return fmt::format("worst cell off by {:.3g} of its mass after {} Newton steps, {} diagrams ({})",
                     lastKept(found.trace).worst, newtonSteps(found.trace), found.trace.size(),
                     wordOf(found.end));
}

ExitCode exitCodeOf(const Transported& found, bool interrupted) {
  const TransportStep& last = lastKept(found.trace);
  const std::string reached = fmt::format(
      "the files have what was reached after {} diagrams, the worst cell "
      "off by {:.3g} of its mass",
      found.trace.size(), last.worst);
  if (interrupted) {
    printError(fmt::format("interrupted: {}", reached));
    return static_cast<ExitCode>(signalExitCode());
  }
  if (found.end == TransportEnd::converged) return exit_done;
  const std::string_view why =
      found.end == TransportEnd::diagrams ? "no more are allowed by --diagrams" : "rounding allows no more";
  printError(fmt::format("not converged: {}; {}", reached, why));
  return exit_different;
}

std::string traceText(const std::vector<TransportStep>& trace, bool with_times) {
  std::string text = "diagram,newton,length,taken,norm,worst,least,linear_iterations,seconds\n";
  const auto to = std::back_inserter(text);
  // A value that is not finite was not measured: a cell was empty.
  const auto put = [&](double value) {
    if (std::isfinite(value)) fmt::format_to(to, "{}", value);
    text += ',';
  };
  for (const TransportStep& step : trace) {
    fmt::format_to(to, "{},{},{},{},", step.diagram, step.newton, step.length, step.taken ? 1 : 0);
    put(step.norm);
    put(step.worst);
    put(step.least);
    fmt::format_to(to, "{},", step.linear_iterations);
    if (with_times) fmt::format_to(to, "{:.6f}", step.seconds);
    text += '\n';
  }
  return text;
}

}  // namespace vorpipe::cli
