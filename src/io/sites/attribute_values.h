/// Values of attributes: checked, as colors and as labels.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "vorpipe.h"

namespace vorpipe {

/// Checks that all values of an attribute read as its type, so that files can hold them. Errors (input),
/// which name the attribute and the site: one does not; its name or a text is not UTF-8.
Result<void> checkAttribute(const Attribute& attribute);

/// Returns the attribute with this name. Error (input): there is none, or several.
Result<const Attribute*> attributeNamed(std::span<const Attribute> attributes, std::string_view name);

/// Returns what colors show of an attribute: its numbers, or of other types its values as names, in the order
/// of the alphabet, numbers in them by size. Error (input): no site has a value.
Result<SiteValues> valuesOf(const Attribute& attribute);

/// Returns the values as texts of labels, empty if missing.
std::vector<std::string> textsOf(const Attribute& attribute);

}  // namespace vorpipe
