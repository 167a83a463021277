/// A row of a sparse matrix, while it is summed.
#pragma once

#include <cstdint>
#include <vector>

namespace vorpipe::moving {

/// A hash table of columns. Nearby columns have nearby slots.
class RowSum {
 public:
  struct Entry {
    std::uint32_t column;
    double value;
  };

  RowSum() : places_(128, none) {}

  void add(std::uint32_t column, double value) {
    auto place = column & (places_.size() - 1);
    while (places_[place] != none) {
      auto& entry = entries_[places_[place]];
      if (entry.column == column) {
        entry.value += value;
        return;
      }
      place = (place + 1) & (places_.size() - 1);
    }
    places_[place] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({column, value});
    if (entries_.size() * 2 > places_.size()) grow();
  }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  void clear() {
    if (entries_.size() * 8 > places_.size()) {
      places_.assign(places_.size(), none);
    } else {
      for (const auto& entry : entries_) {
        auto place = entry.column & (places_.size() - 1);
        while (places_[place] != none) {
          places_[place] = none;
          place = (place + 1) & (places_.size() - 1);
        }
      }
    }
    entries_.clear();
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  void grow() {
    places_.assign(places_.size() * 2, none);
    for (std::uint32_t k = 0; k < entries_.size(); ++k) {
      auto place = entries_[k].column & (places_.size() - 1);
      while (places_[place] != none) place = (place + 1) & (places_.size() - 1);
      places_[place] = k;
    }
  }

  std::vector<std::uint32_t> places_;
  std::vector<Entry> entries_;
};

}  // namespace vorpipe::moving
