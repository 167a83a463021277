#include "io/base/inflater.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "io/base/error.h"

namespace vorpipe {
namespace {

constexpr std::size_t packed_size = std::size_t{1} << 16;
/// The largest window, with header and checksums of gzip.
constexpr int gzip_window = 15 + 16;

Bytef* bytesOf(char* bytes) { return reinterpret_cast<Bytef*>(bytes); }

}  // namespace

void Inflater::Free::operator()(z_stream_s* stream) const {
  inflateEnd(stream);
  delete stream;
}

Inflater::Inflater(std::unique_ptr<z_stream_s, Free> stream)
    : stream_(std::move(stream)), packed_(packed_size) {}

bool Inflater::isGzip(std::span<const char> bytes) {
  return bytes.size() >= 2 && bytes[0] == '\x1F' && bytes[1] == '\x8B';
}

Result<Inflater> Inflater::create() {
  auto stream = std::make_unique<z_stream_s>();
  if (inflateInit2(stream.get(), gzip_window) != Z_OK) return deviceError("out of memory");
  return Inflater(std::unique_ptr<z_stream_s, Free>(stream.release()));
}

Result<bool> Inflater::refill(const Source& source) {
  const auto got = source(packed_);
  if (!got) return tl::unexpected(got.error());
  stream_->next_in = bytesOf(packed_.data());
  stream_->avail_in = static_cast<uInt>(*got);
  return *got > 0;
}

Result<std::size_t> Inflater::read(std::span<char> bytes, const Source& source, const std::string& name) {
  std::size_t count = 0;
  while (count < bytes.size()) {
    if (stream_->avail_in == 0) {
      const auto more = refill(source);
      if (!more) return tl::unexpected(more.error());
      if (!*more && between_) return count;
      if (!*more) return inputError(name + ": is truncated: its gzip data end too early");
    }
    if (std::exchange(between_, false)) inflateReset(stream_.get());
    const std::size_t room = std::min<std::size_t>(bytes.size() - count, std::numeric_limits<uInt>::max());
    stream_->next_out = bytesOf(bytes.data() + count);
    stream_->avail_out = static_cast<uInt>(room);
    const int code = inflate(stream_.get(), Z_NO_FLUSH);
    count += room - stream_->avail_out;
    if (code == Z_MEM_ERROR) return deviceError(name + ": out of memory");
    if (code == Z_STREAM_END) {
      between_ = true;
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      return inputError(fmt::format("{}: its gzip data are damaged: {}", name,
                                    stream_->msg == nullptr ? "cannot be inflated" : stream_->msg));
    }
  }
  return count;
}

}  // namespace vorpipe
