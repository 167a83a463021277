#include "io/base/read_log.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "base/try.h"
#include "io/base/input_file.h"

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
  VORPIPE_VAR(file, InputFile::open(path));
  ContentHash hash;
  // On the stack, since the heap use of a run afterwards is forecast to a few percent.
  std::array<char, 1 << 16> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (;;) {
    VORPIPE_LET(count, file.readAsIs(bytes));
    hash.add({bytes.data(), count});
    if (count < bytes.size()) return hash.contents();
  }
}

namespace {

thread_local ReadLog* current_log = nullptr;

}  // namespace

ReadLog::ReadLog(Notes notes) : notes_(notes), before_(std::exchange(current_log, this)) {}
ReadLog::~ReadLog() { current_log = before_; }

ReadLog* ReadLog::current() { return current_log; }

ReadLog::Pause::Pause() : log_(std::exchange(current_log, nullptr)) {}
ReadLog::Pause::~Pause() { current_log = log_; }

std::shared_ptr<ContentHash> ReadLog::note(const std::string& path, const struct stat& status,
                                           bool is_stream) {
  if (S_ISREG(status.st_mode)) opened_.push_back({path, status.st_dev, status.st_ino});
  if (notes_ == Notes::names) return nullptr;
  if (is_stream) {
    auto stream = std::make_shared<ContentHash>();
    entries_.push_back({path, {}, stream});
    return stream;
  }
  if (std::ranges::find(entries_, path, &Entry::path) != entries_.end()) return nullptr;
  if (auto contents = contentsOf(path)) entries_.push_back({path, std::move(*contents), nullptr});
  return nullptr;
}

const std::string* ReadLog::nameOf(const std::string& path) const {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return nullptr;
  const auto found = std::ranges::find_if(opened_, [&](const File& file) {
    return file.device == status.st_dev && file.number == status.st_ino;
  });
  return found == opened_.end() ? nullptr : &found->path;
}

std::vector<LoggedFile> ReadLog::files() const {
  std::vector<LoggedFile> files;
  for (const Entry& entry : entries_)
    files.push_back({entry.path, entry.stream ? entry.stream->contents() : entry.contents});
  return files;
}

}  // namespace vorpipe
