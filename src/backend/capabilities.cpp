#include "backend/capabilities.h"

#include <algorithm>

namespace vorpipe {
namespace {

template <class Known>
const auto* find(const Known& known, std::string_view name) {
  const auto it = std::ranges::find_if(known, [&](const auto& entry) { return entry.name == name; });
  return it == known.end() ? nullptr : &*it;
}

template <class Known>
tl::unexpected<Error> unknownName(const Known& known, std::string_view kind, std::string_view name) {
  std::string message;
  message.append("unknown ").append(kind).append(" '").append(name).append("': known are");
  std::string_view separator = " ";
  for (const auto& entry : known) {
    message.append(separator).append(entry.name);
    separator = ", ";
  }
  return tl::unexpected(Error{ErrorCode::input, std::move(message)});
}

}  // namespace

Result<void> applyMask(Capabilities& capabilities, const Mask& mask) {
  for (const std::string& name : mask.disabled) {
    const NamedFeature* feature = find(known_features, name);
    if (feature == nullptr) return unknownName(known_features, "feature", name);
    capabilities.*feature->member = false;
  }
  for (const auto& [name, value] : mask.limits) {
    const NamedLimit* limit = find(known_limits, name);
    if (limit == nullptr) return unknownName(known_limits, "limit", name);
    capabilities.*limit->member = std::min(capabilities.*limit->member, value);
  }
  return {};
}

std::vector<std::string> featureNames() {
  std::vector<std::string> names;
  names.reserve(std::size(known_features));
  for (const NamedFeature& feature : known_features) names.emplace_back(feature.name);
  return names;
}

std::vector<std::string> limitNames() {
  std::vector<std::string> names;
  names.reserve(std::size(known_limits));
  for (const NamedLimit& limit : known_limits) names.emplace_back(limit.name);
  return names;
}

std::vector<std::pair<std::string, bool>> listFeatures(const Capabilities& capabilities) {
  std::vector<std::pair<std::string, bool>> features;
  features.reserve(known_features.size());
  for (const NamedFeature& feature : known_features) {
    features.emplace_back(feature.name, capabilities.*feature.member);
  }
  return features;
}

std::vector<std::pair<std::string, std::uint64_t>> listLimits(const Capabilities& capabilities) {
  std::vector<std::pair<std::string, std::uint64_t>> limits;
  for (const NamedLimit& limit : known_limits) {
    if (capabilities.*limit.member != 0) limits.emplace_back(limit.name, capabilities.*limit.member);
  }
  return limits;
}

}  // namespace vorpipe
