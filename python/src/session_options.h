/// Which backend, with what of its device hidden.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::python {

/// Names of features that are disabled, and of limits with their lower values.
using MaskArguments = std::pair<std::vector<std::string>, std::vector<std::pair<std::string, std::uint64_t>>>;

inline BackendOptions backendOptionsOf(const std::string& backend, const std::string& device, int threads,
                                       bool validation, const MaskArguments& mask) {
  return {backend, device, threads, {mask.first, mask.second}, validation};
}

}  // namespace vorpipe::python
