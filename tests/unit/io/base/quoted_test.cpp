#include "io/base/quoted.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace vorpipe {
namespace {

TEST(Quoted, KeepsWhatPeopleWrite) {
  for (const char* text : {"", "Straße", "東京", "ελληνικά", "𝄞", "a \"b\" \\", "~"})
    EXPECT_EQ(inQuotes(text), '"' + std::string(text) + '"');
}

// A hostile file must not color, move or name what a terminal shows.
TEST(Quoted, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(escaped("a\x1b[31mb\n\x7f"), "a\\x1b[31mb\\x0a\\x7f");
  EXPECT_EQ(escaped("\x9b"
                    "31m"),
            "\\x9b31m");
  EXPECT_EQ(escaped("\u009b31m"), "\\xc2\\x9b31m");
  EXPECT_EQ(escaped("a\u2028b\u202ec\u2066d"), "a\\xe2\\x80\\xa8b\\xe2\\x80\\xaec\\xe2\\x81\\xa6d");
  EXPECT_EQ(escaped("\u00a0\u2027\u202f\u2065\u206a"), "\u00a0\u2027\u202f\u2065\u206a");
}

TEST(Quoted, IsUtf8WhateverItIsGiven) {
  EXPECT_EQ(escaped("K\xf6nig"), "K\\xf6nig");
  EXPECT_EQ(escaped("\xc3"), "\\xc3");
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  EXPECT_TRUE(isUtf8(escaped(all)));
}

TEST(Quoted, IsCutAtAWholeCharacter) {
  const std::string of_forty(40, 'a'), of_thirty_nine(39, 'a');
  EXPECT_EQ(printable(of_forty), of_forty);
  EXPECT_EQ(printable(of_forty + "b"), of_forty + "...");
  EXPECT_EQ(printable(of_thirty_nine + "ß"), of_thirty_nine + "...");
  EXPECT_EQ(printable(of_thirty_nine + "\xff\xff"), of_thirty_nine + "\\xff...");
}

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
}  // namespace vorpipe
