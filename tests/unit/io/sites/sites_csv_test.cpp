#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/line_reader.h"
#include "io/sites/sites_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;

class Csv : public InTemporaryDirectory {
 protected:
  /// The sites of a CSV file with these bytes; fails the test when there are none.
  [[nodiscard]] Sites good(std::string_view bytes) const {
    const auto sites = readSites(write("sites.csv", bytes));
    if (!sites) {
      ADD_FAILURE() << sites.error().message;
      return {};
    }
    return sites->sites;
  }

  /// What follows the file's path in the error message.
  [[nodiscard]] std::string bad(std::string_view bytes) const {
    const std::string file = write("sites.csv", bytes);
    const auto sites = readSites(file);
    if (sites) {
      ADD_FAILURE() << "was accepted: " << bytes;
      return "";
    }
    EXPECT_EQ(sites.error().code, ErrorCode::input);
    EXPECT_EQ(sites.error().message.find('\n'), std::string::npos);
    EXPECT_TRUE(sites.error().message.starts_with(file + ":")) << sites.error().message;
    return sites.error().message.substr(std::min(file.size() + 1, sites.error().message.size()));
  }
};

TEST_F(Csv, ReadsXAndY) {
  const Sites sites = good("x,y\n1,2\n-3.5,4e-1\n");
  EXPECT_THAT(sites.x, ElementsAre(1, -3.5));
  EXPECT_THAT(sites.y, ElementsAre(2, 0.4));
  EXPECT_TRUE(sites.weight.empty());
}

/// Most rows are read as pairs of numbers; what is none is read as fields, and rows after it as pairs again.
TEST_F(Csv, RowsThatArePairsAreReadAsOthers) {
  for (const std::string_view header : {"x,y\n", "y,x\r\n", "# of sites\nx,y\n", ""}) {
    const bool swapped = header.starts_with('y');
    std::string rows;
    std::vector<double> x, y;
    for (int i = 0; i < 60000; ++i) {
      const double a = 0.1 * i, b = i % 977 == 5 ? 1e-300 : -1.0 / (i + 1);
      const auto row = fmt::format("{},{}", a, b);
      // As others write it: blanks, quotes, a sign, digits beyond doubles, a comment, an empty line, no last
      // end.
      rows += i % 1000 == 7   ? fmt::format(" {} , +{}", a, std::abs(b))
              : i % 5000 == 9 ? fmt::format("\"{}\",{}", a, b)
                              : row;
      rows += i % 3 == 0 ? "\r\n" : "\n";
      if (i % 20000 == 11) rows += "# a remark, 5\n\n";
      x.push_back(a);
      y.push_back(i % 1000 == 7 ? std::abs(b) : b);
    }
    rows += "7,8";
    x.push_back(7);
    y.push_back(8);
    const Sites sites = good(std::string(header) + rows);
    EXPECT_EQ(swapped ? sites.y : sites.x, x) << header;
    EXPECT_EQ(swapped ? sites.x : sites.y, y) << header;
  }
}

TEST_F(Csv, RefusesARowAmongPairsByItsLine) {
  std::string rows = "x,y\n";
  for (int i = 0; i < 50000; ++i) rows += "0.25,0.5\n";
  EXPECT_EQ(bad(rows + "0.25,inf\n"), "50002:6: \"inf\" is not a finite number (column y)");
  EXPECT_EQ(bad(rows + "0.25,0.5,1\n"), "50002:10: the row has 3 fields, the header 2");
  EXPECT_EQ(bad(rows + "\n0.25,1e999\n"), "50003:6: \"1e999\" is out of the range of a double (column y)");
}

TEST_F(Csv, ColumnsComeInAnyOrderAmongOthers) {
  const Sites sites = good("name,weight,y,x\n\"a, b\",5,2,1\nc,6,4,3\n");
  EXPECT_THAT(sites.x, ElementsAre(1, 3));
  EXPECT_THAT(sites.y, ElementsAre(2, 4));
  EXPECT_THAT(sites.weight, ElementsAre(5, 6));
}

