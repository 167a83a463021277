#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// a - b, or 0 where b is larger.
std::uint64_t less(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

/// Returns the first number of a file; none if it begins with something else, such as "max", or does not
/// exist.
std::optional<std::uint64_t> numberIn(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  if (file >> number) return number;
  return std::nullopt;
}

/// The number that follows a word in a file.
std::optional<std::uint64_t> numberAfter(const std::string& path, std::string_view wanted) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    std::uint64_t number = 0;
    if (words >> name && name == wanted && words >> number) return number;
  }
  return std::nullopt;
}

/// The files of a version of control groups.
struct Control {
  const char *folder, *limit, *used, *cached;
};
constexpr Control version_1{"sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                            "total_cache"};
constexpr Control version_2{"sys/fs/cgroup", "memory.max", "memory.current", "file"};

class Limits {
 public:
  explicit Limits(const std::string& root) : root_(root) {
    constexpr std::uint64_t kilobyte = 1024;
    own_ = kilobyte * numberAfter(root_ + "/proc/self/status", "VmRSS:").value_or(0);
    space_ = kilobyte * numberAfter(root_ + "/proc/self/status", "VmSize:").value_or(0);
  }

  MemoryLimit least() {
    takeAvailable();
    takeControlGroups();
    takeResourceLimits();
    return least_;
  }

 private:
  void take(std::uint64_t bytes, std::string what) {
    if (bytes < least_.bytes) least_ = {bytes, std::move(what)};
  }

  void takeAvailable() {
    constexpr std::uint64_t kilobyte = 1024;
    if (const auto available = numberAfter(root_ + "/proc/meminfo", "MemAvailable:")) {
      return take(*available * kilobyte + own_, "available on this machine");
    }
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    if (pages <= 0 || page <= 0) return;
    take(static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page), "in this machine");
  }

  /// Lines are NUMBER:CONTROLLERS:PATH; version 2 has no controllers there. Inside a container the path may
  /// exist only outside: then the container's own group is at the folder's top.
  void takeControlGroups() {
    std::ifstream file(root_ + "/proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
      const auto first = line.find(':'), second = line.find(':', first + 1);
      if (first == std::string::npos || second == std::string::npos) continue;
      const std::string controllers = line.substr(first + 1, second - first - 1);
      const std::string path = line.substr(second + 1);
      if (controllers.empty()) takeGroups(version_2, path);
      if (("," + controllers + ",").find(",memory,") != std::string::npos) takeGroups(version_1, path);
    }
  }

  /// Takes the limits of a group and of those around it.
  void takeGroups(const Control& control, std::string path) {
    while (!path.empty() && path.back() == '/') path.pop_back();
    for (;;) {
      takeGroup(control, path);
      if (path.empty()) return;
      path.erase(std::min(path.rfind('/'), path.size()));
    }
  }

  /// Memory used by others in the group is not available, except for files that the system keeps in memory.
  void takeGroup(const Control& control, const std::string& path) {
    const std::string folder = fmt::format("{}/{}{}/", root_, control.folder, path);
    const auto limit = numberIn(folder + control.limit);
    if (!limit) return;
    const auto used = numberIn(folder + control.used).value_or(0);
    const auto cached = numberAfter(folder + "memory.stat", control.cached).value_or(0);
    const auto others = less(less(used, cached), own_);
    take(less(*limit, others),
         fmt::format("left by {} of the control group {}", control.limit, path.empty() ? "/" : path));
  }

  /// A process has more address space than memory: libraries, stacks, and arrays never written.
  void takeResourceLimits() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
      take(less(limit.rlim_cur, less(space_, own_)), "left by the limit on addresses (ulimit -v)");
    }
    if (getrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
      take(limit.rlim_cur, "allowed by the limit on data (ulimit -d)");
    }
  }

  std::string root_;
  std::uint64_t own_ = 0, space_ = 0;
  MemoryLimit least_{unlimited, "known of"};
};

}  // namespace

MemoryLimit systemMemoryLimit(const std::string& root) { return Limits(root).least(); }

}  // namespace vorpipe
