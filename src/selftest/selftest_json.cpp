#include "selftest/selftest_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace vorpipe {
namespace {

using Json = nlohmann::ordered_json;

Json textOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// JSON has no infinity, which stands for results that are NaN.
Json ulp(double error) { return std::isfinite(error) ? Json(error) : Json("no number"); }

Json runJson(const SelftestRun& run) {
  return {{"group", run.group}, {"scene", run.scene},     {"masked", textOrNull(run.masked)},
          {"sites", run.sites}, {"seed", run.seed},       {"time_ms", run.milliseconds},
          {"notes", run.notes}, {"passed", run.passed()}, {"fault", textOrNull(run.fault)}};
}

Json arithmeticJson(const SelftestDevice& device) {
  if (!device.arithmetic) return nullptr;
  const Arithmetic& numbers = *device.arithmetic;
  return {{"quotient_ulp", ulp(numbers.quotient)},
          {"root_ulp", ulp(numbers.root)},
          {"inverse_root_ulp", ulp(numbers.inverse_root)},
          {"product_ulp", ulp(numbers.product)},
          {"sum_ulp", ulp(numbers.sum)},
          {"sum_of_differences_ulp", ulp(numbers.offset)},
          {"fuses", numbers.fuses},
          {"fuses_precise", numbers.fuses_precise},
          {"keeps_denormals", numbers.keeps_denormals},
          {"subpixel_bits", numbers.subpixel_bits ? Json(*numbers.subpixel_bits) : Json(nullptr)}};
}

Json deviceJson(const SelftestDevice& device) {
  const DeviceInfo& info = device.info;
  Json features = Json::object(), limits = Json::object(), runs = Json::array();
  for (const auto& [name, present] : info.features) features[name] = present;
  for (const auto& [name, value] : info.limits) limits[name] = value;
  for (const SelftestRun& run : device.runs) runs.push_back(runJson(run));
  return {{"backend", info.backend},
          {"index", device.index < 0 ? Json(nullptr) : Json(device.index)},
          {"name", info.name},
          {"driver", info.driver},
          {"type", info.type},
          {"usable", info.usable},
          {"reason", textOrNull(info.reason)},
          {"validated", device.validated},
          {"not_validated", textOrNull(device.not_validated)},
          {"features", std::move(features)},
          {"limits", std::move(limits)},
          {"arithmetic", arithmeticJson(device)},
          {"arithmetic_fault", textOrNull(device.arithmetic_fault)},
          {"passed", info.usable ? Json(device.passed()) : Json(nullptr)},
          {"runs", std::move(runs)}};
}

}  // namespace

Json selftestJson(const SelftestReport& report) {
  Json devices = Json::array();
  for (const SelftestDevice& device : report.devices) devices.push_back(deviceJson(device));
  return {{"version", std::string(version())},
          {"command", "selftest"},
          {"quick", report.quick},
          {"seed", report.seed},
          {"passed", report.passed()},
          {"time_ms", report.milliseconds},
          {"allowed",
           {{"quotient_ulp", allowed_quotient},
            {"root_ulp", allowed_root},
            {"inverse_root_ulp", allowed_inverse_root},
            {"product_ulp", allowed_rounding},
            {"sum_ulp", allowed_rounding},
            {"sum_of_differences_ulp", allowed_rounding},
            {"subpixel_bits", allowed_subpixel_bits}}},
          {"devices", std::move(devices)}};
}

}  // namespace vorpipe
