/// The targets without libFuzzer: what was found once, and what a deterministic loop makes of the seeds.
/// Usage: fuzz_replay SEEDS SECONDS [NAME...]
#include <fcntl.h>
#include <unistd.h>

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

/// What is being run, to find out from why the process ended. It stays open and is written over: a file made
/// anew for each run took more than most runs.
class CurrentInput {
 public:
  explicit CurrentInput(const fs::path& path)
      : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
    require(file_ >= 0, "the file for the input can be opened");
  }
  CurrentInput(const CurrentInput&) = delete;
  CurrentInput& operator=(const CurrentInput&) = delete;
  ~CurrentInput() { ::close(file_); }

  void keep(const std::string& bytes) {
    const bool written = ::pwrite(file_, bytes.data(), bytes.size(), 0) == std::ssize(bytes) &&
                         ::ftruncate(file_, std::ssize(bytes)) == 0;
    require(written, "the input can be kept");
  }

 private:
  int file_;
};

void runOne(const Target& target, const std::string& bytes, CurrentInput& current) {
  current.keep(bytes);
  target.run(bytes);
}

void replay(const Target& target, const fs::path& seeds_folder, double seconds, CurrentInput& current) {
  using Clock = std::chrono::steady_clock;
  const auto seeds = seedsIn(seeds_folder / target.name);
  require(!seeds.empty(), "each target has seeds");
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  for (const std::string& seed : seeds) runOne(target, seed, current);
  Mutation mutation(seeds, target.longest);
  std::uint64_t runs = seeds.size();
  double longest = 0;
  while (elapsed() < seconds) {
    const double before = elapsed();
    runOne(target, mutation.next(), current);
    longest = std::max(longest, elapsed() - before);
    ++runs;
  }
  std::printf("%-16s %3zu seeds, %7llu runs in %.1f s, the longest %.0f ms\n", target.name.data(),
              seeds.size(), static_cast<unsigned long long>(runs), elapsed(), 1000 * longest);
  std::fflush(stdout);
}

int replayAll(const fs::path& seeds, double seconds, std::vector<std::string_view> names) {
  const fs::path current_path = fs::current_path() / "fuzz_input";
  CurrentInput current(current_path);
  if (names.empty())
    for (const Target& target : targets()) names.push_back(target.name);
  for (const std::string_view name : names) {
    const Target* const target = targetNamed(name);
    if (target == nullptr) {
      std::fprintf(stderr, "fuzz_replay: no target %.*s\n", static_cast<int>(name.size()), name.data());
      return 2;
    }
    std::fprintf(stderr, "%s, input in %s\n", target->name.data(), current_path.c_str());
    replay(*target, seeds, seconds / static_cast<double>(names.size()), current);
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
