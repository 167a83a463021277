/// Text in records of cells that several formats share.
#pragma once

#include <cstddef>
#include <string_view>

#include "io/base/print.h"
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

/// Appends the neighbors of a site, separated by spaces.
inline void printNeighbors(Bytes& text, const Diagram& diagram, std::size_t site) {
  const auto neighbors = diagram.cell(site).neighbors();
  join(text, neighbors.size(), " ",
       [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}"), neighbors[k]); });
}

/// Appends their shifts, each kx:ky, separated by spaces.
inline void printShifts(Bytes& text, const Diagram& diagram, std::size_t site) {
  const auto shifts = diagram.cell(site).shifts();
  join(text, shifts.size(), " ",
       [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}:{}"), shifts[k][0], shifts[k][1]); });
}

}  // namespace vorpipe
