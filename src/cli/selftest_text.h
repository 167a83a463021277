/// What a self-test found, as text.
#pragma once

#include <string>
#include <string_view>

#include "vorpipe/selftest.h"

namespace vorpipe::cli {

/// Which devices are tested, by number, and which are not; the heading of the table.
std::string selftestHeading(const SelftestReport& report);

/// The row of a group of scenes, with a time or FAULT for each device, and below it the first fault of each.
std::string selftestRow(const SelftestReport& report, std::string_view group);

/// The devices' arithmetic and limits, side by side.
std::string selftestDevices(const SelftestReport& report);

/// How many runs there were and how many broke a promise.
std::string selftestSummary(const SelftestReport& report);

}  // namespace vorpipe::cli
