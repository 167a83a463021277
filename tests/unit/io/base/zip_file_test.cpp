#include "io/base/zip_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/npy_array.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

class Zip : public InTemporaryDirectory {
 protected:
  static std::string archive(const std::vector<ZipEntry>& entries) {
    MemorySink memory("a.zip");
    const auto written = writeZip(memory, entries);
    EXPECT_TRUE(written) << written.error().message;
    return memory.take();
  }
};

/// A file in which zeros take no room: they are skipped, which leaves a hole.
class FileWithHoles final : public ByteSink {
 public:
  explicit FileWithHoles(const std::string& path) : ByteSink(path), file_(path, std::ios::binary) {}
  Result<void> write(std::string_view bytes) override {
    const bool zeros = !bytes.empty() && bytes.front() == '\0' &&
                       std::memcmp(bytes.data(), bytes.data() + 1, bytes.size() - 1) == 0;
    const auto count = static_cast<std::streamoff>(bytes.size());
    if (zeros) {
      file_.seekp(count, std::ios::cur);
    } else {
      file_.write(bytes.data(), count);
    }
    return {};
  }

 private:
  std::ofstream file_;
};

TEST_F(Zip, HasTheBytesOfTheFormat) {
  using namespace std::string_view_literals;
  const auto common =  // method 0, 1980-01-01 00:00, the checksum of "hi!", its length twice, that of "a.txt"
      "\0\0\0\0\0\0\x21\0\x3A\x83\xD3\x41\x03\0\0\0\x03\0\0\0\x05\0\0\0"sv;
  std::string expected("PK\x03\x04\x0A\0"sv);
  expected.append(common).append("a.txt").append("hi!");
  expected.append("PK\x01\x02\x3F\x03\x0A\0"sv).append(common);
  expected.append("\0\0\0\0\0\0\0\0\xB6\x81\0\0\0\0"sv).append("a.txt");
  expected.append("PK\x05\x06\0\0\0\0\x01\0\x01\0\x33\0\0\0\x26\0\0\0\0\0"sv);
  EXPECT_EQ(archive({{"a.txt", "h", zipBody("i!")}}), expected);
}

TEST_F(Zip, KeepsLargeAndEmptyEntries) {
  std::string large;
  for (int i = 0; large.size() < 1'000'003; ++i) {
    large += std::to_string(i);
  }
  large.resize(1'000'003);  // no multiple of the pieces in which it is read
  write("large", large);
  write("a.zip", archive({{"a", "", zipBody(large)},
                          {"b", "", zipBody("")},
                          {"c", "head ", zipBody("body")},
                          {"d", "x", zipBody("")}}));
  if (!numpy("import subprocess, sys, zipfile\n"
             "z = zipfile.ZipFile('a.zip')\n"
             "assert z.namelist() == ['a', 'b', 'c', 'd']\n"
             "assert z.read('a') == open('large', 'rb').read()\n"
             "assert z.read('b') == b'' and z.read('c') == b'head body' and z.read('d') == b'x'\n"
             "assert all(i.date_time == (1980, 1, 1, 0, 0, 0) for i in z.infolist())\n"
             "assert all(i.compress_type == zipfile.ZIP_STORED for i in z.infolist())\n"
             "test = [sys.executable, '-m', 'zipfile', '-t', 'a.zip']\n"
             "assert subprocess.run(test, stdout=subprocess.DEVNULL).returncode == 0\n")) {
    GTEST_SKIP() << without_numpy;
  }
}

TEST_F(Zip, ReadsBodiesThatComeInPiecesOfAnySize) {
  const std::string text = "as many bytes as the body likes to give";
  const ZipBody drops{text.size(), [&](std::uint64_t offset, char* to, std::size_t length) {
                        return text.copy(to, std::min<std::size_t>(length, 1 + offset % 3), offset);
                      }};
  EXPECT_EQ(archive({{"a", "", drops}}), archive({{"a", "", zipBody(text)}}));
}

/// From 65,535 entries on their number has no room in 16 bits.
TEST_F(Zip, TellsHowManyEntriesItHas) {
  std::vector<ZipEntry> entries;
  for (int i = 0; i < 65'534; ++i) entries.push_back({std::to_string(i), "", zipBody("")});
  const std::string locator = std::string("PK\x06\x07") + std::string(4, '\0');
  for (const char* const name : {"65534.zip", "65535.zip", "65536.zip"}) {
    const std::string bytes = archive(entries);
    EXPECT_EQ(bytes.find(locator) != std::string::npos, entries.size() > 65'534) << entries.size();
    write(name, bytes);
    entries.push_back({std::to_string(entries.size()), "", zipBody("last")});
  }
  if (!numpy("import zipfile\n"
             "for count in 65534, 65535, 65536:\n"
             "    z = zipfile.ZipFile(f'{count}.zip')\n"
             "    assert z.namelist() == [str(i) for i in range(count)], count\n"
             "    assert z.read(str(count - 1)) == (b'' if count == 65534 else b'last')\n")) {
    GTEST_SKIP() << without_numpy;
  }
}

/// An entry of 2^32 - 1 bytes, the first size that 32 bits do not tell, and one that begins behind it.
TEST_F(Zip, GoesBeyondFourGibibytes) {
  constexpr std::uint64_t size = 0xFFFFFFFF, header_size = 128;
  const std::uint64_t zeros[] = {size - header_size}, three[] = {3};
  const std::string header = npyHeader("|u1", zeros);
  ASSERT_EQ(header.size(), header_size);
  const ZipBody body{zeros[0], [&](std::uint64_t offset, char* to, std::size_t length) {
                       const std::size_t count = std::min<std::uint64_t>(length, zeros[0] - offset);
                       std::memset(to, 0, count);
                       return count;
                     }};
  {
    FileWithHoles file(path("large.npz"));
    const auto written =
        writeZip(file, std::vector<ZipEntry>{{"zeros.npy", header, body},
                                             {"last.npy", npyHeader("|u1", three), zipBody("123")}});
    ASSERT_TRUE(written) << written.error().message;
  }
  if (!numpy("from numpy.lib import format\n"
             "z = np.load('large.npz')\n"
             "assert z.files == ['zeros', 'last']\n"
             "assert z['last'].tobytes() == b'123'\n"
             "zeros, last = z.zip.infolist()\n"
             "assert zeros.file_size == zeros.compress_size == 2**32 - 1\n"
             "assert zeros.extract_version == last.extract_version == 45\n"
             "assert zeros.header_offset == 0 and last.header_offset > 2**32\n"
             "with z.zip.open('zeros.npy') as file:\n"
             "    assert format.read_magic(file) == (1, 0)\n"
             "    assert format.read_array_header_1_0(file)[0] == (2**32 - 129,)\n"
             "    assert file.read(100) == bytes(100)\n")) {
    GTEST_SKIP() << without_numpy;
  }
}

}  // namespace
}  // namespace vorpipe::test
