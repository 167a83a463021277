#include "io/base/memory_room.h"

#include <fmt/core.h>

#include "io/base/error.h"

namespace vorpipe {

Result<void> checkRoom(std::string_view name, std::string_view what, std::uint64_t bytes) {
  constexpr double gigabyte = 1e9;
  const MemoryLimit limit = systemMemoryLimit();
  if (bytes <= limit.bytes) return {};
  return inputError(fmt::format("{}: its {} need about {:.1f} GB of memory, {:.1f} GB are {}", name, what,
                                static_cast<double>(bytes) / gigabyte,
                                static_cast<double>(limit.bytes) / gigabyte, limit.what));
}

}  // namespace vorpipe
