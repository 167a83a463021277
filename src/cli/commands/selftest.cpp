#include "vorpipe/selftest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/try.h"
#include "bench/driver_threads.h"
#include "bench/machine.h"
#include "cli/commands/command.h"
#include "cli/options/error_line.h"
#include "cli/options/options.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "io/base/field_text.h"
#include "selftest/selftest_json.h"

namespace vorpipe::cli {
namespace {

struct SelftestCommand {
  SelftestOptions options;
  TalkOptions talk;
  std::string json;
  std::vector<BackendDevice> required;
};

/// Returns the findings and the machine as JSON.
std::string jsonOf(const SelftestReport& report) {
  auto json = selftestJson(report);
  json["machine"] = bench::json(bench::thisMachine());
  return jsonText(json, 1);
}

/// Returns the first fault of a device, in one line; empty if there is none.
std::string firstFault(const SelftestDevice& device) {
  if (!device.arithmetic_fault.empty()) return device.arithmetic_fault;
  const auto failed = std::ranges::find_if_not(device.runs, &SelftestRun::passed);
  if (failed == device.runs.end()) return {};
  return fmt::format("{}, {}, seed {}: {}", failed->group, failed->scene, failed->seed, failed->fault);
}

/// The same of all devices.
std::string firstFault(const SelftestReport& report) {
  const auto failed = std::ranges::find_if_not(report.devices, &SelftestDevice::passed);
  if (failed == report.devices.end()) return {};
  return fmt::format("{} {}: {}", failed->info.backend, failed->index, firstFault(*failed));
}

bool isOf(const SelftestDevice& device, const BackendDevice& required) {
  const bool of_backend = required.backend == "vulkan" ? device.info.backend.starts_with("vulkan")
                                                       : device.info.backend == required.backend;
  return of_backend && device.isNamed(required.device);
}

/// Returns why a required backend does not serve, in one line; empty if one of its devices passed.
std::string lackOf(const SelftestReport& report, const BackendDevice& required) {
  std::string reason;
  for (const SelftestDevice& device : report.devices) {
    if (!isOf(device, required)) continue;
    if (device.info.usable && device.passed()) return {};
    if (reason.empty() || device.info.usable)
      reason = device.info.usable ? firstFault(device) : device.info.reason;
  }
  if (reason.empty()) return fmt::format("{} is not among what was tested", required.text);
  return fmt::format("{}: {}", required.text, reason);
}

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

/// Returns the numbered tested devices, those not tested, and the heading of the table.
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

/// Returns the row of a group of scenes: a time or FAULT for each device, and below it each device's first
/// fault.
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

/// Returns the devices' arithmetic and limits, side by side.
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

/// Returns how many runs there were, and how many broke a promise.
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

/// The backends that can be required: `auto` is none.
std::vector<std::string> requirable() {
  std::vector<std::string> names = backendNames();
  std::erase(names, "auto");
  return names;
}

Parsed<std::vector<BackendDevice>> parseRequired(std::string_view text) {
  auto named = parseBackendDevices(text);
  if (named && std::ranges::find(*named, "auto", &BackendDevice::backend) != named->end()) {
    return tl::unexpected(fmt::format("\"auto\" is not one of {}", fmt::join(requirable(), ", ")));
  }
  return named;
}

Result<ExitCode> runSelftest(const SelftestCommand& command) {
  setDriverThreads(command.options.threads);
  std::vector<std::string> paths;
  if (!command.json.empty()) paths.push_back(command.json);
  VORPIPE_VAR(files, createFiles(paths));
  ProgressBar bar(command.talk.quiet);
  const auto say = [&](const std::string& text) {
    bar.clear();
    printSummary(command.talk, paths, text);
    std::fflush(stdout);
  };
  SelftestOptions options = command.options;
  options.progress = bar.callback();
  options.group_done = [&](const SelftestReport& so_far, std::string_view group) {
    say(group.empty() ? selftestHeading(so_far) : selftestRow(so_far, group));
  };
  const auto report = selftest(options);
  bar.clear();
  if (!report) return tl::unexpected(report.error());
  say(selftestDevices(*report) + selftestSummary(*report));
  std::vector<Writer> writers;
  if (!command.json.empty()) {
    writers.emplace_back([&](ByteSink& to) { return to.write(jsonOf(*report)); });
  }
  VORPIPE_TRY(writeOutputs(files, writers));
  std::string fault = report->passed() ? "" : "a promise is broken: " + firstFault(*report);
  for (const BackendDevice& required : command.required) {
    const std::string lack = lackOf(*report, required);
    if (fault.empty() && !lack.empty()) fault = "--require: " + lack;
  }
  if (fault.empty()) return exit_done;
  printError(fault);
  return exit_different;
}

}  // namespace

void addSelftest(CommandLine& line) {
  auto command = std::make_shared<SelftestCommand>();
  Options options = line.addSubcommand(
      "selftest", "tests every backend and device here, judged by cpu, and measures how devices round",
      [command](const Invocation&) { return runSelftest(*command); });
  SelftestOptions& wanted = command->options;
  options.group("Device");
  addParsed(options, "--backend", wanted.backend, "NAME",
            fmt::format("what is tested: {} [all]", anyOf(backendNames())), parseBackend,
            {backendNames(), {}});
  options.addText("--device", wanted.device, "DEVICE",
                  "the device: its index or a part of its name, as `vorpipe devices` lists them [all]");
  addRepeatable(
      options, "--require", "NAME[:DEVICE],...",
      "backends, perhaps with a device, that must be among those tested; exit code 1 if one cannot be "
      "used here; repeatable",
      parseRequired,
      [required = &command->required](const std::vector<BackendDevice>& named) {
        required->insert(required->end(), named.begin(), named.end());
      },
      {requirable(), {}, true});
  options.group("Run");
  options.addFlag("--quick", wanted.quick, "fewer and smaller scenes: seconds instead of minutes");
  addParsed(options, "--seed", wanted.seed, "S", "seed of the scenes [1]",
            [](std::string_view text) { return parseWhole(text, 0, UINT64_MAX); });
  addThreads(options, wanted.threads);
  addMaskOptions(options, wanted.mask);
  options.group("Output");
  addReport(options, "--json", command->json,
            "everything that was found, with each scene: what a bug report wants");
  addTalkOptions(options, command->talk, wanted.waiting);
}

}  // namespace vorpipe::cli
