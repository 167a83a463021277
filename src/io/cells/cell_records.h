/// One record after the other out of a Diagram, and into a file.
#pragma once

#include <string_view>

#include "io/files/bytes.h"
#include "vorpipe.h"

namespace vorpipe {

inline std::string_view statusWord(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::empty:
      return "empty";
    case Status::duplicate:
      break;
  }
  return "duplicate";
}

}  // namespace vorpipe
