#include "io/base/byte_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/base/output_file.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"
#include "unit/io/cells/cells_fixture.h"

namespace vorpipe::test {
namespace {

struct Writer {
  std::string name;
  std::function<Result<void>(ByteSink&)> write;
};

/// Every writer of the library, with more bytes than it hands on at once.
std::vector<Writer> allWriters() {
  std::vector<Writer> writers;
  for (const auto extension : cellsExtensions()) {
    const std::string name = "c" + std::string(extension);
    writers.push_back({name, [name](ByteSink& to) {
                         return writeCells(to, {someSites(), someCells()}, **cellsFormatOf(name));
                       }});
  }
  constexpr int width = 300, height = 200;
  std::vector<std::uint32_t> pixels(width * height);
  for (std::uint32_t i = 0; i < pixels.size(); ++i) pixels[i] = i * 2654435761u;
  writers.push_back({"a.png", [pixels](ByteSink& to) { return writePng(to, width, height, pixels); }});
  writers.push_back({"ids.npy", [pixels](ByteSink& to) { return writeNpyIds(to, width, height, pixels); }});
  return writers;
}

class Sink : public InTemporaryDirectory {
 protected:
  [[nodiscard]] std::string fileOf(const Writer& writer) const {
    auto file = OutputFile::create(path(writer.name));
    EXPECT_TRUE(file && writer.write(*file) && file->commit()) << writer.name;
    return contents(path(writer.name));
  }
};

TEST_F(Sink, MemoryGetsTheBytesOfTheFile) {
  for (const Writer& writer : allWriters()) {
    MemorySink memory("memory");
    const auto written = writer.write(memory);
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_FALSE(memory.bytes().empty());
    EXPECT_EQ(memory.bytes(), fileOf(writer)) << writer.name;
  }
}

TEST_F(Sink, ACallbackGetsTheBytesOfTheFile) {
  for (const Writer& writer : allWriters()) {
    std::string bytes;
    CallbackSink callback("callback", [&](std::string_view piece) {
      EXPECT_FALSE(piece.empty()) << writer.name;
      bytes += piece;
      return true;
    });
    const auto written = writer.write(callback);
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(bytes, fileOf(writer)) << writer.name;
  }
}

/// Calls the writer with a callback that refuses the call of that number; how often it was called.
int callsUntilRefused(const Writer& writer, int refused) {
  int calls = 0;
  CallbackSink callback("out", [&](std::string_view) { return ++calls != refused; });
  const auto written = writer.write(callback);
  if (calls < refused) {
    EXPECT_TRUE(written) << writer.name;
  } else if (written) {
    ADD_FAILURE() << writer.name << " goes on after a refusal";
  } else {
    EXPECT_EQ(written.error().code, ErrorCode::device) << writer.name;
    EXPECT_EQ(written.error().message,
              "out: writing stopped: the callback that takes its bytes returned false");
  }
  return calls;
}

TEST_F(Sink, ACallbackThatRefusesIsNotCalledAgain) {
  for (const Writer& writer : allWriters()) {
    int refused = 1;
    while (callsUntilRefused(writer, refused) == refused) ++refused;
    EXPECT_GT(refused, 1) << writer.name;
    EXPECT_EQ(callsUntilRefused(writer, refused), refused - 1) << writer.name;
  }
}

TEST_F(Sink, MemoryIsHandedOver) {
  MemorySink memory("memory");
  EXPECT_EQ(memory.name(), "memory");
  ASSERT_TRUE(memory.write("some ") && memory.write("") && memory.write("bytes"));
  EXPECT_EQ(memory.take(), "some bytes");
  EXPECT_EQ(memory.bytes(), "");
}

TEST_F(Sink, MemoryThatRunsOutIsReported) {
  // No string holds as many bytes as this view claims, and it is refused before one of them is read.
  const std::string_view endless("x", std::string().max_size() + 1);
  MemorySink memory("memory");
  const auto written = memory.write(endless);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::device);
  EXPECT_EQ(written.error().message, "memory: has more bytes than memory can hold");
}

}  // namespace
}  // namespace vorpipe::test
