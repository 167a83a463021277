#include "io/base/byte_sink.h"

#include <new>
#include <stdexcept>

#include "io/base/error.h"

namespace vorpipe {

Result<void> MemorySink::write(std::string_view bytes) {
  try {
    bytes_.append(bytes);
    return {};
  } catch (const std::bad_alloc&) {
    return deviceError(name() + ": there is not enough memory for its bytes");
  } catch (const std::length_error&) {
    return deviceError(name() + ": has more bytes than memory can hold");
  }
}

Result<void> CallbackSink::write(std::string_view bytes) {
  if (!bytes.empty() && !callback_(bytes)) {
    return deviceError(name() + ": writing stopped: the callback that takes its bytes returned false");
  }
  return {};
}

}  // namespace vorpipe
