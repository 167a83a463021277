#include "io/pictures/deflate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <new>

#include "base/try.h"

namespace vorpipe {

std::string deflated(std::string_view bytes) {
  MemorySink memory("");
  DeflateSink sink(memory);
  if (!sink.write(bytes) || !sink.finish()) throw std::bad_alloc();
  return memory.take();
}

struct DeflateSink::Stream {
  z_stream z{};
  std::array<char, std::size_t{1} << 16> piece;

  Stream() {
    // Higher levels make lines of numbers a few percent smaller, in twice the time.
    constexpr int level = 5;
    if (deflateInit(&z, level) != Z_OK) throw std::bad_alloc();
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { deflateEnd(&z); }
};

DeflateSink::DeflateSink(ByteSink& to) : ByteSink(to.name()), to_(to), stream_(new Stream) {}
DeflateSink::~DeflateSink() = default;

Result<void> DeflateSink::deflate(std::string_view bytes, bool last) {
  auto& [z, piece] = *stream_;
  // zlib does not write to its input, despite its types.
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  do {
    z.next_out = reinterpret_cast<Bytef*>(piece.data());
    z.avail_out = static_cast<uInt>(piece.size());
    [[maybe_unused]] const int code = ::deflate(&z, last ? Z_FINISH : Z_NO_FLUSH);
    assert(code != Z_STREAM_ERROR);
    const std::size_t count = piece.size() - z.avail_out;
    VORPIPE_TRY(to_.write({piece.data(), count}));
  } while (z.avail_out == 0);
  return {};
}

Result<void> DeflateSink::write(std::string_view bytes) {
  constexpr std::size_t most = std::numeric_limits<uInt>::max();
  for (; !bytes.empty(); bytes.remove_prefix(std::min(most, bytes.size()))) {
    VORPIPE_TRY(deflate(bytes.substr(0, most), /*last=*/false));
  }
  return {};
}

Result<void> DeflateSink::finish() { return deflate({}, /*last=*/true); }

}  // namespace vorpipe
