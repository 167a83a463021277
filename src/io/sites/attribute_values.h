/// Attributes that the library did not read from a file itself.
#pragma once

#include "io/base/attribute.h"
#include "vorpipe.h"

namespace vorpipe {

/// Checks that all values of an attribute read as its type, so that files can hold them. Errors (input),
/// which name the attribute and the site: one does not; its name or a text is not UTF-8.
Result<void> checkAttribute(const Attribute& attribute);

}  // namespace vorpipe
