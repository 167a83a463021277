#include "c/moving_options.h"

#include "c/options.h"

namespace vorpipe::c {

Result<CellsOptions> movingOptions(const vorpipe_input& input, const PlacedInput& placed,
                                   vorpipe_search search, std::int32_t neighbors) {
  vorpipe_cells_options options{};
  options.struct_size = sizeof(options);
  options.search = search;
  options.search_neighbors = neighbors;
  return cellsOptions(input, placed, &options);
}

}  // namespace vorpipe::c
