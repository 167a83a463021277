/// What passes between a caller of vorpipe_c.h and the library: errors, structs, arrays, reports.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/try.h"
#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Stores what vorpipe_last_error() and vorpipe_last_subject() return; returns the code. Allocates no memory.
vorpipe_code fail(vorpipe_code code, std::string_view message, Subject subject = Subject::none) noexcept;
vorpipe_code fail(const Error& error);

/// Fails with VORPIPE_DEVICE: there is no memory, not even for a message.
vorpipe_code outOfMemory() noexcept;

/// Runs a function that may throw. No exception leaves the library.
template <class Body>
vorpipe_code guarded(const Body& body) noexcept {
  try {
    try {
      return body();
    } catch (const std::bad_alloc&) {
      return outOfMemory();
    } catch (const std::exception& error) {
      return fail(VORPIPE_DEVICE, error.what());
    }
  } catch (...) {
    return outOfMemory();  // for the message
  }
}

/// Fails with VORPIPE_INPUT: a required pointer is NULL.
vorpipe_code missing(std::string_view argument) noexcept;

/// Returns the code of a finished action, or fails with its error.
inline vorpipe_code codeOf(const Result<void>& done) { return done ? VORPIPE_DONE : fail(done.error()); }

/// Reserves a session for a run. Refuses the run while the session has another, since it would see
/// half-written state. Such a run may come from the caller's progress function or another thread.
class SessionUse {
 public:
  explicit SessionUse(vorpipe_session& session)
      : session_(session), is_refused_(session.is_busy.exchange(true)) {}
  ~SessionUse() {
    if (!is_refused_) session_.is_busy = false;
  }
  SessionUse(const SessionUse&) = delete;
  SessionUse& operator=(const SessionUse&) = delete;

  /// Error (device): the session is busy.
  [[nodiscard]] Result<void> begun() const {
    if (!is_refused_) return {};
    return tl::unexpected(Error{
        ErrorCode::device,
        "session: is busy with another run; what its progress or another thread runs takes one of its own"});
  }

 private:
  vorpipe_session& session_;
  bool is_refused_;
};

/// Runs a function that uses the session and may throw.
template <class Body>
vorpipe_code guardedRun(vorpipe_session& session, const Body& body) noexcept {
  return guarded([&]() -> vorpipe_code {
    const SessionUse use(session);
    if (const auto begun = use.begun(); !begun) return fail(begun.error());
    return body();
  });
}

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
