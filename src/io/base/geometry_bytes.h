/// Reads the bytes of GeoPackage geometries.
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

/// Success, or what is wrong with a geometry.
using GeometryTaken = tl::expected<void, std::string>;

inline tl::unexpected<std::string> wrongGeometry(std::string what) { return tl::unexpected(std::move(what)); }

inline GeometryTaken damagedGeometry() { return wrongGeometry("its geometry is damaged: it ends too early"); }

/// Takes numbers of either byte order off the front of bytes. Past their end it returns 0, and failed() is
/// true.
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

/// Takes the byte order and type at the start of a well-known binary geometry, by ISO or with PostGIS flags.
WkbType takeWkbType(ByteReader& reader);

/// Returns the type's name for messages: "Polygon".
std::string nameOfWkbType(std::uint32_t type);

/// Takes x and y, and skips a position's other numbers.
Point takeWkbPosition(ByteReader& reader, const WkbType& type);

/// Takes the header of a geometry by clause 2.1.3 of the standard.
tl::expected<ByteReader, std::string> geometryIn(std::string_view bytes);

}  // namespace vorpipe
