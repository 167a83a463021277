#include "space/rows.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <unordered_map>

namespace vorpipe::space {
namespace {

/// What a row begins with; then its neighbors.
struct Header {
  std::uint32_t faces, edge_ends;
  [[nodiscard]] bool isSmall() const { return faces < 256; }
};

// White noise has 15.5 faces and 81 ends of edges on average.
constexpr std::size_t neighbor_bytes = sizeof(Header) + 16 * sizeof(Label), ring_bytes = 17 * 2 + 84;

Label* neighborsAt(std::byte* at) { return reinterpret_cast<Label*>(at + sizeof(Header)); }

template <class Number, class Entry>
struct Rings {
  Number* begin;
  Entry* ring;
  Rings(std::byte* at, std::size_t faces)
      : begin(reinterpret_cast<Number*>(at)), ring(reinterpret_cast<Entry*>(begin + faces + 1)) {}
};
using Small = Rings<std::uint16_t, std::uint8_t>;
using Large = Rings<std::uint32_t, std::uint32_t>;

/// By face and by one of its ring: the one that follows. Entries of other cells may be left in it: a ring is
/// as long as the number of its vertices.
struct Followers {
  std::uint8_t next[64][64];
};

}  // namespace

std::span<std::byte> BlockPool::take(std::size_t bytes) {
  const std::size_t size = std::max(block, bytes);
  const std::scoped_lock lock(mutex_);
  if (size <= region_.size() - used_) {
    used_ += size;
    return std::span(region_).subspan(used_ - size, size);
  }
  others_.push_back(std::make_unique_for_overwrite<std::byte[]>(size));
  return {others_.back().get(), size};
}

std::byte* RowArena::get(std::span<std::byte>& left, std::size_t bytes, BlockPool& pool) {
  bytes = (bytes + 7) / 8 * 8;
  if (bytes > left.size()) left = pool.take(bytes);
  std::byte* const at = left.data();
  left = left.subspan(bytes);
  return at;
}

Rows::Rows(std::size_t sites, std::span<const std::uint32_t> input)
    : input_(input),
      at_(sites),
      neighbor_pool_(std::make_unique<BlockPool>(sites * neighbor_bytes / 8 * 8)),
      ring_pool_(std::make_unique<BlockPool>(sites * ring_bytes / 8 * 8)) {}

Row Rows::operator[](std::size_t site) const {
  const At& at = at_[site];
  if (at.neighbors == nullptr) return {};
  Header header;
  std::memcpy(&header, at.neighbors, sizeof header);
  Row row;
  row.faces = header.faces;
  row.edge_ends = header.edge_ends;
  row.neighbor = neighborsAt(at.neighbors);
  if (header.isSmall()) {
    const Small rings(at.rings, header.faces);
    row.small_begin = rings.begin;
    row.small = rings.ring;
  } else {
    const Large rings(at.rings, header.faces);
    row.large_begin = rings.begin;
    row.large = rings.ring;
  }
  return row;
}

std::size_t Rows::faceOf(const Row& row, Label label) const {
  constexpr std::uint32_t most_to_look_through = 64;
  if (row.faces <= most_to_look_through) return row.faceOf(label);
  const auto key = [this](Label of) { return keyOf(of); };
  const auto* const at = std::ranges::lower_bound(row.neighbors(), keyOf(label), {}, key).base();
  return at != row.neighbor + row.faces && *at == label ? static_cast<std::size_t>(at - row.neighbor)
                                                        : row.faces;
}

/// Gives a row its memory, has its neighbors and rings written, and keeps it if they are whole.
template <class Number, class Entry, class Write>
bool Rows::write(std::size_t site, std::uint32_t faces, std::size_t vertices, RowArena& arena,
                 const Write& write) {
  const Header header{faces, static_cast<std::uint32_t>(3 * vertices)};
  At at;
  at.neighbors = RowArena::get(arena.neighbors_, sizeof header + faces * sizeof(Label), *neighbor_pool_);
  at.rings = RowArena::get(arena.rings_, (faces + 1) * sizeof(Number) + header.edge_ends * sizeof(Entry),
                           *ring_pool_);
  std::memcpy(at.neighbors, &header, sizeof header);
  const bool whole = write(neighborsAt(at.neighbors), Rings<Number, Entry>(at.rings, faces));
  at_[site] = whole ? at : At{};
  return whole;
}

template <bool from_least, class Vertex>
bool Rows::setSmall(std::size_t site, std::span<const Label> neighbors, const Vertex* vertices,
                    std::size_t vertex_count, RowArena& arena) {
  const std::size_t faces = neighbors.size();
  if (faces < 4) {
    clear(site);
    return false;
  }
  std::int32_t key[64];
  for (std::size_t f = 0; f < faces; ++f) key[f] = keyOf(neighbors[f]);
  std::uint8_t rank[64];
  for (std::size_t f = 0; f < faces; ++f) {
    int less = 0;
    for (std::size_t g = 0; g < f; ++g) less += key[g] <= key[f] ? 1 : 0;
    for (std::size_t g = f + 1; g < faces; ++g) less += key[g] < key[f] ? 1 : 0;
    rank[f] = static_cast<std::uint8_t>(less);
  }
  thread_local Followers followers;
  std::uint8_t size[64] = {}, first[64];
  constexpr std::uint8_t none = 255;
  if (from_least) {
    std::memset(first, none, sizeof first);
    std::memset(followers.next, none, faces * sizeof followers.next[0]);
  }
  const auto begin = [&first](std::uint8_t face, std::uint8_t with) {
    first[face] = from_least ? std::min(first[face], with) : with;
  };
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::uint8_t a = rank[vertices[v][0]], b = rank[vertices[v][1]], c = rank[vertices[v][2]];
    followers.next[a][b] = c;
    followers.next[b][c] = a;
    followers.next[c][a] = b;
    ++size[a];
    ++size[b];
    ++size[c];
    begin(a, b);
    begin(b, c);
    begin(c, a);
  }
  return write<std::uint16_t, std::uint8_t>(site, static_cast<std::uint32_t>(faces), vertex_count, arena,
                                            [&](Label* neighbor, const Small& rings) {
                                              for (std::size_t f = 0; f < faces; ++f)
                                                neighbor[rank[f]] = neighbors[f];
                                              std::size_t end = 0;
                                              for (std::size_t f = 0; f < faces; ++f) {
                                                rings.begin[f] = static_cast<std::uint16_t>(end);
                                                if (size[f] < 3) return false;
                                                std::uint8_t at_face = first[f];
                                                for (std::size_t k = 0; k < size[f]; ++k) {
                                                  rings.ring[end++] = at_face;
                                                  at_face = followers.next[f][at_face & 63];
                                                  if (from_least && at_face == none) break;
                                                }
                                                if (at_face != first[f]) return false;
                                              }
                                              rings.begin[faces] = static_cast<std::uint16_t>(end);
                                              return true;
                                            });
}

