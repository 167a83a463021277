#include "io/pictures/png_file.h"

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <new>
#include <string_view>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"

// libpng leaves its functions by longjmp when something fails. So a function that calls setjmp, and a
// callback from which png_error is called, holds no object with a destructor.

namespace vorpipe {
namespace {

constexpr std::size_t max_channels = 4;
constexpr int signature_size = 8;

/// Data for the callbacks, and what went wrong.
struct Transfer {
  ByteSink* output = nullptr;
  InputFile* input = nullptr;
  Result<void> result;              ///< of the file, not of libpng
  std::array<char, 200> message{};  ///< of libpng
};

void onError(png_structp png, png_const_charp message) {
  auto* transfer = static_cast<Transfer*>(png_get_error_ptr(png));
  const std::string_view text(message);
  text.copy(transfer->message.data(), transfer->message.size() - 1);
  png_longjmp(png, 1);
}

void onWarning(png_structp /*png*/, png_const_charp /*message*/) {}

bool writeTo(Transfer& transfer, const png_byte* bytes, std::size_t count) {
  transfer.result = transfer.output->write({reinterpret_cast<const char*>(bytes), count});
  return transfer.result.has_value();
}

void onWrite(png_structp png, png_bytep bytes, std::size_t count) {
  if (!writeTo(*static_cast<Transfer*>(png_get_io_ptr(png)), bytes, count)) {
    png_error(png, "writing failed");
  }
}

void onFlush(png_structp /*png*/) {}

bool readFrom(Transfer& transfer, png_byte* bytes, std::size_t count) {
  const auto got = transfer.input->read(std::span(reinterpret_cast<char*>(bytes), count));
  if (!got) {
    transfer.result = tl::unexpected(got.error());
  }
  return got && *got == count;
}

void onRead(png_structp png, png_bytep bytes, std::size_t count) {
  if (!readFrom(*static_cast<Transfer*>(png_get_io_ptr(png)), bytes, count)) {
    png_error(png, "the file ends too early");
  }
}

/// The pair of structures that every transfer needs.
struct Handles {
  png_structp png = nullptr;
  png_infop info = nullptr;
  bool writing;

  Handles(bool write, Transfer& transfer) : writing(write) {
    png = write ? png_create_write_struct(PNG_LIBPNG_VER_STRING, &transfer, onError, onWarning)
                : png_create_read_struct(PNG_LIBPNG_VER_STRING, &transfer, onError, onWarning);
    info = png != nullptr ? png_create_info_struct(png) : nullptr;
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (writing) {
      png_destroy_write_struct(&png, &info);
    } else {
      png_destroy_read_struct(&png, &info, nullptr);
    }
  }
};

void packRow(const std::uint32_t* pixels, std::size_t width, std::size_t channels, png_byte* row) {
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t channel = 0; channel < channels; ++channel) {
      row[i * channels + channel] = static_cast<png_byte>(pixels[i] >> (8 * channel) & 0xFF);
    }
  }
}

/// Pixels per meter of the two directions; 0: not known.
struct Resolution {
  png_uint_32 across = 0, down = 0;
};

Resolution resolutionOf(int width, int height, const std::optional<PaperSize>& paper) {
  if (!paper) return {};
  constexpr double meter = 1000;
  return {static_cast<png_uint_32>(std::lround(meter * width / paper->width)),
          static_cast<png_uint_32>(std::lround(meter * height / paper->height))};
}

