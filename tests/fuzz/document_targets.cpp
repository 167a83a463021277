/// Outlines, densities, pictures, checkpoints, reports and scripts.
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cli/stats.h"
#include "io/cells/fluid_state.h"
#include "io/pictures/jpeg_file.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"
#include "io/sites/density_file.h"
#include "io/sites/outline_file.h"
#include "io/sites/site_domain.h"
#include "session.h"
#include "target.h"
#include "unit/fixtures/script_line.h"
#include "view/script.h"
#include "vorpipe/fluid.h"

namespace vorpipe::fuzz {
namespace {

/// Polygons that GEOS gets to see: a few, since what it does takes long.
constexpr std::size_t most_points = 60;

bool isPartition(const std::vector<std::uint64_t>& offsets, std::size_t end) {
  return !offsets.empty() && offsets.front() == 0 && offsets.back() == end && std::ranges::is_sorted(offsets);
}

void fuzzOutline(std::string_view bytes, std::string_view extension) {
  const std::string& path = fileOf(extension, bytes);
  auto read = readOutline(path);
  if (!read) return requireTold(read.error(), path);
  Outline* const outline = &read->outline;
  require(isPartition(outline->ring_offsets, outline->points.size()), "rings share the points");
  require(isPartition(outline->polygon_offsets, outline->ring_offsets.size() - 1),
          "polygons share the rings");
  if (outline->points.size() > most_points) return;
  PlacedSites placed;
  placed.sites.x = {0.25, 0.75, 0.5};
  placed.sites.y = {0.25, 0.5, 0.75};
  DomainSettings settings;
  settings.outline = std::move(*outline);
  settings.outline_system = read->system;
  settings.repair = bytes.size() % 2 == 1;
  const auto found = findDomain(settings, placed);
  if (!found) return requireTold(found.error(), "domain: ");
  require(placed.domain.xmin < placed.domain.xmax && placed.domain.ymin < placed.domain.ymax,
          "a domain has an area");
}

void requirePixels(std::size_t pixels, int width, int height) {
  require(width > 0 && height > 0, "a picture has pixels");
  require(pixels == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "each pixel is there");
}

void requirePicture(const Result<Image>& image, const std::string& path) {
  if (!image) return requireTold(image.error(), path);
  requirePixels(image->rgba.size(), image->width, image->height);
}

void fuzzDensity(std::string_view bytes, std::string_view extension) {
  const std::string& path = fileOf(extension, bytes);
  const auto density = readDensity(path);
  if (!density) return requireTold(density.error(), path);
  requirePixels(density->density.values.size(), density->density.width, density->density.height);
  for (const double value : density->density.values)
    require(std::isfinite(value) && value >= 0, "a density is 0 or more");
}

}  // namespace

void fuzzOutlineGeoJson(std::string_view bytes) { fuzzOutline(bytes, "geojson"); }
void fuzzOutlineWkt(std::string_view bytes) { fuzzOutline(bytes, "wkt"); }

void fuzzDensityNpy(std::string_view bytes) { fuzzDensity(bytes, "npy"); }

void fuzzPng(std::string_view bytes) {
  fuzzDensity(bytes, "png");
  const std::string& path = fileOf("png", bytes);
  requirePicture(readPng(path), path);
}

void fuzzJpeg(std::string_view bytes) {
  fuzzDensity(bytes, "jpg");
  const std::string& path = fileOf("jpg", bytes);
  requirePicture(readJpeg(path), path);
}

void fuzzIds(std::string_view bytes) {
  const std::string& path = fileOf("npy", bytes);
  const auto image = readNpyIds(path);
  if (!image) return requireTold(image.error(), path);
  requirePixels(image->ids.size(), image->width, image->height);
}

namespace {

std::size_t numberAt(std::string_view bytes, std::size_t at, std::size_t size) {
  std::size_t number = 0;
  for (std::size_t k = size; k-- > 0;) {
    number = number << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0U);
  }
  return number;
}

/// An archive with the checksums that its entries have: a wrong one would hide all that was changed besides.
std::string withChecksums(std::string_view archive) {
  std::string bytes(archive);
  constexpr std::string_view entry = "PK\1\2";
  for (auto at = bytes.find(entry); at != std::string::npos; at = bytes.find(entry, at + 1)) {
    const std::size_t local = numberAt(bytes, at + 42, 4), size = numberAt(bytes, at + 24, 4);
    const std::size_t begin = local + 30 + numberAt(bytes, local + 26, 2) + numberAt(bytes, local + 28, 2);
    if (at + 20 > bytes.size() || begin > bytes.size() || size > bytes.size() - begin) continue;
    auto checksum = crc32_z(0, reinterpret_cast<const Bytef*>(&bytes[begin]), size);
    for (std::size_t k = 0; k < 4; ++k, checksum >>= 8)
      bytes[at + 16 + k] = static_cast<char>(checksum & 0xFF);
  }
  return bytes;
}

}  // namespace

void fuzzCheckpoint(std::string_view bytes) {
  constexpr std::size_t most_fluid_sites = 16;
  const std::string& path = fileOf("npz", withChecksums(bytes));
  auto setup = readFluid(path);
  if (!setup) return requireTold(setup.error(), path);
  if (setup->state.sites.size() > most_fluid_sites) return;
  setup->options.diagrams = std::min<std::uint64_t>(setup->options.diagrams, 4);
  const auto fluid = Fluid::begin(session(), setup->state, setup->options);
  if (!fluid) return requireTold(fluid.error(), "");
  require(fluid->state().sites.size() == setup->state.sites.size(), "a fluid keeps its sites");
}

void fuzzRecordedRun(std::string_view bytes) {
  const auto run = cli::recordedRun("run.json", bytes);
  if (!run) return requireTold(run.error(), "run.json: ");
  require(!run->arguments.empty(), "a run has arguments");
}

void fuzzScript(std::string_view bytes) {
  const auto script = view::parseScript("script", bytes);
  if (!script) return requireTold(script.error(), "script:");
  for (const view::ScriptLine& line : script->lines) {
    const std::string text = view::scriptLine(line.event);
    const auto again = view::parseScript("script", text);
    require(again && again->lines.size() == 1, "an event that was written is read: " + text);
    require(view::scriptLine(again->lines[0].event) == text, "an event comes back the same: " + text);
  }
}

}  // namespace vorpipe::fuzz
