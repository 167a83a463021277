/// What calls of the interface of C share: a few objects of each kind, a session, numbers that may be wrong.
#pragma once

#include <array>

#include "byte_stream.h"
#include "c/vorpipe_c.h"

namespace vorpipe::fuzz {

template <class Handle>
using Free = void (*)(Handle*);

/// A few objects of a kind; a slot may be empty, and is NULL then.
template <class Handle, Free<Handle> release>
class Shelf {
 public:
  Shelf() = default;
  Shelf(const Shelf&) = delete;
  Shelf& operator=(const Shelf&) = delete;
  ~Shelf() {
    for (Handle* handle : slots_) release(handle);
  }
  Handle* get(ByteStream& stream) const { return slots_[stream.choice(slots)]; }
  void put(ByteStream& stream, Handle* handle) {
    Handle*& slot = slots_[stream.choice(slots)];
    release(slot);
    slot = handle;
  }

 private:
  static constexpr std::size_t slots = 3;
  std::array<Handle*, slots> slots_{};
};

struct Shelves {
  Shelf<vorpipe_input, vorpipe_input_free> inputs;
  Shelf<vorpipe_diagram, vorpipe_diagram_free> diagrams;
  Shelf<vorpipe_picture, vorpipe_picture_free> pictures;
  Shelf<vorpipe_locator, vorpipe_locator_free> locators;
  Shelf<vorpipe_relaxation, vorpipe_relaxation_free> relaxations;
  Shelf<vorpipe_transported, vorpipe_transported_free> transported;
  Shelf<vorpipe_fluid, vorpipe_fluid_free> fluids;
};

/// The backend `cpu`, on one thread.
vorpipe_session* librarySession();

/// What a code promises: done, or a line that says what is wrong.
void told(vorpipe_code code);

/// Less one for each call, it asks to stop when none is left: `user` is an int.
int32_t takeBytes(void* user, const void* bytes, size_t count);
int32_t stopSometimes(void* user, const char* stage, double fraction);

/// Options of the size that they have, or of one that is refused.
template <class Options>
const Options* optional(ByteStream& stream, Options& options) {
  const std::size_t kind = stream.choice(8);
  if (kind == 0) return nullptr;
  options.struct_size = kind == 1 ? 0 : static_cast<std::uint32_t>(sizeof options);
  return &options;
}

inline int32_t smallNumber(ByteStream& stream) { return static_cast<int32_t>(stream.choice(7)) - 1; }

/// Relaxes, transports, lets flow.
void move(ByteStream& stream, Shelves& shelves);

}  // namespace vorpipe::fuzz
