#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/peers/peer.h"

namespace vorpipe::test {
namespace {

namespace fs = std::filesystem;

Error deviceError(std::string message) { return {ErrorCode::device, std::move(message)}; }

/// What goes to node and comes back.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / fmt::format("vorpipe-d3-{}", getpid())) {
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;  // a temporary folder that stays does no harm
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] fs::path file(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// Runs d3.mjs and returns what it prints.
Result<std::string> node(const std::string& node_modules, const std::string& arguments) {
  const std::string command = fmt::format("node '{}' '{}' {}", D3_SCRIPT, node_modules, arguments);
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return tl::unexpected(deviceError("cannot start node"));
  std::string printed;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) printed += static_cast<char>(c);
  if (pclose(pipe) != 0) return tl::unexpected(deviceError("node failed: " + command));
  return printed;
}

template <class T>
void read(std::ifstream& in, std::vector<T>& values) {
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

Result<void> readCells(const fs::path& path, PeerCells& cells, std::size_t count) {
  std::vector<double> areas(count);
  std::vector<Point> centroids(count);
  std::vector<std::uint32_t> offsets(count + 1);
  std::ifstream in(path, std::ios::binary);
  read(in, areas);
  read(in, centroids);
  read(in, offsets);
  std::vector<std::int32_t> neighbors(in ? offsets.back() : 0);
  read(in, neighbors);
  if (!in) return tl::unexpected(deviceError("node left no cells in " + path.string()));
  for (std::uint32_t i = 0; i < count; ++i) {
    cells.begin(i, areas[i], centroids[i]);
    for (std::uint32_t k = offsets[i]; k < offsets[i + 1]; ++k)
      cells.addNeighbor(i, neighbors[k], std::numeric_limits<double>::infinity());
  }
  return {};
}

Result<void> writeSites(const fs::path& path, const Sites& sites) {
  std::ofstream out(path, std::ios::binary);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::array<double, 2> place{sites.x[i], sites.y[i]};
    out.write(reinterpret_cast<const char*>(place.data()), sizeof place);
  }
  if (!out.flush()) return tl::unexpected(deviceError("cannot write " + path.string()));
  return {};
}

/// One job in a process of its own; `out` is where cells go, or empty.
Result<Triangulated> run(const std::string& node_modules, const BenchInput& input, const Folder& folder,
                         std::string_view job, const std::string& out) {
  const auto sites = folder.file("sites");
  if (auto written = writeSites(sites, input.sites); !written) return tl::unexpected(written.error());
  const auto printed = node(node_modules, fmt::format("{} '{}' {} {} {}", job, sites.string(),
                                                      input.domain.xmax, input.domain.ymax, out));
  if (!printed) return tl::unexpected(printed.error());
  const auto report = nlohmann::json::parse(*printed);
  return Triangulated{{report.at("seconds"), report.at("cpu_seconds")}, report.at("triangles")};
}

Result<Triangulated> triangulate(const std::string& node_modules, const BenchInput& input) {
  const Folder folder;
  return run(node_modules, input, folder, "triangulate", "");
}

Result<FullyMeasured> measure(const std::string& node_modules, const BenchInput& input) {
  const Folder folder;
  const auto path = folder.file("cells");
  const auto done = run(node_modules, input, folder, "measure", fmt::format("'{}'", path.string()));
  if (!done) return tl::unexpected(done.error());
  FullyMeasured measured{done->taken, PeerCells(input)};
  if (auto read = readCells(path, measured.cells, input.sites.size()); !read)
    return tl::unexpected(read.error());
  return measured;
}

}  // namespace

Result<Peer> d3Delaunay(const std::string& node_modules) {
  if (!fs::exists(fs::path(node_modules) / "d3-delaunay" / "package.json"))
    return tl::unexpected(deviceError("no d3-delaunay in " + node_modules));
  auto version = node(node_modules, "version");
  if (!version) return tl::unexpected(version.error());
  while (!version->empty() && version->back() == '\n') version->pop_back();
  return Peer{"d3",
              "d3-delaunay",
              *version,
              true,
              false,
              [node_modules](const BenchInput& input) { return triangulate(node_modules, input); },
              [node_modules](const BenchInput& input) { return measure(node_modules, input); }};
}

}  // namespace vorpipe::test
