/// The revision of this program.
#pragma once

#include <string_view>

namespace vorpipe::bench {

/// git's name of the revision, with "-dirty" appended if files were changed; empty outside of a repository.
std::string_view revision();

}  // namespace vorpipe::bench
