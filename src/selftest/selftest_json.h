/// What a self-test found, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "vorpipe/selftest.h"

namespace vorpipe {

/// Everything that was found, with each scene.
nlohmann::ordered_json selftestJson(const SelftestReport& report);

}  // namespace vorpipe
