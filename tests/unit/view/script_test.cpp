#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/fixtures/script_line.h"
#include "view/script.h"

namespace vorpipe::view {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> linesOf(const Script& script) {
  std::vector<std::string> lines;
  for (const ScriptLine& line : script.lines) lines.push_back(scriptLine(line.event));
  return lines;
}

std::string refused(const std::string& text) {
  const auto script = parseScript("play.txt", text);
  if (script) return "accepted";
  EXPECT_EQ(script.error().code, ErrorCode::input);
  return script.error().message;
}

TEST(Script, HasOneEventALine) {
  const std::string text =
      "# moves\n"
      "move 640.5 -360\n"
      "  press left control shift   # down\n"
      "release left\r\n"
      "\n"
      "scroll -1 control\n"
      "key z control shift\n"
      "text  a # b\n"
      "resize 800 600\n"
      "minimize\nrestore\n"
      "drop \"a \\\"file\\\".csv\" b.csv\n"
      "wait\nwait 0.5\n"
      "screenshot a.png\nscreenshot \"my picture.png\" panel\n"
      "close";
  const auto script = parseScript("play.txt", text);
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_THAT(linesOf(*script),
              ElementsAre("move 640.5 -360", "press left shift control", "release left", "scroll -1 control",
                          "key z shift control", "text  a # b", "resize 800 600", "minimize", "restore",
                          "drop \"a \\\"file\\\".csv\" b.csv", "wait", "wait 0.5", "screenshot a.png",
                          "screenshot \"my picture.png\" panel", "close"));
  EXPECT_EQ(script->lines[0].number, 2U);
  EXPECT_EQ(script->lines[3].number, 6U);
}

TEST(Script, IsReadAsItWasWritten) {
  const auto script = parseScript("play.txt", "move 0.1 1e-5\nkey f12 alt\ndrop \"\"\n");
  ASSERT_TRUE(script) << script.error().message;
  std::string text;
  for (const std::string& line : linesOf(*script)) text += line + '\n';
  const auto again = parseScript("play.txt", text);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(linesOf(*again), linesOf(*script));
}

TEST(Script, NamesKeysAsTheWindowDoes) {
  const auto script =
      parseScript("play.txt", "key page_up\nkey pagedown\nkey bracketleft\nkey right_bracket\n");
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(linesOf(*script), (std::vector<std::string>{"key page_up", "key page_down", "key left_bracket",
                                                        "key right_bracket"}));
}

TEST(Script, SaysWhereItIsWrong) {
  EXPECT_EQ(refused("wait\n jump 1"),
            "play.txt:2:2: \"jump\" is no event: move, press, release, scroll, key, text, resize, minimize, "
            "restore, drop, wait, screenshot or close");
  EXPECT_EQ(refused("move 1"), "play.txt:1:7: Y is missing after move");
  EXPECT_EQ(refused("move 1 b"), "play.txt:1:8: Y: \"b\" is not a number");
  EXPECT_EQ(refused("press up"), "play.txt:1:7: \"up\" is not left, right or middle");
  EXPECT_EQ(refused("press left hyper"), "play.txt:1:12: \"hyper\" is too much here");
  EXPECT_EQ(refused("key omega"),
            "play.txt:1:5: \"omega\" is not a key: a to z, 0 to 9, f1 to f12, escape, tab, space ...");
  EXPECT_EQ(refused("resize 800"), "play.txt:1:11: HEIGHT is missing after resize");
  EXPECT_EQ(refused("resize 0 600"), "play.txt:1:8: WIDTH: 0 is not a whole number from 1 to 32768");
  EXPECT_EQ(refused("wait -1"), "play.txt:1:6: SECONDS: -1 is not above 0 and up to 86400");
  EXPECT_EQ(refused("screenshot a.jpg"), "play.txt:1:12: \"a.jpg\" does not end in .png");
  EXPECT_EQ(refused("drop \"a b"), "play.txt:1:6: the quote does not end");
  EXPECT_EQ(refused("close now"), "play.txt:1:7: \"now\" is too much here");
}

}  // namespace
}  // namespace vorpipe::view
