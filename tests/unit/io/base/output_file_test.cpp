#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/base/output_file.h"
#include "unit/fixtures/another_user.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Output : public InTemporaryDirectory {
 protected:
  static Error refused(const std::string& path) {
    const auto file = OutputFile::create(path);
    if (file) {
      ADD_FAILURE() << path << " was accepted";
      return {};
    }
    return file.error();
  }
};

TEST_F(Output, AppearsOnlyAfterCommit) {
  write("a.txt", "old");
  auto file = OutputFile::create(path("a.txt"));
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_TRUE(file->write("new "));
  ASSERT_TRUE(file->write("text"));
  EXPECT_EQ(contents(path("a.txt")), "old");
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(contents(path("a.txt")), "new text");
  EXPECT_EQ(files(), 1u);
}

TEST_F(Output, LeavesNothingWithoutCommit) {
  write("old.txt", "old");
  {
    auto kept = OutputFile::create(path("old.txt"));
    auto fresh = OutputFile::create(path("fresh.txt"));
    ASSERT_TRUE(kept && fresh);
    ASSERT_TRUE(kept->write("new"));
    ASSERT_TRUE(fresh->write("new"));
    ASSERT_TRUE(fresh->finish());
    EXPECT_EQ(files(), 3u);
  }
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(contents(path("old.txt")), "old");
}

TEST_F(Output, SeveralAppearTogether) {
  const std::vector<std::string> paths = {path("a"), path("b")};
  auto outputs = createOutputs(paths);
  ASSERT_TRUE(outputs) << outputs.error().message;
  ASSERT_TRUE((*outputs)[0].write("A"));
  ASSERT_TRUE((*outputs)[1].write("B"));
  EXPECT_EQ(files(), 2u);
  EXPECT_FALSE(fs::exists(path("a")));
  ASSERT_TRUE(commitAll(*outputs));
  EXPECT_EQ(contents(path("a")) + contents(path("b")), "AB");
  EXPECT_EQ(files(), 2u);
}

TEST_F(Output, OneThatFailsKeepsTheOthersAway) {
  const std::vector<std::string> paths = {path("a"), "/dev/full"};
  auto outputs = createOutputs(paths);
  if (!outputs) {
    GTEST_SKIP() << "there is no /dev/full here";
  }
  ASSERT_TRUE((*outputs)[0].write("A"));
  ASSERT_TRUE((*outputs)[1].write("B"));
  const auto committed = commitAll(*outputs);
  ASSERT_FALSE(committed);
  EXPECT_EQ(committed.error().code, ErrorCode::device);
  EXPECT_EQ(committed.error().message, "/dev/full: writing failed: No space left on device");
  EXPECT_FALSE(fs::exists(path("a")));
}

TEST_F(Output, OneThatCannotBePutInPlaceLeavesTheOthersAsTheyWere) {
  write("a", "old");
  auto outputs = createOutputs(std::vector{path("a"), path("b"), path("c"), path("d")});
  ASSERT_TRUE(outputs) << outputs.error().message;
  // Made meanwhile.
  fs::create_directory(path("c"));
  for (OutputFile& file : *outputs) ASSERT_TRUE(file.write("new"));
  const auto committed = commitAll(*outputs);
  ASSERT_FALSE(committed);
  EXPECT_EQ(committed.error().message,
            path("c") + ": the finished file could not be put in place: Is a directory");
  outputs->clear();
  EXPECT_EQ(contents(path("a")), "old");
  EXPECT_EQ(files(), 2u);
}

TEST_F(Output, RefusesFilesOfOthersThatTheirFolderProtects) {
  if (::geteuid() != 0) GTEST_SKIP() << "it takes root to have a file of another user";
  fs::create_directory(path("sticky"));
  const std::string file = write("sticky/a", "old");
  fs::permissions(path("sticky"), fs::perms::all | fs::perms::sticky_bit);
  fs::permissions(file, fs::perms::all);
  const AnotherUser user(directory());
  if (!user.whyNot().empty()) GTEST_SKIP() << user.whyNot();
  EXPECT_EQ(refused(file).message,
            file + ": cannot be written: it is another user's, whom its folder protects");
  EXPECT_TRUE(OutputFile::create(path("sticky/b")));
}