TEST_F(Csv, RadiusIsSquared) {
  EXPECT_THAT(good("x,y,radius\n0,0,3\n1,1,0.5\n").weight, ElementsAre(9, 0.25));
}

TEST_F(Csv, AcceptsWhatOtherProgramsWrite) {
  const std::string_view same[] = {
      "x,y\r\n1,2\r\n3,4\r\n",
      "x,y\r1,2\r3,4\r",
      "\xEF\xBB\xBFx,y\n1,2\n3,4\n",
      "x,y\n1,2\n3,4",
      "\n \nx,y\n\n1,2\n\t\n3,4\n\n",
      " x , y \n 1 ,\t2 \n+3,4\n",
      "\"x\",\"y\"\n\"1\",\" 2 \"\n\"3\",4.\n",
      "x,note,y\n1,\"two\nlines, and \"\"quotes\"\"\",2\n3,,4\n",
  };
  for (const std::string_view bytes : same) {
    SCOPED_TRACE(bytes);
    const Sites sites = good(bytes);
    EXPECT_THAT(sites.x, ElementsAre(1, 3));
    EXPECT_THAT(sites.y, ElementsAre(2, 4));
  }
}

TEST_F(Csv, NumbersTooSmallForADoubleAreAccepted) {
  const Sites sites = good("x,y\n4.9e-324,1e-310\n1e-999,-0.0000001e-400\n1e-99999999999999999999,0e999\n");
  EXPECT_THAT(sites.x, ElementsAre(4.9e-324, 0, 0));
  EXPECT_THAT(sites.y, ElementsAre(1e-310, 0, 0));
  EXPECT_TRUE(std::signbit(sites.y[1]));
  EXPECT_THAT(good("x,y\n0." + std::string(400, '0') + "1,1" + std::string(300, '0') + "e-300\n").x,
              ElementsAre(0));
}

TEST_F(Csv, RefusesNumbersWithFileLineAndColumn) {
  EXPECT_EQ(bad("x,y\n1,2\n3,abc\n"), "3:3: \"abc\" is not a number (column y)");
  EXPECT_EQ(bad("x,y\n1,2\n  1.5x ,2\n"), "3:3: \"1.5x\" is not a number (column x)");
  EXPECT_EQ(bad("x,y\n\n\n1,\"2,5\"\n"), "4:3: \"2,5\" is not a number (column y)");
  EXPECT_EQ(bad("x,y\r\n1,0x10\r\n"), "2:3: \"0x10\" is not a number (column y)");
  EXPECT_EQ(bad("x,y\n1,+-2\n"), "2:3: \"+-2\" is not a number (column y)");
  EXPECT_EQ(bad("x,y\n1,1e\n"), "2:3: \"1e\" is not a number (column y)");
  EXPECT_EQ(bad("x,y\n1,\n"), "2:3: empty field; --missing skip leaves such rows out (column y)");
  EXPECT_EQ(bad("x,y\n,1\n"), "2:1: empty field; --missing skip leaves such rows out (column x)");
  EXPECT_EQ(bad("x,y\n12,nan\n"), "2:4: \"nan\" is no value; --missing skip leaves such rows out (column y)");
  EXPECT_EQ(bad("x,y\n-inf,1\n"), "2:1: \"-inf\" is not a finite number (column x)");
  EXPECT_EQ(bad("x,y\n1e999,1\n"), "2:1: \"1e999\" is out of the range of a double (column x)");
  EXPECT_EQ(bad("x,y\n1,-1" + std::string(309, '0') + "\n"),
            "2:3: \"-1" + std::string(38, '0') + "...\" is out of the range of a double (column y)");
  EXPECT_EQ(bad("x,y,weight\n1,2,heavy\n"), "2:5: \"heavy\" is not a number (column weight)");
  EXPECT_EQ(bad("x,y,radius\n1,2,-3\n"), "2:5: \"-3\" is negative, and a radius (column radius)");
  EXPECT_EQ(bad("x,y,radius\n1,2,1e200\n"),
            "2:5: the square of \"1e200\" is out of the range of a double (column radius)");
}

