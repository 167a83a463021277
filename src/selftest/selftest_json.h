/// The results of a self-test as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "vorpipe/selftest.h"

namespace vorpipe {

/// All results, including each scene.
nlohmann::ordered_json selftestJson(const SelftestReport& report);

}  // namespace vorpipe
