#include "c/failure.h"

#include <fmt/core.h>

#include <utility>

namespace vorpipe::c {
namespace {

struct LastError {
  std::string message;
  bool out_of_memory = false;  ///< stands for a message that takes none
  vorpipe_subject subject = VORPIPE_SUBJECT_NONE;
};

LastError& lastError() {
  thread_local LastError error;
  return error;
}

vorpipe_subject numberOf(Subject subject) {
  switch (subject) {
    case Subject::none:
      return VORPIPE_SUBJECT_NONE;
    case Subject::sites:
      return VORPIPE_SUBJECT_SITES;
    case Subject::weights:
      return VORPIPE_SUBJECT_WEIGHTS;
    case Subject::domain:
      return VORPIPE_SUBJECT_DOMAIN;
    case Subject::outline:
      return VORPIPE_SUBJECT_OUTLINE;
    case Subject::period:
      return VORPIPE_SUBJECT_PERIOD;
    case Subject::density:
      return VORPIPE_SUBJECT_DENSITY;
    case Subject::search:
      return VORPIPE_SUBJECT_SEARCH;
    case Subject::masses:
      return VORPIPE_SUBJECT_MASSES;
  }
  return VORPIPE_SUBJECT_NONE;
}

vorpipe_code numberOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::input:
      return VORPIPE_INPUT;
    case ErrorCode::device:
      return VORPIPE_DEVICE;
    case ErrorCode::cancelled:
      return VORPIPE_CANCELLED;
  }
  return VORPIPE_DEVICE;
}

}  // namespace

vorpipe_code fail(vorpipe_code code, std::string message, Subject subject) noexcept {
  lastError() = {std::move(message), false, numberOf(subject)};
  return code;
}

vorpipe_code outOfMemory() noexcept {
  lastError().out_of_memory = true;
  lastError().subject = VORPIPE_SUBJECT_NONE;
  return VORPIPE_DEVICE;
}

vorpipe_code fail(const Error& error) { return fail(numberOf(error.code), error.message, error.subject); }

vorpipe_code missing(std::string_view argument) noexcept {
  return guarded([&] { return fail(VORPIPE_INPUT, fmt::format("{}: is NULL", argument)); });
}

}  // namespace vorpipe::c

const char* vorpipe_last_error() {
  const auto& error = vorpipe::c::lastError();
  return error.out_of_memory ? "there is not enough memory for this" : error.message.c_str();
}

vorpipe_subject vorpipe_last_subject() { return vorpipe::c::lastError().subject; }
