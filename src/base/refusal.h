/// Errors about the input.
#pragma once

#include "vorpipe.h"

namespace vorpipe {

/// An error (input) whose message already names its subject.
Error refusal(Subject subject, std::string message);

/// An error (input) whose message gets the subject's name as a prefix.
Error refusalOf(Subject subject, const std::string& message);

}  // namespace vorpipe
