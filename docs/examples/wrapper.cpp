/// The largest cell of some sites, from C++17 over the installed library.
#include <algorithm>
#include <cstdio>
#include <vorpipe.hpp>

int main() {
  try {
    vorpipe::Session session;
    const vorpipe::Diagram cells = session.cells(vorpipe::Input::read("clusters:5000"));
    const auto areas = cells.area();
    const auto largest =
        static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
    std::printf("cell %zu has %g of the square, and %zu neighbors\n", largest, areas[largest],
                cells.neighbors(largest).size());
  } catch (const vorpipe::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.code();
  }
}
