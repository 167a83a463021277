#include "io/base/read_log.h"

#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <thread>
#include <vector>

#include "io/base/input_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe {
namespace {

constexpr auto hash_of_nothing = "99aa06d3014798d86001c324468d497f";  // by xxh128sum
constexpr auto hash_of_abc = "06b05ab6733a618578af5f94892f3950";

void readAll(const std::string& path) {
  auto file = InputFile::open(path);
  ASSERT_TRUE(file);
  std::vector<char> bytes(2);
  for (;;) {
    const auto count = file->read(bytes);
    ASSERT_TRUE(count);
    if (*count < bytes.size()) return;
  }
}

class ReadLogs : public test::InTemporaryDirectory {};

TEST_F(ReadLogs, NoteWhatIsOpenedWhileTheyLiveAndNothingElse) {
  const std::string before = write("before", "x"), abc = write("abc", "abc"), empty = write("empty", "");
  readAll(before);
  std::vector<LoggedFile> files;
  {
    const ReadLog log;
    readAll(abc);
    readAll(empty);
    readAll(abc);
    { const auto absent = InputFile::open(path("absent")); }
    {
      const ReadLog::Pause pause;
      readAll(before);
    }
    std::thread([&] { readAll(before); }).join();
    files = log.files();
  }
  EXPECT_EQ(ReadLog::current(), nullptr);
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].path, abc);
  EXPECT_EQ(files[0].contents, (Contents{3, hash_of_abc}));
  EXPECT_EQ(files[1].contents, (Contents{0, hash_of_nothing}));
}

TEST_F(ReadLogs, HashPipesWhileTheyAreRead) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const ReadLog log;
  std::thread writer([&] { write("pipe", "abc"); });
  readAll(pipe);
  writer.join();
  ASSERT_EQ(log.files().size(), 1U);
  EXPECT_EQ(log.files()[0].contents, (Contents{3, hash_of_abc}));
}

TEST_F(ReadLogs, HashGzipAsItIs) {
  // gzip -n of "abc".
  const std::string packed("\x1F\x8B\x08\0\0\0\0\0\0\x03\x4B\x4C\x4A\x06\0\xC2\x41\x24\x35\x03\0\0\0", 23);
  const ReadLog log;
  readAll(write("abc.gz", packed));
  ASSERT_EQ(log.files().size(), 1U);
  EXPECT_EQ(log.files()[0].contents.bytes, packed.size());
}

TEST_F(ReadLogs, KnowAFileByEachOfItsNamesAndHashNothingForThat) {
  const ReadLog log(ReadLog::Notes::names);
  const std::string abc = write("abc", "abc"), other = write("other", "abc");
  readAll(abc);
  ASSERT_EQ(::link(abc.c_str(), path("hard").c_str()), 0);
  ASSERT_EQ(::symlink("hard", path("soft").c_str()), 0);
  for (const std::string& name : {abc, path("hard"), path("soft"), path("./abc")}) {
    ASSERT_NE(log.nameOf(name), nullptr) << name;
    EXPECT_EQ(*log.nameOf(name), abc);
  }
  EXPECT_EQ(log.nameOf(other), nullptr);
  EXPECT_EQ(log.nameOf(path("absent")), nullptr);
  EXPECT_TRUE(log.files().empty());
}

TEST_F(ReadLogs, LeaveTheFilesOfAnInnerRunToItsLog) {
  const ReadLog outer;
  {
    const ReadLog inner;
    readAll(write("inner", "abc"));
    EXPECT_EQ(inner.files().size(), 1U);
  }
  readAll(write("outer", ""));
  ASSERT_EQ(outer.files().size(), 1U);
  EXPECT_EQ(outer.files()[0].path, path("outer"));
}

}  // namespace
}  // namespace vorpipe
