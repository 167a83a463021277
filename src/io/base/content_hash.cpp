#include "io/base/content_hash.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <array>
#include <new>

#include "io/base/input_file.h"
#include "io/base/read_log.h"

namespace vorpipe {

void ContentHash::Free::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }

ContentHash::ContentHash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_.get());
}

void ContentHash::add(std::string_view bytes) {
  XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
  bytes_ += bytes.size();
}

Contents ContentHash::contents() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return {bytes_, fmt::format("{:016x}{:016x}", hash.high64, hash.low64)};
}

Result<Contents> contentsOf(const std::string& path) {
  const ReadLog::Pause unnoted;
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  ContentHash hash;
  // On the stack, since the heap use of a run afterwards is forecast to a few percent.
  std::array<char, 1 << 16> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (;;) {
    const auto count = file->readAsIs(bytes);
    if (!count) return tl::unexpected(count.error());
    hash.add({bytes.data(), *count});
    if (*count < bytes.size()) return hash.contents();
  }
}

}  // namespace vorpipe