bool Rows::set(std::size_t site, std::span<const Label> neighbors, const std::uint8_t (*vertices)[4],
               std::size_t vertex_count, RowArena& arena) {
  return setSmall<false>(site, neighbors, vertices, vertex_count, arena);
}

bool Rows::set(std::size_t site, std::span<const Label> neighbors,
               std::span<const std::array<std::uint32_t, 3>> vertices, RowArena& arena) {
  const std::size_t faces = neighbors.size();
  if (faces <= 64) return setSmall<true>(site, neighbors, vertices.data(), vertices.size(), arena);
  std::vector<std::uint32_t> order(faces), rank(faces);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t f) { return keyOf(neighbors[f]); });
  for (std::uint32_t r = 0; r < faces; ++r) rank[order[r]] = r;
  std::unordered_map<std::uint64_t, std::uint32_t> next;
  next.reserve(3 * vertices.size());
  std::vector<std::uint32_t> size(faces, 0), first(faces, UINT32_MAX);
  const auto keyOfPair = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; };
  for (const auto& v : vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = rank[v[k]], b = rank[v[(k + 1) % 3]], c = rank[v[(k + 2) % 3]];
      next[keyOfPair(a, b)] = c;
      ++size[a];
      first[a] = std::min(first[a], b);
    }
  }
  const auto fill = [&](Label* neighbor, const auto& rings) {
    using Number = std::remove_reference_t<decltype(*rings.begin)>;
    using Entry = std::remove_reference_t<decltype(*rings.ring)>;
    for (std::uint32_t r = 0; r < faces; ++r) neighbor[r] = neighbors[order[r]];
    std::size_t end = 0;
    for (std::size_t f = 0; f < faces; ++f) {
      rings.begin[f] = static_cast<Number>(end);
      if (size[f] < 3) return false;
      std::uint32_t at_face = first[f];
      for (std::size_t k = 0; k < size[f]; ++k) {
        rings.ring[end++] = static_cast<Entry>(at_face);
        const auto found = next.find(keyOfPair(static_cast<std::uint32_t>(f), at_face));
        if (found == next.end()) return false;
        at_face = found->second;
      }
      if (at_face != first[f]) return false;
    }
    rings.begin[faces] = static_cast<Number>(end);
    return true;
  };
  const auto count = static_cast<std::uint32_t>(faces);
  return Header{count, 0}.isSmall()
             ? write<std::uint16_t, std::uint8_t>(site, count, vertices.size(), arena, fill)
             : write<std::uint32_t, std::uint32_t>(site, count, vertices.size(), arena, fill);
}

}  // namespace vorpipe::space
