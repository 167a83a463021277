#include "cli/run_log.h"

#include <utility>

namespace vorpipe::cli {
namespace {

/// Hashes the bytes that it passes on.
class HashingSink final : public ByteSink {
 public:
  explicit HashingSink(ByteSink& to) : ByteSink(to.name()), to_(to) {}
  Result<void> write(std::string_view bytes) override {
    hash_.add(bytes);
    return to_.write(bytes);
  }
  [[nodiscard]] Contents contents() const { return hash_.contents(); }

 private:
  ByteSink& to_;
  ContentHash hash_;
};

}  // namespace

RunLog::RunLog(const Invocation& invocation, bool stats_wanted)
    : invocation_(invocation),
      hashes_(stats_wanted || invocation.stats != nullptr),
      reads_(hashes_ ? ReadLog::Notes::contents : ReadLog::Notes::names) {}

void RunLog::noteTimeless(std::string_view text) {
  if (!hashes_) return;
  ContentHash hash;
  hash.add(text);
  timeless_ = hash.contents().xxh128;
}

Result<void> RunLog::noteOutput(ByteSink& to, const std::function<Result<void>(ByteSink&)>& write) {
  if (!hashes_) return write(to);
  HashingSink hashing(to);
  auto written = write(hashing);
  if (written) outputs_.push_back({{to.name(), hashing.contents()}, std::exchange(timeless_, {})});
  return written;
}

}  // namespace vorpipe::cli
