/// Pictures as PNG files, through libpng.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Writes width x height pixels (R in the lowest byte), the top row first, as 8-bit RGB, or as RGBA if a
/// pixel is not opaque; with a size on paper if there is one. The same pixels give the same bytes. Error
/// (device): writing failed.
Result<void> writePng(ByteSink& sink, int width, int height, std::span<const std::uint32_t> rgba,
                      const std::optional<PaperSize>& paper = {});

/// Reads a PNG of any kind into width, height and rgba (8 bits per channel, opaque if it has no alpha); ids
/// stays empty. Errors: no PNG, a damaged or truncated one (input); reading failed or memory ran out
/// (device).
Result<Image> readPng(const std::string& path);

/// Reads a PNG of any kind, including 16 bits per channel, as a density: 1 for black, 0 for white or
/// transparent, linear in its values between. Weights colors by Rec. 709. Errors: those of readPng.
Result<Density> readPngDarkness(const std::string& path);

/// The same of an image of 8 bits per channel.
Density darknessOf(const Image& image);

}  // namespace vorpipe
