// Computes the cells of three sites, two of them weighted, and checks them.
#include <cstdio>

#include "vorpipe.h"

int main() {
  auto session = vorpipe::Session::open({});
  if (!session) {
    std::fprintf(stderr, "%s\n", session.error().message.c_str());
    return 3;
  }
  const vorpipe::Sites sites{{0.25, 0.75, 0.5}, {0.25, 0.25, 0.75}, {0.25, 0, 0.125}};
  vorpipe::CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  const auto diagram = session->cells(sites, options);
  if (!diagram) {
    std::fprintf(stderr, "%s\n", diagram.error().message.c_str());
    return 3;
  }
  for (const vorpipe::Cell cell : *diagram) {
    std::printf("site %zu: area %g, neighbors", cell.index(), cell.area());
    for (const auto neighbor : cell.neighbors()) std::printf(" %lld", static_cast<long long>(neighbor));
    std::printf("\n");
  }
  const auto broken = vorpipe::check(sites, options, *diagram);
  if (!broken) return 3;
  for (const auto& promise : *broken) std::printf("%s\n", promise.c_str());
  return broken->empty() ? 0 : 1;
}
