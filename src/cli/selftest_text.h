/// The results of a self-test as text.
#pragma once

#include <string>
#include <string_view>

#include "vorpipe/selftest.h"

namespace vorpipe::cli {

/// Returns the numbered tested devices, those not tested, and the heading of the table.
std::string selftestHeading(const SelftestReport& report);

/// Returns the row of a group of scenes: a time or FAULT for each device, and below it each device's first
/// fault.
std::string selftestRow(const SelftestReport& report, std::string_view group);

/// Returns the devices' arithmetic and limits, side by side.
std::string selftestDevices(const SelftestReport& report);

/// Returns how many runs there were, and how many broke a promise.
std::string selftestSummary(const SelftestReport& report);

}  // namespace vorpipe::cli
