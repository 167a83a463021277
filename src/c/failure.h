/// How functions of vorpipe_c.h fail: a code, and a message that the thread keeps.
#pragma once

#include <exception>
#include <new>
#include <string_view>

#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Stores what vorpipe_last_error() and vorpipe_last_subject() return; returns the code. Allocates no memory.
vorpipe_code fail(vorpipe_code code, std::string_view message, Subject subject = Subject::none) noexcept;
vorpipe_code fail(const Error& error);

/// Fails with VORPIPE_DEVICE: there is no memory, not even for a message.
vorpipe_code outOfMemory() noexcept;

/// Runs a function that may throw. No exception leaves the library.
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

/// Fails with VORPIPE_INPUT: a required pointer is NULL.
vorpipe_code missing(std::string_view argument) noexcept;

/// Returns the code of a finished action, or fails with its error.
inline vorpipe_code codeOf(const Result<void>& done) { return done ? VORPIPE_DONE : fail(done.error()); }

}  // namespace vorpipe::c