bool encode(const Handles& handles, Transfer& transfer, png_uint_32 width, png_uint_32 height,
            std::size_t channels, const Resolution& resolution, const std::uint32_t* pixels, png_byte* row) {
  if (setjmp(png_jmpbuf(handles.png)) != 0) return false;
  constexpr int fast_compression = 3;
  png_set_write_fn(handles.png, &transfer, onWrite, onFlush);
  png_set_IHDR(handles.png, handles.info, width, height, 8,
               channels == max_channels ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (resolution.across > 0) {
    png_set_pHYs(handles.png, handles.info, resolution.across, resolution.down, PNG_RESOLUTION_METER);
  }
  png_set_compression_level(handles.png, fast_compression);
  png_set_filter(handles.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_write_info(handles.png, handles.info);
  for (png_uint_32 y = 0; y < height; ++y) {
    packRow(pixels + std::size_t{y} * width, width, channels, row);
    png_write_row(handles.png, row);
  }
  png_write_end(handles.png, handles.info);
  return true;
}

/// Reads the header and asks libpng for RGBA rows of 8 or 16 bits per channel, whatever the file holds.
bool decodeHeader(const Handles& handles, Transfer& transfer, int bits) {
  if (setjmp(png_jmpbuf(handles.png)) != 0) return false;
  png_set_read_fn(handles.png, &transfer, onRead);
  png_set_sig_bytes(handles.png, signature_size);
#ifdef PNG_HANDLE_AS_UNKNOWN_SUPPORTED
  // Skips everything except pixels, palette and transparency: text, for example, may inflate to a thousand
  // times its size.
  png_set_keep_unknown_chunks(handles.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
#endif
  png_read_info(handles.png, handles.info);
  if (bits == 16) {
    png_set_expand_16(handles.png);
  } else {
    png_set_expand(handles.png);
    png_set_scale_16(handles.png);
  }
  png_set_gray_to_rgb(handles.png);
  png_set_add_alpha(handles.png, (1u << bits) - 1, PNG_FILLER_AFTER);
  return true;
}

bool decodeRows(const Handles& handles, png_bytep pixels, std::size_t row_size, png_uint_32 height) {
  if (setjmp(png_jmpbuf(handles.png)) != 0) return false;
  const int passes = png_set_interlace_handling(handles.png);
  png_read_update_info(handles.png, handles.info);
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 y = 0; y < height; ++y) {
      png_read_row(handles.png, pixels + y * row_size, nullptr);
    }
  }
  png_read_end(handles.png, nullptr);
  return true;
}

tl::unexpected<Error> readError(const Transfer& transfer, const std::string& path) {
  if (!transfer.result) return tl::unexpected(transfer.result.error());
  return inputError(fmt::format("{}: is a damaged PNG: {}", path, transfer.message.data()));
}

/// RGBA, the top row first; channels of 8 bits, or of 16 with the high byte first.
struct Pixels {
  int width = 0, height = 0;
  std::vector<png_byte> bytes;
};

/// Refuses more pixels than the file's bytes can hold or than fit into memory: the result takes `of_result`
/// bytes per pixel.
Result<void> checkPixels(const Handles& handles, const InputFile& file, const std::string& path,
                         std::uint64_t of_rows, std::uint64_t of_result) {
  const std::uint64_t width = png_get_image_width(handles.png, handles.info);
  const std::uint64_t height = png_get_image_height(handles.png, handles.info);
  const std::uint64_t bits = std::uint64_t{png_get_bit_depth(handles.png, handles.info)} *
                             png_get_channels(handles.png, handles.info);
  if (file.mostBytes() && width * bits / 8 * height / largest_inflation > *file.mostBytes()) {
    return inputError(fmt::format("{}: is a damaged PNG: {} bytes cannot hold {} x {} pixels", path,
                                  *file.mostBytes(), width, height));
  }
  return checkRoom(path, "pixels", (of_rows + of_result) * width * height);
}

Result<Pixels> decode(InputFile& file, const std::string& path, int bits, std::uint64_t of_result) {
  std::array<png_byte, signature_size> signature{};
  Transfer transfer;
  transfer.input = &file;
  if (!readFrom(transfer, signature.data(), signature_size) && !transfer.result) {
    return tl::unexpected(transfer.result.error());
  }
  if (png_sig_cmp(signature.data(), 0, signature_size) != 0) return inputError(path + ": is not a PNG file");
  const Handles handles(false, transfer);
  if (handles.info == nullptr) return deviceError(path + ": libpng could not be started");
  if (!decodeHeader(handles, transfer, bits)) return readError(transfer, path);
  const png_uint_32 width = png_get_image_width(handles.png, handles.info);
  const png_uint_32 height = png_get_image_height(handles.png, handles.info);
  const auto of_pixel = max_channels * static_cast<std::size_t>(bits / 8);
  VORPIPE_TRY(checkPixels(handles, file, path, of_pixel, of_result));
  const std::size_t row_size = width * of_pixel;
  Pixels pixels{static_cast<int>(width), static_cast<int>(height), {}};
  pixels.bytes.resize(row_size * height);
  if (!decodeRows(handles, pixels.bytes.data(), row_size, height)) return readError(transfer, path);
  return pixels;
}

/// Reads a file and makes a result of its pixels, which takes `of_result` bytes for each.
template <class Make>
auto readPixels(const std::string& path, int bits, std::uint64_t of_result, const Make& make)
    -> Result<decltype(make(Pixels{}))> {
  try {
    VORPIPE_VAR(file, InputFile::open(path));
    return decode(file, path, bits, of_result).map(make);
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its pixels");
  }
}

/// Returns the darkness of a pixel, whose channels are up to 65535.
template <class Channel>
double darkness(const Channel& channel) {
  constexpr int most = 65535;
  const auto dark = [&](std::size_t k) { return most - channel(k); };
  // In integers, so that black is exactly 1 and white 0.
  const int sum = 2126 * dark(0) + 7152 * dark(1) + 722 * dark(2);
  return sum / (10000 * double{most}) * (channel(3) / double{most});
}

}  // namespace

