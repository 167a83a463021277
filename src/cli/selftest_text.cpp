#include "cli/selftest_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace vorpipe::cli {
namespace {

constexpr std::size_t label_width = 38, column_width = 10;

/// Returns the tested devices; tables number them by their position here, from 1.
std::vector<const SelftestDevice*> testedOf(const SelftestReport& report) {
  std::vector<const SelftestDevice*> tested;
  for (const SelftestDevice& device : report.devices) {
    if (device.info.usable) tested.push_back(&device);
  }
  return tested;
}

std::string deviceNameOf(const SelftestDevice& device) {
  if (device.index < 0) return device.info.backend;
  return fmt::format("{} {}: {}; {}", device.info.backend, device.index, device.info.name,
                     device.info.driver);
}

using TextOf = std::function<std::string(const SelftestDevice&)>;

std::string row(const SelftestReport& report, std::string_view label, const TextOf& textOf,
                std::string_view last = {}) {
  std::string line = fmt::format("{:<{}}", label, label_width);
  for (const SelftestDevice* device : testedOf(report)) {
    line += fmt::format("{:>{}}", textOf(*device), column_width);
  }
  if (!last.empty()) line += fmt::format("{:>{}}", last, column_width);
  return line + '\n';
}

/// Returns the heading, with the numbers of the devices.
std::string headingRow(const SelftestReport& report, std::string_view label, std::string_view last = {}) {
  int number = 0;
  return row(
      report, label, [&](const SelftestDevice&) { return fmt::format("[{}]", ++number); }, last);
}

std::string ulpText(double error) { return error < 1e6 ? fmt::format("{:.2f}", error) : "wrong"; }

std::string arithmeticRow(const SelftestReport& report, std::string_view label,
                          const std::function<std::string(const Arithmetic&)>& textOf,
                          std::string_view allowed = {}) {
  const auto text = [&](const SelftestDevice& device) {
    return device.arithmetic ? textOf(*device.arithmetic) : "-";
  };
  return row(report, label, text, allowed);
}

std::string limitText(const DeviceInfo& info, std::string_view name) {
  for (const auto& [limit, value] : info.limits) {
    if (limit == name) return fmt::format("{}", value);
  }
  for (const auto& [feature, present] : info.features) {
    if (feature == name) return present ? "yes" : "no";
  }
  return "-";
}

std::string arithmeticText(const SelftestReport& report) {
  std::string text = headingRow(report, "arithmetic as measured, errors in ULP", "allowed");
  struct Error {
    std::string_view what;
    double Arithmetic::*member;
    double allowed;
  };
  for (const Error& error : {Error{"  quotient", &Arithmetic::quotient, allowed_quotient},
                             Error{"  root", &Arithmetic::root, allowed_root},
                             Error{"  inverse root", &Arithmetic::inverse_root, allowed_inverse_root},
                             Error{"  product", &Arithmetic::product, allowed_rounding},
                             Error{"  sum", &Arithmetic::sum, allowed_rounding},
                             Error{"  sum of differences", &Arithmetic::offset, allowed_rounding}}) {
    text += arithmeticRow(
        report, error.what, [&](const Arithmetic& numbers) { return ulpText(numbers.*error.member); },
        fmt::format("{:.2f}", error.allowed));
  }
  text += arithmeticRow(
      report, "  a b + c, where it may be fused",
      [](const Arithmetic& numbers) { return numbers.fuses ? "fused" : "rounded"; }, "either");
  text += arithmeticRow(
      report, "  a b + c, where it must not be",
      [](const Arithmetic& numbers) { return numbers.fuses_precise ? "fused" : "rounded"; }, "either");
  text += arithmeticRow(
      report, "  numbers below 2^-126",
      [](const Arithmetic& numbers) { return numbers.keeps_denormals ? "kept" : "flushed"; }, "either");
  const auto bits = [](const Arithmetic& numbers) {
    if (!numbers.subpixel_bits) return std::string("-");
    return fmt::format("{}{}", *numbers.subpixel_bits,
                       *numbers.subpixel_bits == most_subpixel_bits ? "+" : "");
  };
  text += arithmeticRow(report, "  sub-pixel bits", bits, fmt::format("{}", allowed_subpixel_bits));
  return text;
}

std::string limitsText(const SelftestReport& report) {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const SelftestDevice* device : testedOf(report)) {
    for (const auto& [name, present] : device->info.features) add(name);
    for (const auto& [name, value] : device->info.limits) add(name);
  }
  std::string text = headingRow(report, "features and limits as reported");
  for (const std::string_view name : names) {
    text += row(report, fmt::format("  {}", name),
                [&](const SelftestDevice& device) { return limitText(device.info, name); });
  }
  return text;
}

