#include "io/base/unfinished.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <utility>

namespace vorpipe {

/// A slot in a list that a signal handler can read at any moment: slots are added and reused, but never
/// freed.
struct UnfinishedSlot {
  std::atomic<const char*> path{nullptr};
  UnfinishedSlot* next = nullptr;
};

namespace {

std::atomic<UnfinishedSlot*> slots{nullptr};
std::atomic<bool> ending{false};  ///< removeUnfinished was called
static_assert(std::atomic<const char*>::is_always_lock_free && decltype(slots)::is_always_lock_free,
              "signal handlers use them");

UnfinishedSlot* hold(const char* path) {
  for (UnfinishedSlot* slot = slots; slot != nullptr; slot = slot->next) {
    const char* none = nullptr;
    if (slot->path.compare_exchange_strong(none, path)) return slot;
  }
  auto* const slot = new UnfinishedSlot;
  slot->path = path;
  slot->next = slots;
  while (!slots.compare_exchange_weak(slot->next, slot)) {
  }
  return slot;
}

/// Waits, briefly, while a handler on another thread ends the process.
void waitForEnd() {
  while (ending) pause();
}

}  // namespace

Unfinished::Unfinished(std::string path) : path_(std::move(path)), slot_(hold(path_.c_str())) {}

/// A handler on another thread may be reading the path: then the process ends before the path is freed.
Unfinished::~Unfinished() {
  if (is_there_) unlink(path_.c_str());
  slot_->path = nullptr;
  waitForEnd();
}

int Unfinished::create(unsigned mode) {
  const int descriptor = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  is_there_ = descriptor >= 0;
  if (is_there_ && ending) {
    unlink(path_.c_str());
    waitForEnd();
  }
  return descriptor;
}

bool Unfinished::linkTo(const char* old) {
  is_there_ = link(old, path_.c_str()) == 0;
  if (is_there_ && ending) {
    unlink(path_.c_str());
    waitForEnd();
  }
  return is_there_;
}

bool Unfinished::moveTo(const char* target) {
  is_there_ = std::rename(path_.c_str(), target) != 0;
  // Another thread may have removed it.
  if (is_there_) waitForEnd();
  return !is_there_;
}

void removeUnfinished() {
  ending = true;
  for (const UnfinishedSlot* slot = slots; slot != nullptr; slot = slot->next) {
    if (const char* const path = slot->path) unlink(path);
  }
}

}  // namespace vorpipe
