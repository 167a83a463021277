#include <gtest/gtest.h>

#include <cstdio>

#include "io/base/shell_line.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

/// What bash reads a line as: each word, and a byte 0 after it.
std::string readByBash(const std::vector<std::string>& words) {
  // Outside is what runs commands, sh, which does not know $'...'.
  const std::string line = shellLine({"bash", "-c", "printf '%s\\0' " + shellLine(words)});
  FILE* const bash = popen(line.c_str(), "r");
  if (bash == nullptr) return "popen";
  std::string read;
  for (int c = std::fgetc(bash); c != EOF; c = std::fgetc(bash)) read += static_cast<char>(c);
  EXPECT_EQ(pclose(bash), 0);
  return read;
}

TEST(ShellLine, IsReadAsTheSameWords) {
  const std::vector<std::string> words = {"render",          "",         "--view=-0.5,0,1.5,1.5",
                                          "a b.csv",         "it's.csv", "$HOME `id` \\ \" ! *?[x]{1,2} ~ #",
                                          "caf\xC3\xA9.csv", "a\nb.csv", "\x1B[31m'\\.csv",
                                          "\xC2\x9B.csv"};
  std::string expected;
  for (const std::string& word : words) expected += word + '\0';
  EXPECT_EQ(readByBash(words), expected);
}

TEST(ShellLine, HasNothingThatATerminalObeys) {
  const std::string line = shellLine({"a\nb.csv", "\x1B[31m.csv", "\x7F", "\xC2\x9B"});
  EXPECT_EQ(line, R"($'a\012b.csv' $'\033[31m.csv' $'\177' $'\302\233')");
}

}  // namespace
}  // namespace vorpipe::test
