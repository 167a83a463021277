#include "support/hard/hard_files.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace vorpipe::test {
namespace {

void writeText(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + " cannot be written");
}

std::string csvOf(const Sites& sites) {
  const bool weighted = !sites.weight.empty();
  std::string text = weighted ? "x,y,weight\n" : "x,y\n";
  for (std::size_t i = 0; i < sites.size(); ++i) {
    text += fmt::format("{},{}", sites.x[i], sites.y[i]);
    text += weighted ? fmt::format(",{}\n", sites.weight[i]) : "\n";
  }
  return text;
}

std::string wktOf(const Outline& outline) {
  std::string text = "MULTIPOLYGON (";
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    text += p > 0 ? ", (" : "(";
    for (auto r = outline.polygon_offsets[p]; r < outline.polygon_offsets[p + 1]; ++r) {
      const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
      text += r > outline.polygon_offsets[p] ? ", (" : "(";
      for (auto k = begin; k < end; ++k)
        text += fmt::format("{} {}, ", outline.points[k].x, outline.points[k].y);
      text += fmt::format("{} {})", outline.points[begin].x, outline.points[begin].y);
    }
    text += ")";
  }
  return text + ")\n";
}

}  // namespace

void writeHardInput(const HardInput& input, const std::string& stem) {
  writeText(stem + ".csv", csvOf(input.sites));
  if (!input.outline.empty()) writeText(stem + ".wkt", wktOf(input.outline));
}

std::string commandOf(const HardInput& input, const HardFault& fault, const std::string& stem) {
  const Box& box = input.domain;
  const bool compared = fault.message.find("first backend") != std::string::npos;
  std::string text = compared ? fmt::format("vorpipe compare --backends cpu,{}", fault.backend)
                              : fmt::format("vorpipe {} --check --backend {}",
                                            fault.run == "cells" ? "cells" : "render", fault.backend);
  text += fmt::format(" --sites {}.csv", stem);
  text += input.outline.empty() ? fmt::format(" --domain={},{},{},{}", box.xmin, box.ymin, box.xmax, box.ymax)
                                : fmt::format(" --domain {}.wkt", stem);
  constexpr std::array<std::string_view, 4> axes{"", " --periodic x", " --periodic y", " --periodic xy"};
  text += axes[static_cast<std::size_t>(input.periodic)];
  if (input.search.method == Search::flann) text += fmt::format(" --search flann:{}", input.search.neighbors);
  if (compared || fault.run == "picture") text += fmt::format(" --size {}x{}", input.width, input.height);
  return text;
}

}  // namespace vorpipe::test
