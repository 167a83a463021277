#include "vorpipe/selftest.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/try.h"
#include "bench/driver_threads.h"
#include "bench/machine.h"
#include "cli/commands/command.h"
#include "cli/options/error_line.h"
#include "cli/options/options.h"
#include "cli/progress.h"
#include "cli/run_end.h"
#include "cli/selftest_text.h"
#include "io/base/field_text.h"
#include "selftest/selftest_json.h"

namespace vorpipe::cli {
namespace {

struct SelftestCommand {
  SelftestOptions options;
  TalkOptions talk;
  std::string json;
};

/// Returns the findings and the machine as JSON.
std::string jsonOf(const SelftestReport& report) {
  auto json = selftestJson(report);
  json["machine"] = bench::json(bench::thisMachine());
  return jsonText(json, 1);
}

/// Returns the first fault, in one line.
std::string firstFault(const SelftestReport& report) {
  for (const SelftestDevice& device : report.devices) {
    const std::string name = fmt::format("{} {}", device.info.backend, device.index);
    if (!device.arithmetic_fault.empty()) return fmt::format("{}: {}", name, device.arithmetic_fault);
    for (const SelftestRun& run : device.runs) {
      if (run.passed()) continue;
      return fmt::format("{}: {}, {}, seed {}: {}", name, run.group, run.scene, run.seed, run.fault);
    }
  }
  return {};
}

Result<ExitCode> runSelftest(const SelftestCommand& command) {
  setDriverThreads(command.options.threads);
  std::vector<std::string> paths;
  if (!command.json.empty()) paths.push_back(command.json);
  auto files = openOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
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
  VORPIPE_TRY(writeOutputs(*files, writers));
  if (report->passed()) return exit_done;
  printError("a promise is broken: " + firstFault(*report));
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
  options.group("Run");
  options.addFlag("--quick", wanted.quick, "fewer and smaller scenes: seconds instead of minutes");
  addParsed(options, "--seed", wanted.seed, "S", "seed of the scenes [1]",
            [](std::string_view text) { return parseWhole(text, 0, UINT64_MAX); });
  addThreads(options, wanted.threads);
  addMaskOptions(options, wanted.mask);
  options.group("Output");
  addAnyFile(options, "--json", command->json, {".json"},
             "everything that was found, with each scene: what a bug report wants");
  addTalkOptions(options, command->talk, wanted.waiting);
}

}  // namespace vorpipe::cli
