#include "vorpipe.h"

namespace vorpipe {

std::string_view version() { return VORPIPE_VERSION; }

}  // namespace vorpipe
