/// The machine, the program and its revision, for the head of a report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace vorpipe::bench {

struct Machine {
  std::string cpu;  ///< model
  int hardware_threads;
  double memory_gb;    ///< of the whole machine; 0 if the system does not say
  std::string system;  ///< kernel, its release and the processor's architecture
  double load;         ///< processes that ran on average over the last minute; negative if unknown
  std::string compiler, flags, build_type;
  std::string version, revision;  ///< of vorpipe; the revision is git's, "unknown" outside of a repository
  bool asserts;                   ///< built with assertions, which cost time
  std::string time;               ///< now, UTC
};

/// Describes this machine, now.
Machine thisMachine();

/// Lines of Markdown that begin with "- ".
std::string markdown(const Machine& machine);

/// An object with the members' names.
nlohmann::ordered_json json(const Machine& machine);

/// git's name of the revision, with "-dirty" appended if files were changed; empty outside of a repository.
std::string_view revision();

}  // namespace vorpipe::bench
