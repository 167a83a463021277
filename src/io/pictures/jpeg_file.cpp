#include "io/pictures/jpeg_file.h"

#include <fmt/core.h>
// libjpeg's header needs that of FILE before it.
#include <cstdio>

#include <jpeglib.h>
// The codes of warnings.
#include <jerror.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"

// libjpeg's functions end by longjmp when something fails. So a function that calls setjmp holds no object
// with a destructor.

namespace vorpipe {
namespace {

constexpr std::uint32_t opaque_alpha = 0xFF000000u;

/// What libjpeg calls in place of exit() and fprintf().
struct Handler {
  jpeg_error_mgr errors{};  ///< first: libjpeg hands out a pointer to it
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> message{};
};

Handler& handlerOf(j_common_ptr jpeg) { return *reinterpret_cast<Handler*>(jpeg->err); }

void onFault(j_common_ptr jpeg) {
  Handler& handler = handlerOf(jpeg);
  jpeg->err->format_message(jpeg, handler.message.data());
  std::longjmp(handler.jump, 1);
}

/// A warning: where data are missing or wrong, libjpeg makes up pixels. Bytes between segments do no harm.
void onMessage(j_common_ptr jpeg, int level) {
  if (level < 0 && jpeg->err->msg_code != JWRN_EXTRANEOUS_DATA) onFault(jpeg);
}

struct Decoder {
  Handler handler;
  jpeg_decompress_struct jpeg{};

