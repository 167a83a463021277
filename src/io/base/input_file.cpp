#include "io/base/input_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/read_log.h"

namespace vorpipe {

struct InputFile::Inflater {
  z_stream stream{};
  std::vector<char> packed;
  bool between = false;  ///< one of several gzip files has ended

  Inflater() : packed(std::size_t{1} << 16) {}
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream); }
};

InputFile::Descriptor::Descriptor(Descriptor&& other) noexcept : number(std::exchange(other.number, -1)) {}

InputFile::Descriptor& InputFile::Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number, other.number);
  return *this;
}

InputFile::Descriptor::~Descriptor() {
  if (number > STDIN_FILENO) ::close(number);
}

InputFile::InputFile(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
InputFile::InputFile(InputFile&& other) noexcept = default;
InputFile& InputFile::operator=(InputFile&& other) noexcept = default;
InputFile::~InputFile() = default;

Result<InputFile> InputFile::open(const std::string& path) {
  const bool standard = path == "-";
  const int descriptor = standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return systemError(ErrorCode::input, path, "cannot be read", errno);
  InputFile file(descriptor, standard ? "<stdin>" : path);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    return systemError(ErrorCode::input, file.name_, "cannot be read", errno);
  }
  if (S_ISDIR(status.st_mode)) return inputError(file.name_ + ": is a directory; a file is needed");
  if (S_ISREG(status.st_mode) && !standard) {
    file.size_ = file.stored_size_ = static_cast<std::uint64_t>(status.st_size);
  }
  if (ReadLog* log = ReadLog::current()) file.hash_ = log->note(path, status, /*is_stream=*/!file.size_);
  return file;
}

std::optional<std::uint64_t> InputFile::mostBytes() const {
  if (size_ || !stored_size_) return size_;
  return *stored_size_ * largest_inflation;
}

Result<void> InputFile::begin() {
  constexpr int gzip_window = 15 + 16;  // the largest window, with header and checksums of gzip
  begun_ = true;
  VORPIPE_LET(got, readBytes(head_));
  head_end_ = got;
  if (head_end_ < head_.size() || head_[0] != '\x1F' || head_[1] != '\x8B') return {};
  inflater_ = std::make_unique<Inflater>();
  if (inflateInit2(&inflater_->stream, gzip_window) != Z_OK) return deviceError(name_ + ": out of memory");
  size_ = std::nullopt;
  return {};
}

Result<std::size_t> InputFile::read(std::span<char> bytes) {
  if (!begun_) {
    VORPIPE_TRY(begin());
  }
  return inflater_ ? inflate(bytes) : readAsIs(bytes);
}

/// Fills `bytes` unless the file ends first. Concatenated gzip files count as one.
Result<std::size_t> InputFile::inflate(std::span<char> bytes) {
  auto& [stream, packed, between] = *inflater_;
  std::size_t count = 0;
  while (count < bytes.size()) {
    if (stream.avail_in == 0) {
      VORPIPE_LET(got, readAsIs(packed));
      if (got == 0 && between) return count;
      if (got == 0) return inputError(name_ + ": is truncated: its gzip data end too early");
      stream.next_in = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_in = static_cast<uInt>(got);
    }
    if (std::exchange(between, false)) inflateReset(&stream);
    const std::size_t room = std::min<std::size_t>(bytes.size() - count, std::numeric_limits<uInt>::max());
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + count);
    stream.avail_out = static_cast<uInt>(room);
    const int code = ::inflate(&stream, Z_NO_FLUSH);
    count += room - stream.avail_out;
    if (code == Z_MEM_ERROR) return deviceError(name_ + ": out of memory");
    if (code == Z_STREAM_END) {
      between = true;
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      return inputError(fmt::format("{}: its gzip data are damaged: {}", name_,
                                    stream.msg == nullptr ? "cannot be inflated" : stream.msg));
    }
  }
  return count;
}

/// Returns the head first, which was already read.
Result<std::size_t> InputFile::readAsIs(std::span<char> bytes) {
  const std::size_t known = std::min(head_end_ - head_begin_, bytes.size());
  std::copy_n(head_.begin() + static_cast<std::ptrdiff_t>(head_begin_), known, bytes.begin());
  head_begin_ += known;
  return readBytes(bytes.subspan(known)).map([known](std::size_t count) { return known + count; });
}

Result<std::size_t> InputFile::readBytes(std::span<char> bytes) {
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t got = ::read(descriptor_.number, bytes.data() + count, bytes.size() - count);
    if (got == 0) break;
    if (got > 0) {
      if (hash_) hash_->add({bytes.data() + count, static_cast<std::size_t>(got)});
      count += static_cast<std::size_t>(got);
    } else if (errno != EINTR) {
      return systemError(ErrorCode::device, name_, "reading failed", errno);
    }
  }
  return count;
}

Result<std::string> readText(InputFile& file, std::size_t most) {
  constexpr std::size_t chunk = std::size_t{1} << 20;
  std::string text;
  while (true) {
    const std::size_t size = text.size();
    // Growing a text copies it.
    if (size == text.capacity()) {
      VORPIPE_TRY(checkRoom(file.name(), fmt::format("first {} MB", size >> 20), 3 * size));
    }
    text.resize(size + chunk);
    VORPIPE_LET(got, file.read(std::span(text).subspan(size)));
    text.resize(size + got);
    if (text.size() > most) {
      return inputError(fmt::format("{}: is larger than {} MiB, which is the most for such a file",
                                    file.name(), most >> 20));
    }
    if (got < chunk) return text;
  }
}

Result<void> checkRoom(std::string_view name, std::string_view what, std::uint64_t bytes) {
  constexpr double gigabyte = 1e9;
  const MemoryLimit limit = systemMemoryLimit();
  if (bytes <= limit.bytes) return {};
  return inputError(fmt::format("{}: its {} need about {:.1f} GB of memory, {:.1f} GB are {}", name, what,
                                static_cast<double>(bytes) / gigabyte,
                                static_cast<double>(limit.bytes) / gigabyte, limit.what));
}

}  // namespace vorpipe
