/// Output streams that writers of all formats append to: a file, a buffer in memory, or a callback (decision
/// D92).
#pragma once

#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "io/base/error.h"
#include "vorpipe.h"

namespace vorpipe {

/// Takes bytes in order, from first to last; it cannot go back.
class ByteSink {
 public:
  virtual ~ByteSink() = default;

  /// Appends bytes. Error (device): they were not taken. A writer then stops and returns the error.
  virtual Result<void> write(std::string_view bytes) = 0;

  /// Name that begins messages: the path of a file.
  [[nodiscard]] const std::string& name() const { return name_; }

 protected:
  explicit ByteSink(std::string name) : name_(std::move(name)) {}
  ByteSink(ByteSink&&) noexcept = default;
  ByteSink& operator=(ByteSink&&) noexcept = default;

 private:
  std::string name_;
};

/// Keeps the bytes. Error of write(): there is not enough memory for them.
class MemorySink final : public ByteSink {
 public:
  explicit MemorySink(std::string name) : ByteSink(std::move(name)) {}
  Result<void> write(std::string_view bytes) override try {
    bytes_.append(bytes);
    return {};
  } catch (const std::bad_alloc&) {
    return deviceError(name() + ": there is not enough memory for its bytes");
  } catch (const std::length_error&) {
    return deviceError(name() + ": has more bytes than memory can hold");
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  /// Returns the bytes and leaves the sink empty.
  std::string take() { return std::exchange(bytes_, {}); }

 private:
  std::string bytes_;
};

/// Passes the bytes on in nonempty pieces of any size, each valid only during the call. The callback must not
/// throw: libpng, a C library, is between it and the caller of writePng. Error of write(): the callback
/// returned false; the writer does not call it again.
class CallbackSink final : public ByteSink {
 public:
  using Callback = std::function<bool(std::string_view bytes)>;
  CallbackSink(std::string name, Callback callback)
      : ByteSink(std::move(name)), callback_(std::move(callback)) {}
  Result<void> write(std::string_view bytes) override {
    if (bytes.empty() || callback_(bytes)) return {};
    return deviceError(name() + ": writing stopped: the callback that takes its bytes returned false");
  }

 private:
  Callback callback_;
};

}  // namespace vorpipe