  Decoder() {
    jpeg.err = jpeg_std_error(&handler.errors);
    handler.errors.error_exit = onFault;
    handler.errors.emit_message = onMessage;
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { jpeg_destroy_decompress(&jpeg); }
};

/// Reads the header, and asks for RGB, or for the CMYK of a file that has no other.
bool decodeHeader(Decoder& decoder, const unsigned char* bytes, std::size_t count) {
  if (setjmp(decoder.handler.jump) != 0) return false;
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, bytes, static_cast<unsigned long>(count));
  constexpr unsigned longest_marker = 0xFFFF;
  jpeg_save_markers(&jpeg, JPEG_APP0 + 1, longest_marker);
  jpeg_read_header(&jpeg, TRUE);
  const bool inks = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
  jpeg.out_color_space = inks ? JCS_CMYK : JCS_RGB;
  return true;
}

void unpackRow(const unsigned char* bytes, const jpeg_decompress_struct& jpeg, std::uint32_t* row) {
  const bool inks = jpeg.out_color_space == JCS_CMYK;
  // Adobe's programs store how much light is left, and not how much ink there is.
  const std::uint32_t none = jpeg.saw_Adobe_marker != 0 ? 0 : 0xFF;
  constexpr std::uint32_t most = 0xFF;
  for (unsigned x = 0; x < jpeg.output_width; ++x, bytes += inks ? 4 : 3) {
    row[x] = opaque_alpha;
    for (int channel = 0; channel < 3; ++channel) {
      std::uint32_t light = bytes[channel];
      if (inks) light = ((light ^ none) * (bytes[3] ^ none) + most / 2) / most;
      row[x] |= light << 8 * channel;
    }
  }
}

bool decodeRows(Decoder& decoder, unsigned char* line, std::uint32_t* pixels) {
  if (setjmp(decoder.handler.jump) != 0) return false;
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  jpeg_start_decompress(&jpeg);
  while (jpeg.output_scanline < jpeg.output_height) {
    const std::size_t row = jpeg.output_scanline;
    jpeg_read_scanlines(&jpeg, &line, 1);
    unpackRow(line, jpeg, pixels + row * jpeg.output_width);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

/// Returns the orientation in a segment of EXIF (a TIFF with one directory before all others), 1 if it has
/// none that is known.
int orientationIn(std::string_view exif) {
  constexpr std::string_view begin("Exif\0\0", 6);
  constexpr std::size_t entry_size = 12, header_size = 8;
  constexpr std::uint32_t orientation = 0x0112, short_number = 3;
  if (!exif.starts_with(begin)) return 1;
  const std::string_view tiff = exif.substr(begin.size());
  if (tiff.size() < header_size) return 1;
  const bool little = tiff.starts_with("II");
  const auto number = [&](std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const auto byte = static_cast<unsigned char>(tiff[at + (little ? count - 1 - k : k)]);
      value = value << 8 | byte;
    }
    return value;
  };
  const std::size_t directory = number(4, 4);
  if (directory > tiff.size() - 2) return 1;
  const std::size_t entries = number(directory, 2);
  for (std::size_t k = 0; k < entries; ++k) {
    const std::size_t at = directory + 2 + k * entry_size;
    if (at > tiff.size() - std::min(entry_size, tiff.size())) return 1;
    if (number(at, 2) != orientation || number(at + 2, 2) != short_number) continue;
    const std::uint32_t value = number(at + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

int orientationOf(const jpeg_decompress_struct& jpeg) {
  for (const jpeg_marker_struct* marker = jpeg.marker_list; marker != nullptr; marker = marker->next) {
    const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
    if (const int found = orientationIn(data); found != 1) return found;
  }
  return 1;
}

/// Turns an image: orientations name the side at which the stored rows and columns begin (EXIF 2.32, 4.6.4
/// A).
Image turned(Image stored, int orientation) {
  constexpr int first_across = 5;  // from here on rows and columns are exchanged
  if (orientation == 1) return stored;
  const bool across = orientation >= first_across;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Image image{across ? stored.height : stored.width, across ? stored.width : stored.height, {}, {}};
  image.rgba.reserve(stored.rgba.size());
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      int from_column = across ? row : column, from_row = across ? column : row;
      if (from_right) from_column = stored.width - 1 - from_column;
      if (from_bottom) from_row = stored.height - 1 - from_row;
      image.rgba.push_back(
          stored.rgba[static_cast<std::size_t>(from_row) * static_cast<std::size_t>(stored.width) +
                      static_cast<std::size_t>(from_column)]);
    }
  }
  return image;
}

/// Refuses more pixels than the file's bytes can hold or than fit into memory.
Result<void> checkPixels(jpeg_decompress_struct& jpeg, const std::string& path, std::size_t bytes) {
  // Each block of 8 x 8 takes a bit at least.
  constexpr std::size_t pixels_per_byte = 512;
  const std::size_t width = jpeg.image_width, height = jpeg.image_height;
  if (width * height / pixels_per_byte > bytes) {
    return inputError(fmt::format("{}: is a damaged JPEG: {} bytes cannot hold {} x {} pixels", path, bytes,
                                  width, height));
  }
  // Once as they are stored, and once turned; libjpeg keeps what several scans add up to.
  std::size_t of_pixel = 2 * sizeof(std::uint32_t);
  if (jpeg_has_multiple_scans(&jpeg) != 0) {
    of_pixel += sizeof(JCOEF) * static_cast<std::size_t>(jpeg.num_components);
  }
  return checkRoom(path, "pixels", of_pixel * width * height);
}

Result<Image> decode(const std::string& path, std::string_view bytes) {
  constexpr std::string_view signature = "\xFF\xD8\xFF";
  constexpr std::size_t channels = 4;
  if (!bytes.starts_with(signature)) return inputError(path + ": is not a JPEG file");
  Decoder decoder;
  const auto damaged = [&] {
    return inputError(fmt::format("{}: is a damaged JPEG: {}", path, decoder.handler.message.data()));
  };
  if (!decodeHeader(decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()))
    return damaged();
  VORPIPE_TRY(checkPixels(decoder.jpeg, path, bytes.size()));
  const std::size_t width = decoder.jpeg.image_width, height = decoder.jpeg.image_height;
  Image image{static_cast<int>(width), static_cast<int>(height), {}, {}};
  image.rgba.resize(width * height);
  std::vector<unsigned char> line(channels * width);
  // The rows' end frees what the header left.
  const int orientation = orientationOf(decoder.jpeg);
  if (!decodeRows(decoder, line.data(), image.rgba.data())) return damaged();
  return turned(std::move(image), orientation);
}

}  // namespace

Result<Image> readJpeg(const std::string& path) {
  try {
    VORPIPE_VAR(file, InputFile::open(path));
    VORPIPE_LET(bytes, readText(file));
    return decode(path, bytes);
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its pixels");
  }
}

}  // namespace vorpipe
