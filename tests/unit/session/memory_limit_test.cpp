/// How much memory there is, from the system's files as they might be.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>

#include "unit/fixtures/temporary_directory.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t mega = 1024 * 1024;

/// A machine whose files say what a test has them say.
class MemoryLimits : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::path(::testing::TempDir()) /
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(root_);
    put("proc/meminfo", "MemTotal: 9216000 kB\nMemFree: 1 kB\nMemAvailable:    8192000 kB\n");
    put("proc/self/status", "Name:\tx\nVmSize:\t  2048 kB\nVmRSS:\t    1024 kB\n");
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  void put(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  [[nodiscard]] MemoryLimit limit() const { return systemMemoryLimit(root_.string()); }

  std::filesystem::path root_;
};

TEST_F(MemoryLimits, OfAMachineIsWhatIsAvailableAndWhatTheProcessHas) {
  EXPECT_EQ(limit().bytes, 8000 * mega + mega);
  EXPECT_THAT(limit().what, HasSubstr("available"));
}

TEST_F(MemoryLimits, OfAControlGroupIsWhatOthersLeave) {
  put("proc/self/cgroup", "0::/user/job\n");
  put("sys/fs/cgroup/user/job/memory.max", "1048576000\n");
  EXPECT_EQ(limit().bytes, 1000 * mega);
  EXPECT_THAT(limit().what, HasSubstr("memory.max of the control group /user/job"));
  // Of 300 MiB in use, 100 are files that can be forgotten, and 1 is ours.
  put("sys/fs/cgroup/user/job/memory.current", std::to_string(300 * mega) + "\n");
  put("sys/fs/cgroup/user/job/memory.stat", "anon 5\nfile " + std::to_string(100 * mega) + "\nfile_x 1\n");
  EXPECT_EQ(limit().bytes, (1000 - 199) * mega);
  put("sys/fs/cgroup/user/job/memory.max", "max\n");
  EXPECT_EQ(limit().bytes, 8001 * mega);
}

TEST_F(MemoryLimits, OfTheGroupsAroundItTheLeastWins) {
  put("proc/self/cgroup", "0::/user/job/step\n");
  put("sys/fs/cgroup/user/job/step/memory.max", std::to_string(900 * mega));
  put("sys/fs/cgroup/user/memory.max", std::to_string(700 * mega));
  put("sys/fs/cgroup/memory.max", std::to_string(800 * mega));
  EXPECT_EQ(limit().bytes, 700 * mega);
  EXPECT_THAT(limit().what, HasSubstr("control group /user"));
  put("sys/fs/cgroup/memory.max", std::to_string(600 * mega));
  EXPECT_EQ(limit().bytes, 600 * mega);
  EXPECT_THAT(limit().what, HasSubstr("control group /"));
  put("proc/meminfo", "MemAvailable: 102400 kB\n");
  EXPECT_EQ(limit().bytes, 101 * mega);
  EXPECT_THAT(limit().what, HasSubstr("available"));
}

TEST_F(MemoryLimits, OfVersion1AreThoseOfItsMemoryController) {
  put("proc/self/cgroup", "12:cpu,cpuacct:/a\n9:memory:/docker/1234\n1:name=systemd:/b\n0::/c\n");
  put("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "1");
  put("sys/fs/cgroup/memory/docker/1234/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(limit().bytes, 8001 * mega);
  // Inside the container its group is at the top.
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", std::to_string(500 * mega));
  put("sys/fs/cgroup/memory/memory.usage_in_bytes", std::to_string(50 * mega));
  put("sys/fs/cgroup/memory/memory.stat", "cache 1\ntotal_cache " + std::to_string(9 * mega) + "\n");
  EXPECT_EQ(limit().bytes, (500 - 40) * mega);
  EXPECT_THAT(limit().what, HasSubstr("memory.limit_in_bytes"));
}

TEST_F(MemoryLimits, AGroupThatIsFullLeavesNothingMore) {
  put("proc/self/cgroup", "0::/\n");
  put("sys/fs/cgroup/memory.max", std::to_string(100 * mega));
  put("sys/fs/cgroup/memory.current", std::to_string(500 * mega));
  EXPECT_EQ(limit().bytes, 0u);
}

/// Sets a limit of this process while it lives.
class ResourceLimit {
 public:
  ResourceLimit(int which, std::uint64_t bytes) : which_(which) {
    getrlimit(static_cast<__rlimit_resource_t>(which_), &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    set_ = setrlimit(static_cast<__rlimit_resource_t>(which_), &now) == 0;
  }
  ~ResourceLimit() { setrlimit(static_cast<__rlimit_resource_t>(which_), &before_); }
  ResourceLimit(const ResourceLimit&) = delete;
  ResourceLimit& operator=(const ResourceLimit&) = delete;
  [[nodiscard]] bool isSet() const { return set_; }

 private:
  int which_;
  rlimit before_{};
  bool set_ = false;
};

TEST_F(MemoryLimits, OfResourcesCount) {
  {
    const ResourceLimit data(RLIMIT_DATA, 7000 * mega);
    ASSERT_TRUE(data.isSet());
    EXPECT_EQ(limit().bytes, 7000 * mega);
    EXPECT_THAT(limit().what, HasSubstr("ulimit -d"));
    put("proc/meminfo", "MemAvailable: 102400 kB\n");
    EXPECT_EQ(limit().bytes, 101 * mega);
  }
  put("proc/meminfo", "MemAvailable: 1048576000 kB\n");
  const std::uint64_t addresses = std::uint64_t{1} << 36;
  const ResourceLimit space(RLIMIT_AS, addresses);
  if (!space.isSet()) GTEST_SKIP() << "addresses cannot be limited here";
  // 1 MiB of addresses is no memory.
  EXPECT_EQ(limit().bytes, addresses - mega);
  EXPECT_THAT(limit().what, HasSubstr("ulimit -v"));
}

TEST(MemoryLimit, OfThisMachineIsKnown) {
  const MemoryLimit limit = systemMemoryLimit();
  EXPECT_GT(limit.bytes, 16 * mega);
  EXPECT_LT(limit.bytes, std::uint64_t{1} << 50);
  EXPECT_FALSE(limit.what.empty());
}

}  // namespace
}  // namespace vorpipe::test
