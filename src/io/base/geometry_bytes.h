/// The bytes of a GeoPackage's geometries, while they are read.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "vorpipe.h"

namespace vorpipe {

/// What is wrong with a geometry, where something is.
using GeometryTaken = tl::expected<void, std::string>;

inline tl::unexpected<std::string> wrongGeometry(std::string what) { return tl::unexpected(std::move(what)); }

inline GeometryTaken damagedGeometry() { return wrongGeometry("its geometry is damaged: it ends too early"); }

/// Numbers of either byte order off the front of bytes; 0 where they end, after which failed() is true.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  void setOrder(bool little) { swapped_ = little != (std::endian::native == std::endian::little); }
  [[nodiscard]] bool failed() const { return failed_; }
  void skip(std::size_t count) {
    failed_ = failed_ || count > rest_.size();
    rest_.remove_prefix(std::min(count, rest_.size()));
  }

  template <class Number>
  Number take() {
    std::array<char, sizeof(Number)> bytes{};
    if (rest_.size() < bytes.size()) {
      failed_ = true;
      return Number{};
    }
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    if (swapped_) std::ranges::reverse(bytes);
    return std::bit_cast<Number>(bytes);
  }

 private:
  std::string_view rest_;
  bool swapped_ = false, failed_ = false;
};

/// The type of a geometry, and how many numbers a position has.
struct WkbType {
  std::uint32_t type = 0;
  std::size_t numbers = 2;
};

/// Takes the byte order and the type that a geometry of well-known binary begins with, of ISO or with the
/// flags of PostGIS.
WkbType takeWkbType(ByteReader& reader);

/// The type in messages: "Polygon".
std::string nameOfWkbType(std::uint32_t type);

/// Takes x and y, and leaves out what else a position has.
Point takeWkbPosition(ByteReader& reader, const WkbType& type);

/// Takes the header of a geometry by clause 2.1.3 of the standard.
tl::expected<ByteReader, std::string> geometryIn(std::string_view bytes);

}  // namespace vorpipe
