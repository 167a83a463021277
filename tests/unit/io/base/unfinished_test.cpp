#include "io/base/unfinished.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>

#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

class UnfinishedFiles : public InTemporaryDirectory {};

TEST_F(UnfinishedFiles, AreRemovedUnlessMoved) {
  {
    Unfinished kept(path("kept.tmp")), lost(path("lost.tmp"));
    EXPECT_EQ(files(), 0u);
    close(kept.create(0600));
    close(lost.create(0600));
    EXPECT_EQ(files(), 2u);
    EXPECT_TRUE(kept.moveTo(path("kept").c_str()));
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(UnfinishedFiles, OfOthersStay) {
  write("other", "text");
  {
    Unfinished mine(path("other"));
    EXPECT_LT(mine.create(0600), 0);
    EXPECT_EQ(errno, EEXIST);
  }
  EXPECT_EQ(contents(path("other")), "text");
}

TEST_F(UnfinishedFiles, AreAllRemovedAtOnce) {
  const std::string first = path("first"), second = path("second");
  const auto end = [&] {
    Unfinished one(first), two(second);
    close(one.create(0600));
    close(two.create(0600));
    const bool both = access(first.c_str(), F_OK) == 0 && access(second.c_str(), F_OK) == 0;
    removeUnfinished();
    _exit(both ? 0 : 1);
  };
  EXPECT_EXIT(end(), testing::ExitedWithCode(0), "");
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace vorpipe::test
