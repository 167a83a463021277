// Reads a diagram: its cells, what they share, and which of them holds a place.
#include <cstdio>

#include "vorpipe.h"

int main() {
  auto session = vorpipe::Session::open({});
  if (!session) {
    std::fprintf(stderr, "%s\n", session.error().message.c_str());
    return 3;
  }
  const vorpipe::Sites sites{{0.25, 0.75, 0.5}, {0.25, 0.25, 0.75}, {}};
  vorpipe::CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  const auto diagram = session->cells(sites, options);
  if (!diagram) {
    std::fprintf(stderr, "%s\n", diagram.error().message.c_str());
    return 3;
  }
  for (const vorpipe::Cell cell : *diagram) {
    std::printf("site %zu: %zu vertices, beside", cell.index(), cell.vertices().size());
    for (const auto neighbor : cell.neighbors()) {
      if (vorpipe::isWall(neighbor)) {
        std::printf(" %s", vorpipe::nameOf(static_cast<vorpipe::Wall>(neighbor)).data());
      } else {
        std::printf(" %lld", static_cast<long long>(neighbor));
      }
    }
    std::printf("\n");
  }
  const auto topology = vorpipe::topologyOf(*diagram);
  const auto locator = vorpipe::Locator::make(sites, options);
  if (!topology || !locator) return 3;
  std::printf("%zu vertices, %zu edges\n", topology->vertices.size(), topology->edge_cells.size());
  std::printf("(0.5, 0.9) is in the cell of site %u\n", locator->at({0.5, 0.9}));
}
