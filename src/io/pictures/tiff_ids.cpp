#include "io/pictures/tiff_ids.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "io/base/byte_order.h"
#include "io/base/error.h"
#include "io/pictures/deflate.h"
#include "io/pictures/geo_keys.h"

// TIFF, revision 6.0: section 2 (structure), 14 (differencing predictor); Adobe Photoshop TIFF technical
// notes for Deflate; OGC GeoTIFF Standard 1.1. A BigTIFF has 64-bit offsets and counts.

namespace vorpipe {
namespace {

enum Tag : std::uint16_t {
  image_width = 256,
  image_length = 257,
  bits_per_sample = 258,
  compression = 259,
  photometric = 262,
  strip_offsets = 273,
  samples_per_pixel = 277,
  rows_per_strip = 278,
  strip_byte_counts = 279,
  planar_configuration = 284,
  predictor = 317,
  sample_format = 339,
  model_pixel_scale = 33550,
  model_tiepoint = 33922,
  geo_key_directory = 34735,
  geo_double_params = geo_doubles_tag,
  geo_ascii_params = geo_ascii_tag,
  gdal_nodata = 42113,
};

enum Type : std::uint16_t { ascii = 2, short_number = 3, long_number = 4, double_number = 12, long8 = 16 };

constexpr auto order = std::endian::little;

/// One entry of the directory with its values, as bytes.
struct Field {
  Tag tag;
  Type type;
  std::uint64_t count;
  std::string bytes;
};

template <class Number>
Field fieldOf(Tag tag, Type type, std::span<const Number> numbers) {
  Field field{tag, type, numbers.size(), {}};
  for (const Number number : numbers) appendNumber<order>(field.bytes, number);
  return field;
}

Field fieldOf(Tag tag, std::uint16_t value) {
  return fieldOf<std::uint16_t>(tag, short_number, std::span(&value, 1));
}

Field fieldOf(Tag tag, int value) {
  const auto number = static_cast<std::uint32_t>(value);
  return fieldOf<std::uint32_t>(tag, long_number, std::span(&number, 1));
}

Field fieldOf(Tag tag, std::span<const double> values) { return fieldOf<double>(tag, double_number, values); }

Field fieldOf(Tag tag, std::string text) {
  text.push_back('\0');
  return {tag, ascii, text.size(), std::move(text)};
}

/// The strips of an image, compressed.
struct Strips {
  int rows;  ///< of each except the last
  std::vector<std::string> bytes;

  [[nodiscard]] std::uint64_t size() const {
    std::uint64_t sum = 0;
    for (const std::string& strip : bytes) sum += strip.size();
    return sum;
  }
};

/// Returns rows as differences from the pixel on the left, which are 0 inside a cell.
std::string differencesIn(std::span<const std::uint32_t> ids, std::size_t width) {
  std::string bytes;
  bytes.reserve(ids.size_bytes());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    appendNumber<order>(bytes, i % width == 0 ? ids[i] : ids[i] - ids[i - 1]);
  }
  return bytes;
}

Strips compressed(int width, int height, std::span<const std::uint32_t> ids, int threads) {
  constexpr int strip_pixels = 1 << 16;
  Strips strips{std::clamp(strip_pixels / width, 1, height), {}};
  const auto columns = static_cast<std::size_t>(width);
  const std::size_t pixels = columns * static_cast<std::size_t>(strips.rows);
  strips.bytes.resize((ids.size() + pixels - 1) / pixels);
  parallelFor(strips.bytes.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) {
      const auto strip = ids.subspan(k * pixels, std::min(pixels, ids.size() - k * pixels));
      strips.bytes[k] = deflated(differencesIn(strip, columns));
      strips.bytes[k].shrink_to_fit();
    }
  });
  return strips;
}

/// Adds the offsets and lengths of strips.
template <class Number>
void addPlaces(std::vector<Field>& fields, Type type, const Strips& strips, std::uint64_t begin) {
  std::vector<Number> offsets, counts;
  for (const std::string& strip : strips.bytes) {
    offsets.push_back(static_cast<Number>(begin));
    counts.push_back(static_cast<Number>(strip.size()));
    begin += strip.size();
  }
  fields.push_back(fieldOf<Number>(strip_offsets, type, offsets));
  fields.push_back(fieldOf<Number>(strip_byte_counts, type, counts));
}

void addGeoreference(std::vector<Field>& fields, const TiffOptions& options) {
  const PixelGrid& grid = options.grid;
  fields.push_back(fieldOf(model_pixel_scale, std::array{grid.width, grid.height, 0.0}));
  fields.push_back(fieldOf(model_tiepoint, std::array{0.0, 0.0, 0.0, grid.left, grid.top, 0.0}));
  const GeoKeys keys = geoKeysOf(options.system);
  if (keys.directory.empty()) return;
  fields.push_back(fieldOf<std::uint16_t>(geo_key_directory, short_number, keys.directory));
  if (!keys.doubles.empty()) fields.push_back(fieldOf(geo_double_params, keys.doubles));
  if (!keys.ascii.empty()) fields.push_back(fieldOf(geo_ascii_params, keys.ascii));
}

