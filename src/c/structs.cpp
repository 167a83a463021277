#include "c/structs.h"

#include <fmt/core.h>

#include "io/base/error.h"

namespace vorpipe::c {

Result<void> checkStruct(const void* given, std::uint32_t struct_size, std::size_t known,
                         std::string_view name) {
  if (struct_size < sizeof(struct_size)) {
    return inputError(
        fmt::format("{}: struct_size is {}; begin with {{sizeof {}}}", name, struct_size, name));
  }
  if (struct_size <= known) return {};
  const auto* bytes = static_cast<const unsigned char*>(given);
  if (std::all_of(bytes + known, bytes + struct_size, [](unsigned char byte) { return byte == 0; }))
    return {};
  return inputError(fmt::format("{}: has a field that vorpipe {} does not know", name, version()));
}

}  // namespace vorpipe::c
