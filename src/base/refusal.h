/// Errors about the input.
#pragma once

#include "vorpipe.h"

namespace vorpipe {

/// An error whose message names its subject.
Error refusal(Subject subject, std::string message);

/// The same for a message that does not: the subject's name is put before it.
Error refusalOf(Subject subject, const std::string& message);

}  // namespace vorpipe
