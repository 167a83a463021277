#include "io/files/unfinished.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <utility>

namespace vorpipe {

/// A place in a list that a signal's handler can read at any moment: places are added and used again, and
/// never given back.
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

}  // namespace

Unfinished::Unfinished(std::string path) : path_(std::move(path)), slot_(hold(path_.c_str())) {}

Unfinished::~Unfinished() {
  if (slot_ == nullptr) return;
  unlink(path_.c_str());
  wasMoved();
}

bool Unfinished::moveTo(const char* target) {
  if (std::rename(path_.c_str(), target) == 0) {
    wasMoved();
    return true;
  }
  // Not for long: where it was removed on another thread, the process is ending.
  while (ending) pause();
  return false;
}

/// A handler on another thread may be reading the path: then the process ends before it is freed.
void Unfinished::wasMoved() {
  slot_->path = nullptr;
  slot_ = nullptr;
  while (ending) pause();
}

void removeUnfinished() {
  ending = true;
  for (const UnfinishedSlot* slot = slots; slot != nullptr; slot = slot->next) {
    if (const char* const path = slot->path) unlink(path);
  }
}

}  // namespace vorpipe
