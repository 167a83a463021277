/// Cells computed with 320-bit numbers, then with 1,280-bit ones.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "backend/cpu/tree.h"

namespace vorpipe::cpu {

class LongFinder {
 public:
  /// Keeps references to both.
  LongFinder(const SiteSet& sites, const SiteTree& tree);
  ~LongFinder();
  LongFinder(const LongFinder&) = delete;
  LongFinder& operator=(const LongFinder&) = delete;

  /// As CellFinder::find(), but never open: whatever the most bits cannot distinguish is a tie.
  CellStatus find(std::uint32_t site, std::vector<std::int32_t>& neighbors);

 private:
  struct Finders;
  std::unique_ptr<Finders> finders_;
};

}  // namespace vorpipe::cpu