/// Returns all fields in the order of their tags; strips follow each other from `begin`.
std::vector<Field> fieldsOf(int width, int height, const Strips& strips, std::uint64_t begin, bool big,
                            const TiffOptions& options) {
  constexpr std::uint16_t uint32_bits = 32, deflate = 8, black_is_zero = 1, one_band = 1, chunky = 1,
                          horizontal = 2, unsigned_integer = 1;
  std::vector<Field> fields{fieldOf(image_width, width),
                            fieldOf(image_length, height),
                            fieldOf(bits_per_sample, uint32_bits),
                            fieldOf(compression, deflate),
                            fieldOf(photometric, black_is_zero),
                            fieldOf(samples_per_pixel, one_band),
                            fieldOf(rows_per_strip, strips.rows),
                            fieldOf(planar_configuration, chunky),
                            fieldOf(predictor, horizontal),
                            fieldOf(sample_format, unsigned_integer),
                            fieldOf(gdal_nodata, std::to_string(no_site))};
  if (big) {
    addPlaces<std::uint64_t>(fields, long8, strips, begin);
  } else {
    addPlaces<std::uint32_t>(fields, long_number, strips, begin);
  }
  addGeoreference(fields, options);
  std::ranges::sort(fields, {}, &Field::tag);
  return fields;
}

/// Appends a number of 64 bits in a BigTIFF, otherwise 32.
void appendWide(std::string& bytes, bool big, std::uint64_t number) {
  if (big) {
    appendNumber<order>(bytes, number);
  } else {
    appendNumber<order>(bytes, static_cast<std::uint32_t>(number));
  }
}

/// Returns the header; the directory follows immediately.
std::string headerOf(bool big) {
  constexpr std::uint16_t classic_version = 42, big_version = 43, offset_bytes = 8, zero = 0;
  constexpr std::uint32_t classic_size = 8;
  constexpr std::uint64_t big_size = 16;
  std::string header = "II";
  appendNumber<order>(header, big ? big_version : classic_version);
  if (big) {
    appendNumber<order>(header, offset_bytes);
    appendNumber<order>(header, zero);
    appendNumber<order>(header, big_size);
  } else {
    appendNumber<order>(header, classic_size);
  }
  return header;
}

/// Returns the directory, placed at `begin`, and the values that do not fit into it.
std::string directoryOf(const std::vector<Field>& fields, bool big, std::uint64_t begin) {
  const std::size_t word = big ? 8 : 4;
  std::string directory, values;
  if (big) {
    appendNumber<order>(directory, static_cast<std::uint64_t>(fields.size()));
  } else {
    appendNumber<order>(directory, static_cast<std::uint16_t>(fields.size()));
  }
  const std::size_t entry = 2 * sizeof(std::uint16_t) + 2 * word;
  const std::uint64_t rest = begin + directory.size() + fields.size() * entry + word;
  for (const Field& field : fields) {
    appendNumber<order>(directory, static_cast<std::uint16_t>(field.tag));
    appendNumber<order>(directory, static_cast<std::uint16_t>(field.type));
    appendWide(directory, big, field.count);
    if (field.bytes.size() <= word) {
      directory += field.bytes;
      directory.append(word - field.bytes.size(), '\0');
      continue;
    }
    appendWide(directory, big, rest + values.size());
    values += field.bytes;
    // Offsets are even.
    if (values.size() % 2 != 0) values.push_back('\0');
  }
  constexpr std::uint64_t no_other_directory = 0;
  appendWide(directory, big, no_other_directory);
  return directory + values;
}

Result<void> writeFile(ByteSink& sink, int width, int height, const Strips& strips,
                       const TiffOptions& options) {
  const auto headOf = [&](bool big, std::uint64_t strips_begin) {
    const std::string header = headerOf(big);
    return header +
           directoryOf(fieldsOf(width, height, strips, strips_begin, big, options), big, header.size());
  };
  // The length of the head does not depend on its values.
  bool big = false;
  std::uint64_t begin = headOf(big, 0).size();
  if (begin + strips.size() > options.longest_classic) {
    big = true;
    begin = headOf(big, 0).size();
  }
  auto written = sink.write(headOf(big, begin));
  for (std::size_t k = 0; written && k < strips.bytes.size(); ++k) written = sink.write(strips.bytes[k]);
  return written;
}

}  // namespace

Result<void> writeTiffIds(ByteSink& sink, int width, int height, std::span<const std::uint32_t> ids,
                          const TiffOptions& options) {
  assert(width > 0 && height > 0 &&
         ids.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  try {
    return writeFile(sink, width, height, compressed(width, height, ids, options.threads), options);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory for its compressed ids");
  }
}

}  // namespace vorpipe
