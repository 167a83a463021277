#include "c/calls.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "io/base/error.h"

namespace vorpipe::c {
namespace {

/// No part is on the heap or needs a destructor: registering a thread's destructor takes memory, and without
/// memory the C library ends the program.
struct LastError {
  std::array<char, 8192> message{};  ///< zero-terminated; a longer message ends with "..."
  vorpipe_subject subject = VORPIPE_SUBJECT_NONE;
};

constinit thread_local LastError last_error;

void keep(std::string_view message) {
  constexpr std::string_view more = "...";
  std::array<char, 8192>& kept = last_error.message;
  std::size_t size = std::min(message.size(), kept.size() - 1);
  const bool is_cut = size < message.size();
  if (is_cut) {
    size -= more.size();
    const auto continues = [&](std::size_t at) {
      return (static_cast<unsigned char>(message[at]) & 0xC0u) == 0x80u;
    };
    while (size > 0 && continues(size)) --size;
  }
  std::memcpy(kept.data(), message.data(), size);
  if (is_cut) size += more.copy(kept.data() + size, more.size());
  kept[size] = 0;
}

vorpipe_subject numberOf(Subject subject) {
  switch (subject) {
    case Subject::none:
      return VORPIPE_SUBJECT_NONE;
    case Subject::sites:
      return VORPIPE_SUBJECT_SITES;
    case Subject::weights:
      return VORPIPE_SUBJECT_WEIGHTS;
    case Subject::domain:
      return VORPIPE_SUBJECT_DOMAIN;
    case Subject::outline:
      return VORPIPE_SUBJECT_OUTLINE;
    case Subject::period:
      return VORPIPE_SUBJECT_PERIOD;
    case Subject::density:
      return VORPIPE_SUBJECT_DENSITY;
    case Subject::search:
      return VORPIPE_SUBJECT_SEARCH;
    case Subject::masses:
      return VORPIPE_SUBJECT_MASSES;
  }
  return VORPIPE_SUBJECT_NONE;
}

vorpipe_code numberOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::input:
      return VORPIPE_INPUT;
    case ErrorCode::device:
      return VORPIPE_DEVICE;
    case ErrorCode::cancelled:
      return VORPIPE_CANCELLED;
  }
  return VORPIPE_DEVICE;
}

}  // namespace

vorpipe_code fail(vorpipe_code code, std::string_view message, Subject subject) noexcept {
  keep(message);
  last_error.subject = numberOf(subject);
  return code;
}

vorpipe_code outOfMemory() noexcept { return fail(VORPIPE_DEVICE, "there is not enough memory for this"); }

vorpipe_code fail(const Error& error) { return fail(numberOf(error.code), error.message, error.subject); }

vorpipe_code missing(std::string_view argument) noexcept {
  return guarded([&] { return fail(VORPIPE_INPUT, fmt::format("{}: is NULL", argument)); });
}

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

using namespace vorpipe;
using namespace vorpipe::c;

const char* vorpipe_last_error() { return vorpipe::c::last_error.message.data(); }

vorpipe_subject vorpipe_last_subject() { return vorpipe::c::last_error.subject; }
