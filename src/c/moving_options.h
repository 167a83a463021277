/// Shared options of all functions that move sites or masses.
#pragma once

#include <utility>

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

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
