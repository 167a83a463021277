/// What passes between a caller of vorpipe_c.h and the library: errors, structs, arrays, reports, options,
/// files.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/try.h"
#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "io/base/byte_sink.h"
#include "io/base/error.h"
#include "io/base/output_file.h"
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

/// Fails with VORPIPE_INPUT if one of the pointers, whose names are separated by commas, is NULL.
template <class... Pointers>
vorpipe_code needed(std::string_view names, Pointers... pointers) noexcept {
  for (const bool is_null : {(pointers == nullptr)...}) {
    if (is_null) return missing(names.substr(0, names.find(',')));
    names.remove_prefix(std::min(names.size(), names.find(',') + 2));
  }
  return VORPIPE_DONE;
}

/// Returns from a function of C with the code of an error, if one of these arguments is NULL.
#define VORPIPE_NEEDS(...) \
  if (const vorpipe_code lack = needed(#__VA_ARGS__, __VA_ARGS__); lack != VORPIPE_DONE) return lack

/// Names the value of a result; or returns the code of its error.
#define VORPIPE_TAKE(name, ...)                                                                     \
  auto VORPIPE_JOIN(result_at_, __LINE__) = __VA_ARGS__;                                            \
  if (!VORPIPE_JOIN(result_at_, __LINE__)) return fail(VORPIPE_JOIN(result_at_, __LINE__).error()); \
  auto& name = *VORPIPE_JOIN(result_at_, __LINE__)

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

/// Returns the choice that a number stands for. Error (input): there is none.
template <class Choice, std::size_t count>
Result<Choice> chosen(const std::array<Choice, count>& choices, std::int32_t number, std::string_view name) {
  if (number >= 0 && static_cast<std::size_t>(number) < count)
    return choices[static_cast<std::size_t>(number)];
  return inputError(fmt::format("{}: is {}, which stands for nothing", name, number));
}

/// Returns the options of a run over a placed input; the given options may be NULL. Errors (input): a number
/// that names nothing; an invalid struct; colors by weight without weights.
Result<CellsOptions> cellsOptions(const vorpipe_input& input, const PlacedInput& placed,
                                  const vorpipe_cells_options* given);
Result<RenderOptions> renderOptions(const PlacedInput& placed, const vorpipe_render_options* given);

/// Error (input): a number that names no search.
Result<SearchOptions> searchOf(vorpipe_search search, std::int32_t neighbors);

/// Empty if there is no function.
Progress progressOf(vorpipe_progress progress, void* user);

/// Errors (input): no such feature or limit.
Result<Mask> maskOf(std::uint32_t disabled_count, const char* const* disabled, std::uint64_t limit_count,
                    const vorpipe_limit* limits);

/// Refuses (input) a negative number of threads.
Result<int> threadsOf(std::int32_t threads);

/// Returns the options for cells of a placed input. Errors (input): those of cellsOptions.
Result<CellsOptions> movingOptions(const vorpipe_input& input, const PlacedInput& placed,
                                   vorpipe_search search, std::int32_t neighbors);

/// Returns options that find cells in this way; all others are defaults.
template <class Options>
Options optionsWith(CellsOptions cells) {
  Options options{};
  options.domain = cells.domain;
  options.outline = std::move(cells.outline);
  options.periodic = cells.periodic;
  options.density = std::move(cells.density);
  options.search = cells.search;
  return options;
}

/// Wraps the caller's function, which gets each step as a `Told` and ends a run by returning a nonzero value.
template <class Told, class Step>
auto watcherOf(std::int32_t (*watch)(void* user, const Told* step), void* user, Told (*told)(const Step&)) {
  return [watch, user, told](const Step& step) {
    if (watch == nullptr) return true;
    Told shown = told(step);
    shown.struct_size = sizeof(shown);
    return watch(user, &shown) == 0;
  };
}

/// Passes bytes to the caller's function; `name` stands for the file.
inline CallbackSink sinkOf(std::string name, vorpipe_write write, void* user) {
  return {std::move(name),
          [write, user](std::string_view bytes) { return write(user, bytes.data(), bytes.size()) == 0; }};
}

/// Moved sites with their original input.
struct MovedSites {
  const vorpipe_input& input;
  const PlacedInput& placed;
  const Sites& sites;  ///< in the plane of a projection
};

/// Writes them to the caller in this file format. Errors: those of pointsFormatOf and writePoints.
vorpipe_code writeMoved(const MovedSites& moved, const char* format, vorpipe_write write, void* user);

/// The same to a path; its extension gives the format.
vorpipe_code saveMoved(const MovedSites& moved, const char* path);

/// Makes an input of them; its domain does not change.
vorpipe_code giveMoved(const MovedSites& moved, Surface surface, vorpipe_input** input);

/// Returns a run's report; its strings stay where they are.
vorpipe_code giveReport(const Report& report, vorpipe_report* to);

}  // namespace vorpipe::c
