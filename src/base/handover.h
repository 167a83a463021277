/// Annotates loops on several threads for the thread sanitizer (the preset tsan).
#pragma once

#if defined(VORPIPE_TELLS_TSAN)
#include <sanitizer/tsan_interface.h>
#endif

namespace vorpipe {

/// Lives as long as a loop, which passes from the thread that begins it to those that share it, and back.
/// oneTBB passes it in code that is not compiled for the sanitizer. Without annotations the sanitizer would
/// report everything that a loop reads and writes as races. It gets only this information: whatever precedes
/// the loop precedes each range, and each range precedes whatever follows the loop, or where it threw. Ranges
/// have no order among each other, so races between them are found. Does nothing in builds without the
/// sanitizer.
class Handover {
 public:
#if defined(VORPIPE_TELLS_TSAN)
  Handover() { __tsan_release(&begun_); }
  ~Handover() { __tsan_acquire(&ended_); }
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;

  /// Lives as long as a range is computed.
  class Range {
   public:
    explicit Range(Handover& loop) : loop_(loop) { __tsan_acquire(&loop_.begun_); }
    ~Range() { __tsan_release(&loop_.ended_); }
    Range(const Range&) = delete;
    Range& operator=(const Range&) = delete;

   private:
    Handover& loop_;
  };

 private:
  char begun_ = 0, ended_ = 0;  ///< only their addresses are used
#else
  struct Range {
    explicit Range(Handover& /*loop*/) {}
  };
#endif
};

}  // namespace vorpipe
