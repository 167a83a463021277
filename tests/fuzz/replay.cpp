/// The targets without libFuzzer: what was found once, and what a deterministic loop makes of the seeds.
/// Usage: fuzz_replay SEEDS SECONDS [NAME...]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "mutation.h"
#include "target.h"

namespace vorpipe::fuzz {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Files of a folder and of those within, in the same order on every machine.
std::vector<std::string> seedsIn(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<std::string> seeds;
  for (const fs::path& path : paths) seeds.push_back(textOf(path));
  return seeds;
}

/// What is being run, to find out from why the process ended.
std::string current_path;

void runOne(const Target& target, const std::string& bytes) {
  std::ofstream(current_path, std::ios::binary | std::ios::trunc) << bytes;
  target.run(bytes);
}

void replay(const Target& target, const fs::path& seeds_folder, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto seeds = seedsIn(seeds_folder / target.name);
  require(!seeds.empty(), "each target has seeds");
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  for (const std::string& seed : seeds) runOne(target, seed);
  Mutation mutation(seeds, target.longest);
  std::uint64_t runs = seeds.size();
  double longest = 0;
  while (elapsed() < seconds) {
    const double before = elapsed();
    runOne(target, mutation.next());
    longest = std::max(longest, elapsed() - before);
    ++runs;
  }
  std::printf("%-16s %3zu seeds, %7llu runs in %.1f s, the longest %.0f ms\n", target.name.data(),
              seeds.size(), static_cast<unsigned long long>(runs), elapsed(), 1000 * longest);
  std::fflush(stdout);
}

int replayAll(const fs::path& seeds, double seconds, std::vector<std::string_view> names) {
  current_path = fs::current_path() / "fuzz_input";
  if (names.empty())
    for (const Target& target : targets()) names.push_back(target.name);
  for (const std::string_view name : names) {
    const Target* const target = targetNamed(name);
    if (target == nullptr) {
      std::fprintf(stderr, "fuzz_replay: no target %.*s\n", static_cast<int>(name.size()), name.data());
      return 2;
    }
    std::fprintf(stderr, "%s, input in %s\n", target->name.data(), current_path.c_str());
    replay(*target, seeds, seconds / static_cast<double>(names.size()));
  }
  return 0;
}

}  // namespace
}  // namespace vorpipe::fuzz

int main(int count, char** arguments) {
  if (count < 3) {
    std::fputs("usage: fuzz_replay SEEDS SECONDS [NAME...]\n", stderr);
    return 2;
  }
  return vorpipe::fuzz::replayAll(arguments[1], std::atof(arguments[2]), {arguments + 3, arguments + count});
}
