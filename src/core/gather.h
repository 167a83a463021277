/// Cells found here and there, put together.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

inline bool isDone(CellStatus status) {
  return status == CellStatus::certified || status == CellStatus::empty;
}

/// The neighborhoods of cells 0 to `cells` - 1, added in any order and in parts of any size.
class Gathering {
 public:
  explicit Gathering(std::size_t cells, int threads);

  /// Entry e of `found` is cell which[e]; an earlier answer for a cell is forgotten.
  void add(std::span<const std::uint32_t> which, Neighborhoods found);

  /// All cells in order; `missing` what was never added.
  [[nodiscard]] Neighborhoods finish() const;

  /// The same, each neighborhood turned as beginAtFirst has it.
  [[nodiscard]] Neighborhoods finishFromFirst(const SiteSet& sites) const;

 private:
  template <class Copy>
  [[nodiscard]] Neighborhoods finishWith(const Copy& copy) const;

  struct Place {
    std::uint32_t part, entry;
  };
  std::vector<Neighborhoods> parts_;
  BigVector<Place> places_;  ///< by cell
  int threads_;
};

/// The sites among `which` whose entries in `status` have one of the wanted statuses.
template <class Wanted>
std::vector<std::uint32_t> withStatus(std::span<const std::uint32_t> which,
                                      const std::vector<CellStatus>& status, const Wanted& wanted) {
  std::vector<std::uint32_t> found;
  for (std::size_t e = 0; e < which.size(); ++e) {
    if (wanted(status[e])) found.push_back(which[e]);
  }
  return found;
}

}  // namespace vorpipe
