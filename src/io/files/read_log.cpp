#include "io/files/read_log.h"

#include <algorithm>
#include <utility>

namespace vorpipe {
namespace {

thread_local ReadLog* current_log = nullptr;

}  // namespace

ReadLog::ReadLog() : before_(std::exchange(current_log, this)) {}
ReadLog::~ReadLog() { current_log = before_; }

ReadLog* ReadLog::current() { return current_log; }

ReadLog::Pause::Pause() : log_(std::exchange(current_log, nullptr)) {}
ReadLog::Pause::~Pause() { current_log = log_; }

void ReadLog::note(const std::string& path) {
  if (std::ranges::find(entries_, path, &Entry::path) != entries_.end()) return;
  if (auto contents = contentsOf(path)) entries_.push_back({path, std::move(*contents), nullptr});
}

std::shared_ptr<ContentHash> ReadLog::noteStream(const std::string& path) {
  return entries_.emplace_back(Entry{path, {}, std::make_shared<ContentHash>()}).stream;
}

std::vector<LoggedFile> ReadLog::files() const {
  std::vector<LoggedFile> files;
  for (const Entry& entry : entries_)
    files.push_back({entry.path, entry.stream ? entry.stream->contents() : entry.contents});
  return files;
}

}  // namespace vorpipe