TEST_F(Csv, ALineEndInsideQuotesCountsAsALine) {
  EXPECT_EQ(bad("note,x,y\n\"a\nb\nc\",1,2\n\"a\nb\",1,oops\n"), "6:6: \"oops\" is not a number (column y)");
  EXPECT_EQ(bad("x,note,y\noops,\"a\nb\",1\n"), "2:1: \"oops\" is not a number (column x)");
}

TEST_F(Csv, RefusesRowsOfAnotherLength) {
  EXPECT_EQ(bad("x,y\n1,2\n3\n"), "3:2: the row has 1 field, the header 2");
  EXPECT_EQ(bad("x,y\n1,2,3\n"), "2:5: the row has 3 fields, the header 2");
}

TEST_F(Csv, RefusesHeaders) {
  const std::string advice =
      "; the first line must name the columns, as in \"x,y\", or --columns says which they are";
  EXPECT_EQ(bad("a,b\n3,4\n"), "1:1: the header \"a,b\" names no column \"x\"" + advice);
  EXPECT_EQ(bad("x,z\n3,4\n"), "1:1: the header \"x,z\" names no column \"y\"" + advice);
  EXPECT_EQ(bad("x,y,x\n1,2,3\n"), "1:5: the header names column \"x\" twice");
  EXPECT_EQ(bad("radius,x,y,weight\n1,2,3,4\n"),
            "1:12: the header names both \"radius\" and \"weight\"; --columns says which");
}

TEST_F(Csv, RefusesFilesWithoutSites) {
  EXPECT_EQ(bad(""), " is empty; its first line must name the columns, as in \"x,y\"");
  EXPECT_EQ(bad("\n\n"), " is empty; its first line must name the columns, as in \"x,y\"");
  EXPECT_EQ(bad("x,y\n"), " holds no sites");
}

TEST_F(Csv, RefusesBrokenQuotes) {
  EXPECT_EQ(bad("x,y\n1,2\"3\n"),
            "2:4: a quote inside a field that does not begin with one, or text after a closing quote");
  EXPECT_EQ(bad("x,y\n1,\"2\n3,4\n"), "2:3: the quoted field that begins here does not end");
}

TEST_F(Csv, RefusesBinaryData) {
  EXPECT_EQ(bad(std::string(3 << 20, 'a')),
            "1:1: the line is longer than 1048576 bytes; is this a text file?");
  EXPECT_EQ(bad(std::string_view("x,y\n1,\0\x01\n", 9)), "2:3: \"\\x00\\x01\" is not a number (column y)");
  const std::string open = "x,y\n1,\"" + std::string(1000, '\n');
  std::string endless = open;
  for (int i = 0; i < 1200; ++i) {
    endless += std::string(1000, 'a') + "\n";
  }
  EXPECT_EQ(bad(endless), "2:3: the quoted field that begins here is longer than 1048576 bytes");
}

TEST_F(Csv, ChunksDoNotMatter) {
  std::string bytes = "x,y\r\n";
  std::vector<double> expected;
  while (bytes.size() < 3 * LineReader::longest_line) {
    expected.push_back(static_cast<double>(expected.size()));
    bytes += std::to_string(expected.size() - 1) + "," + std::to_string(expected.size() % 7) + "\r\n";
  }
  EXPECT_EQ(good(bytes).x, expected);
  const std::string line = std::to_string(expected.size() + 2);
  EXPECT_EQ(bad(bytes + "5,bad\r\n"), line + ":3: \"bad\" is not a number (column y)");
}

}  // namespace
}  // namespace vorpipe::test
