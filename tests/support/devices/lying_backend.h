/// A backend whose answers are nonsense.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include "backend/forwarding_backend.h"

namespace vorpipe::test {

/// What is wrong with an answer.
enum class Lie : std::uint8_t {
  statuses,   ///< any byte
  neighbors,  ///< numbers of no site, of no wall, of the cell itself, of other sites
  turned,     ///< rows that begin anywhere, go the other way, or belong to another cell
  counts,     ///< rows that are shorter or longer
  offsets,    ///< rows that begin anywhere
  lengths,    ///< arrays that are too short or too long
  pixels,     ///< ids of no site, any colors
};
inline constexpr std::array lies{Lie::statuses, Lie::neighbors, Lie::turned, Lie::counts,
                                 Lie::offsets,  Lie::lengths,   Lie::pixels};

/// Passes every call on to a backend and spoils about one cell or pixel in `one_in` of what it answers.
class LyingBackend final : public ForwardingBackend {
 public:
  LyingBackend(Backend& honest, Lie lie, std::uint32_t one_in, std::uint64_t seed)
      : ForwardingBackend(honest), lie_(lie), one_in_(one_in), random_(seed) {}

  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override {
    auto done = ForwardingBackend::cells(which, capacity, out);
    if (done) spoil(out);
    return done;
  }
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override {
    auto done = ForwardingBackend::cells(batch, out);
    if (done) spoil(out);
    return done;
  }
  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override {
    auto done = ForwardingBackend::draw(which, capacity, status);
    if (lie_ == Lie::statuses) spoil(status);
    return done;
  }
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
                    std::span<CellStatus> status) override {
    auto done = ForwardingBackend::draw(batch, marks, capacity, status);
    if (lie_ == Lie::statuses) spoil(status);
    return done;
  }
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    auto done = ForwardingBackend::read(rgba, ids);
    if (lie_ != Lie::pixels) return done;
    constexpr std::uint32_t many = std::uint32_t{1} << 31;
    for (auto& id : ids) {
      if (now()) id = many + number();
    }
    for (auto& color : rgba) {
      if (now()) color = number();
    }
    return done;
  }
  std::vector<std::string> validationMessages() override { return ForwardingBackend::validationMessages(); }

  [[nodiscard]] std::uint64_t told() const { return told_; }

 private:
  bool now() {
    if (random_() % one_in_ != 0) return false;
    ++told_;
    return true;
  }

  std::uint32_t number() { return static_cast<std::uint32_t>(random_()); }

  /// A number as in memory that was never written, or as of a float's bits; or one near the valid numbers.
  std::int32_t neighbor() {
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    constexpr std::array<std::int32_t, 8> odd = {
        -5,         -128,  0x7FC00000, 0x7F800000,
        0x3F800000, least, least + 1,  std::numeric_limits<std::int32_t>::max()};
    if (random_() % 2 == 0) return odd[random_() % odd.size()];
    return static_cast<std::int32_t>(random_() % 5000) - 8;
  }

  void spoil(std::span<CellStatus> status) {
    for (auto& each : status) {
      if (now()) each = static_cast<CellStatus>(random_() % (random_() % 2 == 0 ? 6 : 256));
    }
  }

  void spoil(CellNeighbors& cells) {
    switch (lie_) {
      case Lie::statuses:
        return spoil(std::span(cells.status));
      case Lie::neighbors:
        for (auto& each : cells.neighbor) {
          if (now()) each = neighbor();
        }
        return;
      case Lie::turned:
        return turn(cells);
      case Lie::counts:
        for (std::size_t e = 1; e + 1 < cells.offsets.size(); ++e) {
          if (now())
            cells.offsets[e] =
                std::max(cells.offsets[e - 1], cells.offsets[e] - std::min(cells.offsets[e], random_() % 3));
        }
        return;
      case Lie::offsets:
        for (auto& first : cells.offsets) {
          if (now()) first = random_() >> (random_() % 64);
        }
        return;
      case Lie::lengths:
        return cutOrGrow(cells);
      case Lie::pixels:
        return;
    }
  }

  void turn(CellNeighbors& cells) {
    for (std::size_t e = 0; e < cells.status.size(); ++e) {
      const auto row =
          std::span(cells.neighbor).subspan(cells.offsets[e], cells.offsets[e + 1] - cells.offsets[e]);
      if (row.empty() || !now()) continue;
      const auto which = random_() % 3;
      if (which == 0) std::rotate(row.begin(), row.begin() + 1, row.end());
      if (which == 1) std::reverse(row.begin() + 1, row.end());
      if (which == 2) {
        const auto from = random_() % (cells.neighbor.size() - row.size() + 1);
        std::copy_n(cells.neighbor.begin() + static_cast<std::ptrdiff_t>(from), row.size(), row.begin());
      }
    }
  }

  void cutOrGrow(CellNeighbors& cells) {
    if (!now()) return;
    const auto change = [&](auto& array) {
      array.resize(random_() % 2 == 0 ? array.size() / (2 + random_() % 3)
                                      : array.size() + 1 + random_() % 100);
    };
    const auto which = random_() % 4;
    if (which == 0) change(cells.status);
    if (which == 1) change(cells.offsets);
    if (which == 2) change(cells.neighbor);
    if (which == 3) cells = {};
  }

  Lie lie_;
  std::uint32_t one_in_;
  std::mt19937_64 random_;
  std::uint64_t told_ = 0;
};

}  // namespace vorpipe::test
