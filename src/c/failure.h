/// How functions of vorpipe_c.h fail: a code, and a message that the thread keeps.
#pragma once

#include <exception>
#include <new>
#include <string_view>

#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Keeps what vorpipe_last_error() and vorpipe_last_subject() return; returns the code. Takes no memory.
vorpipe_code fail(vorpipe_code code, std::string_view message, Subject subject = Subject::none) noexcept;
vorpipe_code fail(const Error& error);

/// VORPIPE_DEVICE: there is no memory, not even for a message.
vorpipe_code outOfMemory() noexcept;

/// Runs what may throw. No exception leaves the library.
template <class Body>
vorpipe_code guarded(const Body& body) noexcept {
  try {
    try {
      return body();
    } catch (const std::bad_alloc&) {
      return outOfMemory();
    } catch (const std::exception& error) {
      return fail(VORPIPE_DEVICE, error.what());
    }
  } catch (...) {
    return outOfMemory();  // for the message
  }
}

/// VORPIPE_INPUT: a pointer that must lead somewhere is NULL.
vorpipe_code missing(std::string_view argument) noexcept;

/// The code of something that was done, or why it was not.
inline vorpipe_code codeOf(const Result<void>& done) { return done ? VORPIPE_DONE : fail(done.error()); }

}  // namespace vorpipe::c
