#include "bench/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/build.h"
#include "vorpipe.h"

namespace vorpipe::bench {
namespace {

/// Linux's list of processors names the model; elsewhere the architecture is used instead.
std::string cpuModel() {
  std::ifstream list("/proc/cpuinfo");
  for (std::string line; std::getline(list, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

double memoryGigabytes() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? 1e-9 * static_cast<double>(pages) * static_cast<double>(page) : 0;
}

double loadNow() {
  double load = -1;
  return getloadavg(&load, 1) == 1 ? load : -1;
}

}  // namespace

std::string_view revision() {
  const std::string_view revision = build::revision();
  return revision == "unknown" ? std::string_view() : revision;
}

Machine thisMachine() {
  utsname names{};
  const bool named = uname(&names) == 0;
#ifdef NDEBUG
  constexpr bool asserts = false;
#else
  constexpr bool asserts = true;
#endif
  return {cpuModel(),
          static_cast<int>(std::thread::hardware_concurrency()),
          memoryGigabytes(),
          named ? fmt::format("{} {} {}", names.sysname, names.release, names.machine) : "unknown",
          loadNow(),
          std::string(build::compiler),
          std::string(build::flags),
          std::string(build::type),
          std::string(version()),
          std::string(build::revision()),
          asserts,
          fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))};
}

std::string markdown(const Machine& machine) {
  std::string text =
      fmt::format("- vorpipe {}, revision {}, {}\n", machine.version, machine.revision, machine.time);
  text += fmt::format("- {}, {} hardware threads, {:.1f} GB; {}; load {:.2f}\n", machine.cpu,
                      machine.hardware_threads, machine.memory_gb, machine.system, machine.load);
  text += fmt::format("- {}, {}: `{}`\n", machine.compiler, machine.build_type, machine.flags);
  if (machine.asserts) text += "- **built with assertions: these times mean little**\n";
  return text;
}

nlohmann::ordered_json json(const Machine& machine) {
  return {{"cpu", machine.cpu},
          {"hardware_threads", machine.hardware_threads},
          {"memory_gb", machine.memory_gb},
          {"system", machine.system},
          {"load", machine.load},
          {"compiler", machine.compiler},
          {"flags", machine.flags},
          {"build_type", machine.build_type},
          {"version", machine.version},
          {"revision", machine.revision},
          {"asserts", machine.asserts},
          {"time", machine.time}};
}

}  // namespace vorpipe::bench
