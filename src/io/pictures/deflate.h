/// Compresses bytes with zlib (RFC 1950), as PDF and TIFF use it.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// The same bytes give the same result. Throws std::bad_alloc.
std::string deflated(std::string_view bytes);

/// Compresses the bytes written into one zlib stream and passes it on.
class DeflateSink final : public ByteSink {
 public:
  /// `to` must outlive this. Throws std::bad_alloc.
  explicit DeflateSink(ByteSink& to);
  ~DeflateSink() override;

  Result<void> write(std::string_view bytes) override;
  /// Ends the stream; nothing can be written afterwards. Error (device): as write().
  Result<void> finish();

 private:
  struct Stream;
  Result<void> deflate(std::string_view bytes, bool last);

  ByteSink& to_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace vorpipe
