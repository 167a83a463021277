#include "io/pictures/georeference.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/base/print.h"
#include "io/pictures/deflate.h"

// TIFF, revision 6.0: section 2 (structure), 14 (differencing predictor); Adobe Photoshop TIFF technical
// notes for Deflate. A BigTIFF has 64-bit offsets and counts. OGC GeoTIFF Standard 1.1 (19-008r4): 7.1 (the
// directory), and its Annex C for the projection.

namespace vorpipe {
namespace {

/// Tags of the directory of a TIFF.
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
  geo_double_params = 34736,
  geo_ascii_params = 34737,
  gdal_nodata = 42113,
};

/// Keys of GeoTIFF.
enum Key : std::uint16_t {
  model_type = 1024,
  raster_type = 1025,
  geodetic_crs = 2048,
  angular_units = 2054,
  projected_crs = 3072,
  projected_citation = 3073,
  projection = 3074,
  projection_method = 3075,
  linear_units = 3076,
  false_easting = 3082,
  false_northing = 3083,
  center_longitude = 3088,
  center_latitude = 3089,
};

constexpr std::uint16_t projected = 1, geographic = 2, pixel_is_area = 1, user_defined = 32767;
constexpr std::uint16_t wgs_84 = 4326, degree = 9102, kilometer = 9036, lambert_azimuthal_equal_area = 10;

/// Adds a key; call in ascending order of keys.
void addEntry(GeoKeys& keys, Key key, std::uint16_t place, std::size_t count, std::size_t value) {
  keys.directory.insert(keys.directory.end(),
                        {key, place, static_cast<std::uint16_t>(count), static_cast<std::uint16_t>(value)});
  ++keys.directory[3];
}
void add(GeoKeys& keys, Key key, std::uint16_t value) { addEntry(keys, key, 0, 1, value); }
void add(GeoKeys& keys, Key key, double value) {
  addEntry(keys, key, geo_double_params, 1, keys.doubles.size());
  keys.doubles.push_back(value);
}
void add(GeoKeys& keys, Key key, std::string_view text) {
  addEntry(keys, key, geo_ascii_params, text.size() + 1, keys.ascii.size());
  keys.ascii.append(text) += '|';
}

/// The EPSG code, if the file has room for it.
std::optional<std::uint16_t> codeOf(const CoordinateSystem& system) {
  if (system.organization != "EPSG" || system.code <= 0 || system.code >= user_defined) return std::nullopt;
  return static_cast<std::uint16_t>(system.code);
}

void addEqualArea(GeoKeys& keys, const Point& center) {
  add(keys, geodetic_crs, wgs_84);
  add(keys, angular_units, degree);
  add(keys, projected_crs, user_defined);
  add(keys, projected_citation, "Lambert azimuthal equal area, in kilometers");
  add(keys, projection, user_defined);
  add(keys, projection_method, lambert_azimuthal_equal_area);
  add(keys, linear_units, kilometer);
  add(keys, false_easting, 0.0);
  add(keys, false_northing, 0.0);
  add(keys, center_longitude, center.x);
  add(keys, center_latitude, center.y);
}

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
  parallelEach(strips.bytes.size(), 1, threads, [&](std::size_t k) {
    const auto strip = ids.subspan(k * pixels, std::min(pixels, ids.size() - k * pixels));
    strips.bytes[k] = deflated(differencesIn(strip, columns));
    strips.bytes[k].shrink_to_fit();
  });
  return strips;
}

/// Appends a number of 64 bits in a BigTIFF, otherwise 32.
void appendWide(std::string& bytes, bool big, std::uint64_t number) {
  if (big) {
    appendNumber<order>(bytes, number);
  } else {
    appendNumber<order>(bytes, static_cast<std::uint32_t>(number));
  }
}

/// Adds the offsets and lengths of strips, which follow each other from `begin`.
void addStrips(std::vector<Field>& fields, bool big, const Strips& strips, std::uint64_t begin) {
  const Type type = big ? long8 : long_number;
  Field offsets{strip_offsets, type, strips.bytes.size(), {}},
      sizes{strip_byte_counts, type, offsets.count, {}};
  for (const std::string& strip : strips.bytes) {
    appendWide(offsets.bytes, big, begin);
    appendWide(sizes.bytes, big, strip.size());
    begin += strip.size();
  }
  fields.push_back(std::move(offsets));
  fields.push_back(std::move(sizes));
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
  addStrips(fields, big, strips, begin);
  addGeoreference(fields, options);
  std::ranges::sort(fields, {}, &Field::tag);
  return fields;
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
  const bool big = headOf(false, 0).size() + strips.size() > options.longest_classic;
  VORPIPE_TRY(sink.write(headOf(big, headOf(big, 0).size())));
  for (const std::string& strip : strips.bytes) {
    VORPIPE_TRY(sink.write(strip));
  }
  return {};
}

}  // namespace

PixelGrid pixelGridOf(const Box& box, const PictureFrame& frame) {
  const double width = (box.xmax - box.xmin) / frame.width;
  const double height = (box.ymax - box.ymin) / frame.height;
  return {box.xmin - frame.left * width, box.ymax + frame.top * height, width, height};
}

Result<void> writeWorldFile(ByteSink& sink, const PixelGrid& grid) {
  return sink.write(fmt::format("{}\n0\n0\n{}\n{}\n{}\n", grid.width, -grid.height,
                                grid.left + grid.width / 2, grid.top - grid.height / 2));
}

GeoKeys geoKeysOf(const CoordinateSystem& system) {
  const bool in_degrees = system.kind == CoordinateKind::degrees;
  const auto code = codeOf(system);
  if (!in_degrees && !system.equal_area_center && (system.kind != CoordinateKind::plane || !code)) return {};
  GeoKeys keys{{1, 1, 1, 0}, {}, {}};  // versions, and the number of keys that follow
  add(keys, model_type, in_degrees ? geographic : projected);
  add(keys, raster_type, pixel_is_area);
  if (in_degrees) {
    add(keys, geodetic_crs, code.value_or(wgs_84));
  } else if (system.equal_area_center) {
    addEqualArea(keys, *system.equal_area_center);
  } else {
    add(keys, projected_crs, *code);
  }
  return keys;
}

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
