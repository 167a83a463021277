#include "c/array.h"

#include <fmt/core.h>

#include "c/failure.h"
#include "io/base/error.h"

namespace vorpipe::c {

std::size_t sizeOf(vorpipe_type type) {
  switch (type) {
    case VORPIPE_UINT8:
      return 1;
    case VORPIPE_INT32:
    case VORPIPE_UINT32:
      return 4;
    case VORPIPE_INT64:
    case VORPIPE_UINT64:
    case VORPIPE_DOUBLE:
      return 8;
    default:
      return 0;
  }
}

tl::unexpected<Error> noField(std::int32_t field) {
  return inputError(fmt::format("field: no field {}", field));
}

vorpipe_code give(const Result<vorpipe_array>& array, vorpipe_array* to) {
  if (!array) return fail(array.error());
  *to = *array;
  return VORPIPE_DONE;
}

vorpipe_report reportOf(const Report& report) {
  vorpipe_report shown{};
  shown.note_count = static_cast<std::uint32_t>(report.notes.size());
  shown.backend = report.backend.c_str();
  shown.device = report.device.c_str();
  shown.driver = report.driver.c_str();
  shown.ok = report.ok;
  shown.empty = report.empty;
  shown.duplicate = report.duplicate;
  shown.hidden = report.hidden;
  shown.retried = report.retried;
  shown.in_double = report.in_double;
  shown.exact = report.exact;
  shown.pixels = report.pixels;
  shown.order_ms = report.time_ms.order;
  shown.upload_ms = report.time_ms.upload;
  shown.search_ms = report.time_ms.search;
  shown.cells_ms = report.time_ms.cells;
  shown.draw_ms = report.time_ms.draw;
  shown.download_ms = report.time_ms.download;
  shown.validation_count = report.validation_messages.size();
  return shown;
}

const char* textAt(const std::vector<std::string>& texts, std::size_t index) {
  return index < texts.size() ? texts[index].c_str() : nullptr;
}

}  // namespace vorpipe::c
