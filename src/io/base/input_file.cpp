#include "io/base/input_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/memory_room.h"
#include "io/base/read_log.h"

namespace vorpipe {

InputFile::InputFile(int descriptor, std::string name, std::optional<std::uint64_t> size)
    : descriptor_(descriptor), name_(std::move(name)), size_(size) {}

InputFile::InputFile(InputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      name_(std::move(other.name_)),
      size_(other.size_),
      stored_size_(other.stored_size_),
      begun_(other.begun_),
      head_(other.head_),
      head_begin_(other.head_begin_),
      head_end_(other.head_end_),
      inflater_(std::move(other.inflater_)),
      hash_(std::move(other.hash_)) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(name_, other.name_);
  std::swap(size_, other.size_);
  std::swap(stored_size_, other.stored_size_);
  std::swap(begun_, other.begun_);
  std::swap(head_, other.head_);
  std::swap(head_begin_, other.head_begin_);
  std::swap(head_end_, other.head_end_);
  std::swap(inflater_, other.inflater_);
  std::swap(hash_, other.hash_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ > STDIN_FILENO) {
    ::close(descriptor_);
  }
}

Result<InputFile> InputFile::open(const std::string& path) {
  const bool standard = path == "-";
  const int descriptor = standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return systemError(ErrorCode::input, path, "cannot be read", errno);
  }
  InputFile file(descriptor, standard ? "<stdin>" : path, std::nullopt);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    return systemError(ErrorCode::input, file.name_, "cannot be read", errno);
  }
  if (S_ISDIR(status.st_mode)) {
    return inputError(file.name_ + ": is a directory; a file is needed");
  }
  if (S_ISREG(status.st_mode) && !standard) {
    file.size_ = file.stored_size_ = static_cast<std::uint64_t>(status.st_size);
  }
  if (ReadLog* log = ReadLog::current()) file.hash_ = log->note(path, status, /*is_stream=*/!file.size_);
  return file;
}

std::optional<std::uint64_t> InputFile::mostBytes() const {
  if (size_ || !stored_size_) return size_;
  return *stored_size_ * Inflater::largest_ratio;
}

Result<void> InputFile::begin() {
  begun_ = true;
  const auto got = readBytes(head_);
  if (!got) return tl::unexpected(got.error());
  head_end_ = *got;
  if (!Inflater::isGzip(std::span(head_).first(head_end_))) return {};
  auto inflater = Inflater::create();
  if (!inflater) return deviceError(fmt::format("{}: {}", name_, inflater.error().message));
  inflater_ = std::move(*inflater);
  size_ = std::nullopt;
  return {};
}

Result<std::size_t> InputFile::read(std::span<char> bytes) {
  if (!begun_) {
    VORPIPE_TRY(begin());
  }
  if (!inflater_) return readAsIs(bytes);
  return inflater_->read(
      bytes, [this](std::span<char> packed) { return readAsIs(packed); }, name_);
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
    const ssize_t got = ::read(descriptor_, bytes.data() + count, bytes.size() - count);
    if (got == 0) {
      break;
    }
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
      auto room = checkRoom(file.name(), fmt::format("first {} MB", size >> 20), 3 * size);
      if (!room) return tl::unexpected(std::move(room.error()));
    }
    text.resize(size + chunk);
    const auto got = file.read(std::span(text).subspan(size));
    if (!got) return tl::unexpected(got.error());
    text.resize(size + *got);
    if (text.size() > most) {
      return inputError(fmt::format("{}: is larger than {} MiB, which is the most for such a file",
                                    file.name(), most >> 20));
    }
    if (*got < chunk) return text;
  }
}

}  // namespace vorpipe
