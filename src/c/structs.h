/// Structs of vorpipe_c.h that begin with their size: a program and the library may know different fields.
#pragma once

#include <algorithm>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "base/try.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Checks a struct of options: its size is set, and fields unknown to this library are zero.
Result<void> checkStruct(const void* given, std::uint32_t struct_size, std::size_t known,
                         std::string_view name);

/// Returns a copy of the caller's struct, with zeros for fields unknown to the caller; all zeros for NULL.
/// Error (input): those of checkStruct.
template <class Options>
Result<Options> taken(const Options* given, std::string_view name) {
  static_assert(std::is_trivially_copyable_v<Options>);
  Options options{};
  if (given == nullptr) return options;
  VORPIPE_TRY(checkStruct(given, given->struct_size, sizeof(Options), name));
  std::memcpy(&options, given, std::min<std::size_t>(given->struct_size, sizeof(Options)));
  return options;
}

/// Writes as much of `values` as the caller's struct has room for. Error (input): its size is not set.
template <class Struct>
Result<void> give(Struct values, Struct* to, std::string_view name) {
  static_assert(std::is_trivially_copyable_v<Struct>);
  if (auto checked =
          checkStruct(to, std::min<std::uint32_t>(to->struct_size, sizeof(Struct)), sizeof(Struct), name);
      !checked) {
    return checked;
  }
  values.struct_size = to->struct_size;
  std::memcpy(to, &values, std::min<std::size_t>(to->struct_size, sizeof(Struct)));
  return {};
}

}  // namespace vorpipe::c
