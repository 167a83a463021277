/// Attributes of the input as fields of a GeoPackage.
#pragma once

#include <cstddef>

#include "io/base/attribute.h"
#include "io/base/geopackage.h"

namespace vorpipe {

FieldType fieldType(AttributeType type);

/// Adds a site's value to its row; NULL if it is missing.
void addValue(FeatureRow& row, const Attribute& attribute, std::size_t site);

}  // namespace vorpipe
