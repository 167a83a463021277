#include "space/rows.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace vorpipe::space {
namespace {

/// What a row begins with; then its neighbors, where its rings begin, and the rings.
struct Header {
  std::uint32_t faces, edge_ends;
  [[nodiscard]] bool isSmall() const { return faces < 256; }
};

std::size_t bytesOf(const Header& row) {
  const std::size_t number = row.isSmall() ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
  const std::size_t entry = row.isSmall() ? sizeof(std::uint8_t) : sizeof(std::uint32_t);
  return sizeof(Header) + row.faces * sizeof(Label) + (row.faces + 1) * number + row.edge_ends * entry;
}

template <class Number, class Entry>
struct Parts {
  Label* neighbor;
  Number* begin;
  Entry* ring;
  Parts(std::byte* at, std::size_t faces)
      : neighbor(reinterpret_cast<Label*>(at + sizeof(Header))),
        begin(reinterpret_cast<Number*>(neighbor + faces)),
        ring(reinterpret_cast<Entry*>(begin + faces + 1)) {}
};
using Small = Parts<std::uint16_t, std::uint8_t>;
using Large = Parts<std::uint32_t, std::uint32_t>;

/// By face and by one of its ring: the one that follows. Entries of other cells may be left in it: a ring is
/// as long as the number of its vertices.
struct Followers {
  std::uint8_t next[64][64];
};

}  // namespace

std::byte* RowArena::get(std::size_t bytes) {
  bytes = (bytes + sizeof(Header) - 1) / sizeof(Header) * sizeof(Header);
  if (bytes > left_) {
    constexpr std::size_t block = std::size_t{1} << 20;
    left_ = std::max(block, bytes);
    blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(left_));
    next_ = blocks_.back().get();
  }
  std::byte* const at = next_;
  next_ += bytes;
  left_ -= bytes;
  return at;
}

Row Rows::operator[](std::size_t site) const {
  std::byte* const at = at_[site];
  if (at == nullptr) return {};
  Header header;
  std::memcpy(&header, at, sizeof header);
  Row row;
  row.faces = header.faces;
  row.edge_ends = header.edge_ends;
  if (header.isSmall()) {
    const Small parts(at, header.faces);
    row.neighbor = parts.neighbor;
    row.small_begin = parts.begin;
    row.small = parts.ring;
  } else {
    const Large parts(at, header.faces);
    row.neighbor = parts.neighbor;
    row.large_begin = parts.begin;
    row.large = parts.ring;
  }
  return row;
}

template <bool from_least, class Vertex>
bool Rows::setSmall(std::size_t site, std::span<const Label> neighbors, const Vertex* vertices,
                    std::size_t vertex_count, RowArena& arena) {
  thread_local Followers followers;
  const std::size_t faces = neighbors.size();
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
    const auto a = static_cast<std::uint8_t>(vertices[v][0]), b = static_cast<std::uint8_t>(vertices[v][1]),
               c = static_cast<std::uint8_t>(vertices[v][2]);
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
  const Header header{static_cast<std::uint32_t>(faces), static_cast<std::uint32_t>(3 * vertex_count)};
  std::byte* const at = arena.get(bytesOf(header));
  std::memcpy(at, &header, sizeof header);
  const Small parts(at, faces);
  std::ranges::copy(neighbors, parts.neighbor);
  std::size_t end = 0;
  bool whole = faces >= 4;
  for (std::size_t f = 0; f < faces; ++f) {
    parts.begin[f] = static_cast<std::uint16_t>(end);
    whole = whole && size[f] >= 3;
    if (!whole) break;
    std::uint8_t at_face = first[f];
    for (std::size_t k = 0; k < size[f]; ++k) {
      parts.ring[end++] = at_face;
      at_face = followers.next[f][at_face & 63];
      if (from_least && at_face == none) break;
    }
    whole = at_face == first[f];
  }
  parts.begin[faces] = static_cast<std::uint16_t>(end);
  at_[site] = whole ? at : nullptr;
  return whole;
}

bool Rows::set(std::size_t site, std::span<const Label> neighbors, const std::uint8_t (*vertices)[4],
               std::size_t vertex_count, RowArena& arena) {
  return setSmall<false>(site, neighbors, vertices, vertex_count, arena);
}

bool Rows::set(std::size_t site, std::span<const Label> neighbors,
               std::span<const std::array<std::uint32_t, 3>> vertices, RowArena& arena) {
  const std::size_t faces = neighbors.size();
  if (faces <= 64) return setSmall<true>(site, neighbors, vertices.data(), vertices.size(), arena);
  std::unordered_map<std::uint64_t, std::uint32_t> next;
  next.reserve(3 * vertices.size());
  std::vector<std::uint32_t> size(faces, 0), first(faces, UINT32_MAX);
  const auto key = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; };
  for (const auto& v : vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
      next[key(a, b)] = c;
      ++size[a];
      first[a] = std::min(first[a], b);
    }
  }
  const Header header{static_cast<std::uint32_t>(faces), static_cast<std::uint32_t>(3 * vertices.size())};
  std::byte* const at = arena.get(bytesOf(header));
  std::memcpy(at, &header, sizeof header);
  const auto write = [&](const auto& parts) {
    std::ranges::copy(neighbors, parts.neighbor);
    std::size_t end = 0;
    for (std::size_t f = 0; f < faces; ++f) {
      parts.begin[f] = static_cast<std::remove_reference_t<decltype(*parts.begin)>>(end);
      if (size[f] < 3) return false;
      std::uint32_t at_face = first[f];
      for (std::size_t k = 0; k < size[f]; ++k) {
        parts.ring[end++] = static_cast<std::remove_reference_t<decltype(*parts.ring)>>(at_face);
        const auto found = next.find(key(static_cast<std::uint32_t>(f), at_face));
        if (found == next.end()) return false;
        at_face = found->second;
      }
      if (at_face != first[f]) return false;
    }
    parts.begin[faces] = static_cast<std::remove_reference_t<decltype(*parts.begin)>>(end);
    return true;
  };
  const bool whole = faces >= 4 && (header.isSmall() ? write(Small(at, faces)) : write(Large(at, faces)));
  at_[site] = whole ? at : nullptr;
  return whole;
}

}  // namespace vorpipe::space
