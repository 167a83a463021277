/// What the thread sanitizer (the preset tsan) is told about loops on several threads.
#pragma once

#if defined(VORPIPE_TELLS_TSAN)
#include <sanitizer/tsan_interface.h>
#endif

namespace vorpipe {

/// Lives as long as a loop, which goes from the thread that begins it to those that share it, and back.
/// oneTBB hands it over in code that is not compiled for the sanitizer, which would take all that a loop
/// reads and writes for races. It is told this much and no more: what was done before the loop precedes each
/// range, and each range precedes what is done after the loop, or where it threw. Between two ranges there is
/// no order, so that races between them are found. In builds without the sanitizer it does nothing.
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
  char begun_ = 0, ended_ = 0;  ///< their addresses alone are used
#else
  struct Range {
    explicit Range(Handover& /*loop*/) {}
  };
#endif
};

}  // namespace vorpipe
