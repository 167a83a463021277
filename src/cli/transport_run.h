/// Parts of `vorpipe transport`: its masses, and the reports of its steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/input.h"
#include "cli/options/mass_options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Whether masses need attributes: one is named, or the given file name looks like one.
bool wantsAttributes(const MassOptions& masses);

/// Returns the attribute that holds the masses, so that readers can locate a wrong one; none if there is no
/// such attribute.
std::optional<NeededAttribute> neededFor(const MassOptions& masses);

/// Reads the masses; none if they are equal. If requested, removes sites without mass from the input, and
/// records them there. Errors: those of readMasses and massesIn, after the option; (input) no site has mass.
Result<std::vector<double>> loadMasses(const MassOptions& masses, Input& input);

/// Scales the masses in `options`, which are otherwise complete, as `masses` requests. Errors: those of
/// fillDomain.
Result<void> fitMasses(const MassOptions& masses, std::size_t sites, Session& session,
                       TransportOptions& options);

/// Returns the last kept step; the last step if none was kept.
const TransportStep& lastKept(const std::vector<TransportStep>& trace);

/// Returns the number of attempted Newton steps.
std::uint64_t newtonSteps(const std::vector<TransportStep>& trace);

/// Returns the word for reports, e.g. "converged".
std::string_view wordOf(TransportEnd end);

/// Returns how far a step's worst cell has come from the first step's error to the tolerance, on a
/// logarithmic scale.
double partDone(const TransportStep& step, double first_worst, double tolerance);

/// Adds advice to an error. Masses that were read are finite and one per site, so only their sum can be
/// wrong.
Error withAdvice(Error error, const MassOptions& masses);

/// Returns e.g. "worst cell off by 1e-13 of its mass after 6 Newton steps, 7 diagrams (converged)".
std::string summaryOf(const Transported& found);

/// Returns the exit code. Prints how the run ended if it did not reach the tolerance.
ExitCode exitCodeOf(const Transported& found, bool interrupted);

/// Returns the rows of --trace; without `with_times`, only what is the same in every run.
std::string traceText(const std::vector<TransportStep>& trace, bool with_times);

}  // namespace vorpipe::cli
