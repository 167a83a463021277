/// Bytes made fewer by zlib (RFC 1950), as PDF and TIFF hold them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// The same bytes give the same result. Throws std::bad_alloc.
std::string deflated(std::string_view bytes);

/// Hands on what it is given as one zlib stream.
class DeflateSink final : public ByteSink {
 public:
  /// `to` outlives this. Throws std::bad_alloc.
  explicit DeflateSink(ByteSink& to);
  DeflateSink(DeflateSink&&) noexcept;
  DeflateSink& operator=(DeflateSink&&) noexcept;
  ~DeflateSink() override;

  Result<void> write(std::string_view bytes) override;
  /// Ends the stream; nothing can be written afterwards. Error (device): as write().
  Result<void> finish();

 private:
  struct Stream;
  Result<void> deflate(std::string_view bytes, bool last);

  ByteSink* to_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace vorpipe
