#include "io/arrays/zip_entry.h"

namespace vorpipe {

ZipBody zipBody(std::string_view bytes) {
  return {bytes.size(), [bytes](std::uint64_t offset, char* to, std::size_t length) {
            return bytes.copy(to, length, offset);
          }};
}

}  // namespace vorpipe
