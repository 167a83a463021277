/// A transport as `vorpipe transport` runs it: its masses, and what is told of its steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/input.h"
#include "cli/options/mass_options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Whether attributes are wanted for masses: one is named, or what is named as a file looks like one.
bool wantsAttributes(const MassOptions& masses);

/// The attribute that has masses, so that readers name the place of one that is wrong; none where none has.
std::optional<NeededAttribute> neededFor(const MassOptions& masses);

/// Reads the masses; none where they are equal. Sites without mass are left out of the input, and noted
/// there, where that is asked for. Errors: those of readMasses and massesIn, after the option; (input) no
/// site has mass.
Result<std::vector<double>> loadMasses(const MassOptions& masses, Input& input);

/// Scales the masses of `options`, which has all else, as the options want it. Errors: those of fillDomain.
Result<void> fitMasses(const MassOptions& masses, std::size_t sites, Session& session,
                       TransportOptions& options);

/// The last step that was kept; the last one where there is none.
const TransportStep& lastKept(const std::vector<TransportStep>& trace);

/// Newton steps that were tried.
std::uint64_t newtonSteps(const std::vector<TransportStep>& trace);

/// "converged", as in reports.
std::string_view wordOf(TransportEnd end);

/// Where the worst cell of a step came to between that of the first one and the tolerance, by their powers.
double partDone(const TransportStep& step, double first_worst, double tolerance);

/// The error with what would help: masses that were read are finite and as many as sites, and only their sum
/// can be wrong.
Error withAdvice(Error error, const MassOptions& masses);

/// "worst cell off by 1e-13 of its mass after 6 Newton steps, 7 diagrams (converged)".
std::string summaryOf(const Transported& found);

/// The exit code; prints how the run ended, where it did not reach the tolerance.
ExitCode exitCodeOf(const Transported& found, bool interrupted);

/// The rows of --trace; without `with_times` what every run has alike.
std::string traceText(const std::vector<TransportStep>& trace, bool with_times);

}  // namespace vorpipe::cli
