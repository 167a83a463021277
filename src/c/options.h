/// Options of runs, from what a program gave.
#pragma once

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// The options of a run over the input; those given may be NULL. Errors (input): a number that names nothing,
/// a struct that is none.
Result<CellsOptions> cellsOptions(const vorpipe_input& input, const vorpipe_cells_options* given);
Result<RenderOptions> renderOptions(const vorpipe_input& input, const vorpipe_render_options* given);

/// Empty where there is none.
Progress progressOf(vorpipe_progress progress, void* user);

/// Errors (input): no such feature or limit.
Result<Mask> maskOf(std::uint32_t disabled_count, const char* const* disabled, std::uint64_t limit_count,
                    const vorpipe_limit* limits);

/// Fewer than no threads are refused (input).
Result<int> threadsOf(std::int32_t threads);

}  // namespace vorpipe::c
