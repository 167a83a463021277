/// Of which revision this program is.
#pragma once

#include <string_view>

namespace vorpipe::bench {

/// git's name of the revision, "-dirty" behind it where files were changed; empty outside of a repository.
std::string_view revision();

}  // namespace vorpipe::bench
