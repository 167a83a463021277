/// Arrays and reports of a run, as vorpipe_c.h shows them: nothing is copied.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// In bytes; 0 for what is no type.
std::size_t sizeOf(vorpipe_type type);

/// An array whose elements are one or several numbers of a type.
template <class Element>
vorpipe_array array(const std::vector<Element>& elements, vorpipe_type type) {
  const void* data = elements.empty() ? nullptr : elements.data();
  return {data, elements.size(), type, static_cast<std::int32_t>(sizeof(Element) / sizeOf(type))};
}

/// Error (input): there is no such field.
tl::unexpected<Error> noField(std::int32_t field);

/// Gives the caller an array.
vorpipe_code give(const Result<vorpipe_array>& array, vorpipe_array* to);

/// Its strings are the report's.
vorpipe_report reportOf(const Report& report);

/// NULL past the end.
const char* textAt(const std::vector<std::string>& texts, std::size_t index);

}  // namespace vorpipe::c
