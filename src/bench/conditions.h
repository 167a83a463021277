/// The conditions of a measurement: the head of a report of `vorpipe bench`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/lab.h"
#include "bench/machine.h"
#include "bench/measured.h"

namespace vorpipe::bench {

inline constexpr int usual_repetitions = 7;

/// A backend under its requested name, and the device that it runs on.
struct OpenedDevice {
  std::string name;
  DeviceInfo device;
};

struct Conditions {
  const Machine& machine;
  const std::vector<OpenedDevice>& opened;
  const std::vector<std::string>& unusable;  ///< lines that say which backends were not measured, and why
  const Settings& settings;
};

/// Returns a heading and a list.
std::string markdown(const Conditions& conditions);

/// Returns a whole report: an object and a line end.
std::string reportJson(const Conditions& conditions, std::span<const Table> tables);

}  // namespace vorpipe::bench
