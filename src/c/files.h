/// Destinations of results: the caller, or a path.
#pragma once

#include <string>
#include <utility>

#include "base/try.h"
#include "c/vorpipe_c.h"
#include "io/base/byte_sink.h"
#include "io/base/output_file.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Passes bytes to the caller's function; `name` stands for the file.
inline CallbackSink sinkOf(std::string name, vorpipe_write write, void* user) {
  return {std::move(name),
          [write, user](std::string_view bytes) { return write(user, bytes.data(), bytes.size()) == 0; }};
}

/// Creates a file, lets `write` fill it, and puts it in place. Errors: those of OutputFile and of `write`.
template <class Write>
Result<void> save(const std::string& path, const Write& write) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(file.error());
  VORPIPE_TRY(write(*file));
  return file->commit();
}

}  // namespace vorpipe::c