Result<void> writePng(ByteSink& sink, int width, int height, std::span<const std::uint32_t> rgba,
                      const std::optional<PaperSize>& paper) {
  assert(width > 0 && height > 0 &&
         rgba.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Transfer transfer;
  transfer.output = &sink;
  const Handles handles(true, transfer);
  if (handles.info == nullptr) return deviceError(sink.name() + ": libpng could not be started");
  constexpr std::uint32_t opaque = 0xFF000000u;
  const bool all_opaque =
      std::all_of(rgba.begin(), rgba.end(), [](std::uint32_t pixel) { return pixel >= opaque; });
  const std::size_t channels = all_opaque ? max_channels - 1 : max_channels;
  std::vector<png_byte> row(static_cast<std::size_t>(width) * channels);
  if (encode(handles, transfer, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), channels,
             resolutionOf(width, height, paper), rgba.data(), row.data())) {
    return {};
  }
  if (!transfer.result) return transfer.result;
  return deviceError(
      fmt::format("{}: could not be encoded as PNG: {}", sink.name(), transfer.message.data()));
}

Result<Image> readPng(const std::string& path) {
  return readPixels(path, 8, sizeof(std::uint32_t), [](const Pixels& pixels) {
    Image image;
    image.width = pixels.width;
    image.height = pixels.height;
    image.rgba.resize(pixels.bytes.size() / max_channels);
    const png_byte* bytes = pixels.bytes.data();
    for (std::uint32_t& pixel : image.rgba) {
      pixel = bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
              std::uint32_t{bytes[3]} << 24;
      bytes += max_channels;
    }
    return image;
  });
}

Density darknessOf(const Image& image) {
  Density density{image.width, image.height, {}};
  density.values.reserve(image.rgba.size());
  for (const std::uint32_t pixel : image.rgba) {
    density.values.push_back(
        darkness([&](std::size_t k) { return static_cast<int>((pixel >> 8 * k & 0xFF) * 257); }));
  }
  return density;
}

Result<Density> readPngDarkness(const std::string& path) {
  return readPixels(path, 16, sizeof(double), [](const Pixels& pixels) {
    Density density{pixels.width, pixels.height, {}};
    density.values.resize(pixels.bytes.size() / (2 * max_channels));
    const png_byte* bytes = pixels.bytes.data();
    for (double& value : density.values) {
      value = darkness([&](std::size_t k) { return bytes[2 * k] * 256 + bytes[2 * k + 1]; });
      bytes += 2 * max_channels;
    }
    return density;
  });
}

}  // namespace vorpipe
