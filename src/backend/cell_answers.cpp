#include "backend/cell_answers.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "layout.glsl"

namespace vorpipe {
namespace {

constexpr std::size_t entries_at_once = std::size_t{1} << 15;

// A word is the number of neighbors times this, plus the status.
constexpr std::uint32_t status_values = 256;

std::uint32_t wordAt(const CellAnswers& answers, std::size_t entry) {
  std::uint32_t word = 0;
  std::memcpy(&word, answers.words + entry * answers.word_stride, sizeof(word));
  return word;
}

}  // namespace

CellStatus statusIn(std::uint32_t word) {
  const std::uint32_t status = word % status_values;
  return status <= CELL_OPEN ? static_cast<CellStatus>(status) : CellStatus::missing;
}

void reserve(std::size_t entries, std::size_t room, CellNeighbors& out) {
  out.status.reserve(entries);
  out.offsets.reserve(entries + 1);
  out.neighbor.reserve(entries * room);
}

void append(const CellAnswers& answers, CellNeighbors& out) {
  if (out.offsets.empty()) out.offsets.push_back(0);
  const std::size_t before = out.status.size();
  out.status.resize(before + answers.count);
  out.offsets.resize(before + answers.count + 1);
  // The number of neighbors in each block of entries, later the index of its first neighbor.
  std::vector<std::uint64_t> block_begin((answers.count + entries_at_once - 1) / entries_at_once);
  parallelFor(answers.count, entries_at_once, 0, [&](std::size_t begin, std::size_t end) {
    std::uint64_t sum = 0;
    for (std::size_t entry = begin; entry < end; ++entry) {
      const std::uint32_t word = wordAt(answers, entry);
      const bool sane = word / status_values <= answers.room;
      const CellStatus status = sane ? statusIn(word) : CellStatus::missing;
      const bool listed = status == CellStatus::certified || status == CellStatus::empty;
      sum += listed ? word / status_values : 0;
      out.status[before + entry] = status;
      out.offsets[before + entry + 1] = sum;
    }
    block_begin[begin / entries_at_once] = sum;
  });
  std::uint64_t end_of_all = out.offsets[before];
  for (auto& sum : block_begin) end_of_all += std::exchange(sum, end_of_all);
  out.neighbor.resize(end_of_all);
  if (out.neighbor.empty()) return;
  parallelFor(answers.count, entries_at_once, 0, [&](std::size_t begin, std::size_t end) {
    const std::uint64_t block = block_begin[begin / entries_at_once];
    std::uint64_t first = block;
    for (std::size_t entry = begin; entry < end; ++entry) {
      const std::uint64_t next = block + out.offsets[before + entry + 1];
      std::memcpy(out.neighbor.data() + first, answers.rows + entry * answers.row_stride,
                  (next - first) * sizeof(std::int32_t));
      out.offsets[before + entry + 1] = next;
      first = next;
    }
  });
}

void append(const CellNeighbors& part, CellNeighbors& out) {
  if (out.offsets.empty()) out.offsets.push_back(0);
  const std::uint64_t before = out.offsets.back();
  out.status.insert(out.status.end(), part.status.begin(), part.status.end());
  for (std::size_t entry = 0; entry < part.status.size(); ++entry) {
    out.offsets.push_back(before + part.offsets[entry + 1]);
  }
  out.neighbor.insert(out.neighbor.end(), part.neighbor.begin(), part.neighbor.end());
}

}  // namespace vorpipe
