#include "io/base/read_log.h"

#include <algorithm>
#include <utility>

namespace vorpipe {
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
  if (is_stream) return entries_.emplace_back(Entry{path, {}, std::make_shared<ContentHash>()}).stream;
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