TEST_F(Output, TwoNamesOfOneFileAreRefused) {
  fs::create_symlink("a", path("link"));
  for (const std::string& other : {path("a"), path("./a"), path("link")}) {
    const auto outputs = createOutputs(std::vector{path("a"), other});
    ASSERT_FALSE(outputs);
    EXPECT_EQ(outputs.error().message, other + ": is the same output file as " + path("a"));
  }
  EXPECT_TRUE(createOutputs(std::vector<std::string>{"/dev/null", "/dev/null"}));
  EXPECT_EQ(files(), 1u);
}

TEST_F(Output, RefusesWrongPathsAtOnce) {
  EXPECT_EQ(refused(path("no/a.png")).message, path("no/a.png") + ": cannot be written: directory " +
                                                   path("no") + ": No such file or directory");
  EXPECT_EQ(refused(path("no/a.png")).code, ErrorCode::input);
  EXPECT_THAT(refused(path(".")).message, HasSubstr("is a directory"));
  EXPECT_THAT(refused(path("new/")).message, HasSubstr("is a directory"));
  EXPECT_THAT(refused("").message, HasSubstr("is empty"));
  EXPECT_THAT(refused(path(std::string(300, 'a'))).message, HasSubstr("File name too long"));
  write("file", "");
  EXPECT_THAT(refused(path("file/a.png")).message, HasSubstr("Not a directory"));
  fs::create_symlink("round", path("round"));
  EXPECT_THAT(refused(path("round")).message, HasSubstr("symbolic link"));
  EXPECT_EQ(files(), 2u);
}

TEST_F(Output, RefusesMissingPermissions) {
  const AnotherUser user(directory());
  if (!user.whyNot().empty()) GTEST_SKIP() << user.whyNot();
  const std::string file = write("kept", "old");
  fs::permissions(file, fs::perms::owner_read);
  EXPECT_EQ(refused(file).message, file + ": cannot be written: Permission denied");
  fs::create_directory(path("locked"));
  fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(refused(path("locked/a")).message,
              HasSubstr("no file can be created beside it: Permission denied"));
}

TEST_F(Output, FollowsSymbolicLinks) {
  fs::create_directory(path("real"));
  write("real/a", "old");
  fs::create_symlink("real/a", path("link"));
  fs::create_symlink("real/fresh", path("dangling"));
  for (const char* name : {"link", "dangling"}) {
    auto file = OutputFile::create(path(name));
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(file->write("new") && file->commit());
    EXPECT_TRUE(fs::is_symlink(path(name)));
  }
  EXPECT_EQ(contents(path("real/a")) + contents(path("real/fresh")), "newnew");
}

TEST_F(Output, KeepsPermissions) {
  const auto mode = [&](const char* name) { return fs::status(path(name)).permissions(); };
  const std::string file = write("private", "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  const mode_t mask = ::umask(027);
  for (const char* name : {"private", "fresh"}) {
    auto output = OutputFile::create(path(name));
    ASSERT_TRUE(output && output->commit());
  }
  ::umask(mask);
  EXPECT_EQ(mode("private"), fs::perms{0600});
  EXPECT_EQ(mode("fresh"), fs::perms{0640});
}

TEST_F(Output, WritesToPipesDirectly) {
  const std::string fifo = path("pipe");
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  ASSERT_EQ(std::system(("cat '" + fifo + "' > '" + path("copy") + "' &").c_str()), 0);
  auto file = OutputFile::create(fifo);
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_TRUE(file->write("through") && file->commit());
  EXPECT_TRUE(fs::is_fifo(fifo));
  for (int i = 0; i < 500 && contents(path("copy")).empty(); ++i) {
    ::usleep(10000);
  }
  EXPECT_EQ(contents(path("copy")), "through");
}

TEST_F(Output, CanBeMoved) {
  auto first = OutputFile::create(path("a"));
  auto second = OutputFile::create(path("b"));
  ASSERT_TRUE(first && second);
  *first = std::move(*second);
  EXPECT_EQ(files(), 1u);
  ASSERT_TRUE(first->write("text") && first->commit());
  EXPECT_EQ(contents(path("b")), "text");
  EXPECT_EQ(files(), 1u);
}

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