/// The outcome of a group's scenes on one device.
struct GroupOutcome {
  std::size_t runs = 0, wrong = 0;
  double milliseconds = 0;
  const SelftestRun* first = nullptr;  ///< the first failed run
};

GroupOutcome outcomeOf(const SelftestDevice& device, std::string_view group) {
  GroupOutcome outcome;
  for (const SelftestRun& run : device.runs) {
    if (run.group != group) continue;
    outcome.runs++;
    outcome.milliseconds += run.milliseconds;
    if (run.passed()) continue;
    outcome.wrong++;
    if (outcome.first == nullptr) outcome.first = &run;
  }
  return outcome;
}

std::string faultText(const SelftestRun& run, const GroupOutcome& outcome) {
  return fmt::format("{}{}{}, seed {}: {} ({} of {} runs)", run.scene, run.masked.empty() ? "" : ", ",
                     run.masked, run.seed, run.fault, outcome.wrong, outcome.runs);
}

}  // namespace

std::string selftestHeading(const SelftestReport& report) {
  std::string text =
      fmt::format("vorpipe {} selftest{}, seed {}\n", version(), report.quick ? " --quick" : "", report.seed);
  int number = 0;
  for (const SelftestDevice& device : report.devices) {
    if (!device.info.usable) {
      text += fmt::format("  -  {}; not tested: {}\n", deviceNameOf(device), device.info.reason);
      continue;
    }
    text +=
        fmt::format(" [{}] {}{}\n", ++number, deviceNameOf(device), device.validated ? "; validated" : "");
  }
  const auto without = std::ranges::find_if(
      report.devices, [](const SelftestDevice& device) { return !device.not_validated.empty(); });
  if (without != report.devices.end())
    text += fmt::format("  -  no validation: {}\n", without->not_validated);
  return text + '\n' + headingRow(report, "scenes, seconds for picture and cells");
}

std::string selftestRow(const SelftestReport& report, std::string_view group) {
  std::size_t most = 0;
  int number = 0;
  std::vector<std::pair<std::string, std::string>> faults;  // a fault, and the devices that have it
  const auto text = [&](const SelftestDevice& device) -> std::string {
    const GroupOutcome outcome = outcomeOf(device, group);
    number++;
    most = std::max(most, outcome.runs);
    if (outcome.runs == 0) return "-";
    if (outcome.first == nullptr) return fmt::format("{:.2f}", outcome.milliseconds / 1000);
    const std::string fault = faultText(*outcome.first, outcome);
    const auto same = std::ranges::find(faults, fault, &decltype(faults)::value_type::first);
    auto& devices = same == faults.end() ? faults.emplace_back(fault, "").second : same->second;
    devices += fmt::format("[{}] ", number);
    return "FAULT";
  };
  std::string lines = row(report, "", text);
  const std::string label = fmt::format("  {} ({})", group, most);
  lines.replace(0, label.size(), label);
  for (const auto& [fault, devices] : faults) lines += fmt::format("    {}{}\n", devices, fault);
  return lines;
}

std::string selftestDevices(const SelftestReport& report) {
  std::string text = '\n' + arithmeticText(report);
  int number = 0;
  for (const SelftestDevice* device : testedOf(report)) {
    number++;
    if (!device->arithmetic_fault.empty()) {
      text += fmt::format("  [{}] FAULT: {}\n", number, device->arithmetic_fault);
    }
  }
  return text + '\n' + limitsText(report);
}

std::string selftestSummary(const SelftestReport& report) {
  std::size_t runs = 0, wrong = 0;
  for (const SelftestDevice& device : report.devices) {
    runs += device.runs.size();
    wrong += static_cast<std::size_t>(
        std::ranges::count_if(device.runs, [](const SelftestRun& run) { return !run.passed(); }));
    wrong += device.arithmetic_fault.empty() ? 0U : 1U;
  }
  const auto count = [](std::size_t number, std::string_view what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
  };
  const std::string where =
      fmt::format("{} on {}", count(runs, "run"), count(testedOf(report).size(), "device"));
  const double seconds = report.milliseconds / 1000;
  if (wrong == 0) return fmt::format("\nall {} passed, {:.1f} s\n", where, seconds);
  return fmt::format("\n{} in {}, {:.1f} s; a bug report wants what --json writes\n", count(wrong, "fault"),
                     where, seconds);
}

}  // namespace vorpipe::cli
