/// Options of runs, from a program's options.
#pragma once

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "io/base/error.h"
#include "vorpipe.h"

namespace vorpipe::c {

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

}  // namespace vorpipe::c
