#include "cli/fluid_trace.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"

namespace vorpipe::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view head =
    "step,time,length,kinetic,potential,spring,energy,momentum_x,momentum_y,worst,farthest,diagrams,"
    "linear_iterations,halvings,velocity_error,seconds\n";

std::string rowOf(const FluidStep& step, bool with_times) {
  const std::string seconds = with_times ? fmt::format("{:.6f}", step.seconds) : std::string();
  const std::string error = step.velocity_error ? fmt::format("{}", *step.velocity_error) : std::string();
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", step.step, step.time, step.length,
                     step.kinetic, step.potential, step.spring, step.energy(), step.momentum.x,
                     step.momentum.y, step.worst, step.farthest, step.diagrams, step.linear_iterations,
                     step.halvings, error, seconds);
}

/// Returns the existing trace up to the step of a checkpoint.
Result<std::string> textUntil(const std::string& path, const FluidState& from) {
  VORPIPE_VAR(file, InputFile::open(path));
  auto text = readText(file);
  if (!text) return text;
  if (!text->starts_with(head)) return inputError(path + ": it is no trace of a fluid; name another file");
  const std::size_t row = text->find(fmt::format("\n{},{},", from.step, from.time));
  const std::size_t end = row == std::string::npos ? row : text->find('\n', row + 1);
  if (end == std::string::npos) {
    return inputError(
        fmt::format("{}: its trace has no step {} at time {}, which the checkpoint is of; name another file",
                    path, from.step, from.time));
  }
  text->resize(end + 1);
  return text;
}

/// A sink that discards its bytes, for a file that was already written.
class WrittenBefore final : public ByteSink {
 public:
  explicit WrittenBefore(std::string name) : ByteSink(std::move(name)) {}
  Result<void> write(std::string_view) override { return {}; }
};

}  // namespace

Result<FluidTrace> FluidTrace::open(const std::string& path, const FluidState* resumed) {
  FluidTrace trace(path);
  trace.text_ = trace.timeless_ = head;
  std::error_code none;
  if (path.empty() || resumed == nullptr || !fs::is_regular_file(path, none)) return trace;
  VORPIPE_VAR(text, textUntil(path, *resumed));
  trace.text_ = trace.timeless_ = std::move(text);
  trace.is_continued_ = true;
  return trace;
}

FluidTrace::FluidTrace(FluidTrace&& other) noexcept
    : path_(std::move(other.path_)),
      is_continued_(other.is_continued_),
      text_(std::move(other.text_)),
      timeless_(std::move(other.timeless_)),
      direct_(std::move(other.direct_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

FluidTrace::~FluidTrace() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

/// Replaces an older file, as a whole, by the trace so far; rows follow.
Result<void> FluidTrace::begin() {
  VORPIPE_VAR(file, OutputFile::create(path_));
  VORPIPE_TRY(file.write(text_));
  if (file.target().empty()) {
    direct_ = std::move(file);
    return {};
  }
  VORPIPE_TRY(file.commit());
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ >= 0) return {};
  return systemError(ErrorCode::device, path_, "cannot be written", errno);
}

Result<void> FluidTrace::append(const std::string& row) {
  if (direct_) return direct_->write(row);
  // In one call, so that no partial row remains.
  const auto written = ::write(descriptor_, row.data(), row.size());
  if (written == static_cast<::ssize_t>(row.size())) return {};
  const int code = written < 0 ? errno : ENOSPC;
  if (written > 0 && ::ftruncate(descriptor_, static_cast<::off_t>(text_.size())) != 0) {
    return systemError(ErrorCode::device, path_, "its last row is not whole", errno);
  }
  return systemError(ErrorCode::device, path_, "cannot be written", code);
}

Result<void> FluidTrace::add(const FluidStep& step) {
  if (path_.empty()) return {};
  const bool is_first = !direct_ && descriptor_ < 0;
  if (is_first && is_continued_) return begin();
  const std::string row = rowOf(step, true);
  timeless_ += rowOf(step, false);
  if (is_first) {
    text_ += row;
    return begin();
  }
  auto appended = append(row);
  if (appended) text_ += row;
  return appended;
}

Result<void> FluidTrace::finish(RunLog& log) {
  if (path_.empty()) return {};
  if (direct_) {
    VORPIPE_TRY(direct_->finish());
  }
  WrittenBefore file(path_);
  return log.noteOutput(file, [&](ByteSink& to) {
    return log.writeTimed(to, [&](bool with_times) { return with_times ? text_ : timeless_; });
  });
}

}  // namespace vorpipe::cli
