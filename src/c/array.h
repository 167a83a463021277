/// Arrays and reports of a run in the form of vorpipe_c.h, without copies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Size in bytes; 0 for an invalid type.
std::size_t sizeOf(vorpipe_type type);

/// Makes an array whose elements are one or several numbers of a type.
template <class Element>
vorpipe_array array(const std::vector<Element>& elements, vorpipe_type type) {
  const void* data = elements.empty() ? nullptr : elements.data();
  return {data, elements.size(), type, static_cast<std::int32_t>(sizeof(Element) / sizeOf(type))};
}

/// Returns the error (input) that there is no such field.
tl::unexpected<Error> noField(std::int32_t field);

/// Stores an array for the caller.
vorpipe_code give(const Result<vorpipe_array>& array, vorpipe_array* to);

/// Converts a report; the strings remain the report's.
vorpipe_report reportOf(const Report& report);

/// Returns NULL past the end.
const char* textAt(const std::vector<std::string>& texts, std::size_t index);

}  // namespace vorpipe::c
