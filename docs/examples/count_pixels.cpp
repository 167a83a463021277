// Draws the cells of three sites and counts the pixels of each.
#include <cstdio>
#include <vector>

#include "vorpipe.h"

int main() {
  auto session = vorpipe::Session::open({});
  if (!session) {
    std::fprintf(stderr, "%s\n", session.error().message.c_str());
    return 3;
  }
  const vorpipe::Sites sites{{0.28, 0.76, 0.56}, {0.31, 0.43, 0.73}, {}};
  vorpipe::RenderOptions options{};
  options.domain = {0, 0, 1, 1};
  options.width = 100;
  options.height = 100;
  const auto rendering = session->render(sites, options);
  if (!rendering) {
    std::fprintf(stderr, "%s\n", rendering.error().message.c_str());
    return 3;
  }
  std::vector<int> pixels(sites.size());
  for (const auto id : rendering->image.ids) ++pixels.at(id);
  for (std::size_t i = 0; i < sites.size(); ++i) std::printf("site %zu: %d pixels\n", i, pixels[i]);
}
