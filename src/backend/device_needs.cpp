#include "backend/device_needs.h"

#include <algorithm>

#include "backend/cell_answers.h"
#include "backend/site_texels.h"
#include "base/parallel.h"
#include "layout.glsl"

namespace vorpipe {
namespace {

constexpr std::uint64_t million = 1'000'000, word = 4;
/// Color and id in the target, and again in the buffer that the host reads them from.
constexpr std::uint64_t target_pixel = 2 * word, download_pixel = 2 * word;
/// Of a row of neighbors with room for eight, and of the word beside it.
constexpr std::uint64_t row = EDGES_FAST * word, weighted_row = row + 4 * word;
constexpr std::uint64_t triangle_indices = 3 * (EDGES_MOST - 2) * word, polygon_vertices = EDGES_MOST * 16;

// Programs and drivers as measured with Mesa 22.3.6 and LLVM 15, with an empty shader cache, which needs
// more.
constexpr DeviceNeeds of_cpu =
    {  // Includes some megabytes for threads and for data smaller than per-site arrays.
        .program = 15 * million,
        .compiling = 0,
        .site = 0,
        .bin = 0,
        .mark = 0,
        .weight = 0,
        .heaviest = 0,
        .passing_site = 0,
        .entry = 0,
        .answer = row + 1,
        .weighted_answer = row + word + 1,
        .polygon = 0,
        .slice = UINT64_MAX,
        .drawn_slice = UINT64_MAX,
        .drawn = 0,
        .pixel = 0,
        .pool_pixel = 0,
        .resizing_pixel = 0,
        .rasterizing = 0,
        .largest_view = 8192,
        .devices = 1,
        .further_device = 0,
        .reserves_rows = false};

/// Needs that all devices have in common.
constexpr DeviceNeeds ofDevice() {
  DeviceNeeds needs = of_cpu;
  needs.site = sizeof(SiteTexel);
  needs.bin = word;
  needs.mark = sizeof(SiteMark);
  needs.weight = sizeof(WeightTexel);
  needs.heaviest = word;
  needs.entry = word;
  needs.answer = word + row;
  needs.weighted_answer = word + weighted_row;
  needs.pixel = target_pixel + download_pixel;
  needs.rasterizing = 70 * million;
  needs.largest_view = 4096;
  return needs;
}

DeviceNeeds ofCompute() {
  DeviceNeeds needs = ofDevice();
  needs.program = 90 * million + newer_driver_bytes;
  needs.compiling = 25 * million;
  needs.slice = std::uint64_t{1} << 18;
  needs.drawn_slice = std::uint64_t{1} << 17;
  needs.polygon = polygon_vertices + triangle_indices + 2 * word;
  needs.reserves_rows = true;
  return needs;
}

DeviceNeeds ofGeometry(int threads) {
  constexpr int most_devices = 8;
  DeviceNeeds needs = ofDevice();
  needs.program = 103 * million + newer_driver_bytes;
  needs.rasterizing = 48 * million;
  needs.compiling = 12 * million;
  needs.answer += word;  // the word is also copied to host memory
  needs.weighted_answer += word;
  needs.slice = needs.drawn_slice = std::uint64_t{1} << 16;
  needs.polygon = 2 * word;
  needs.drawn = sizeof(std::uint64_t);
  needs.pool_pixel = 2 * word;
  needs.devices = static_cast<std::uint64_t>(std::min(threadCount(threads), most_devices));
  needs.further_device = 5 * million;
  return needs;
}

DeviceNeeds ofOpenGl() {
  constexpr std::uint64_t status = 24 * (EDGES_FAST - 2);
  DeviceNeeds needs = ofDevice();
  needs.program = 97 * million + newer_driver_bytes + feedback_bytes;
  needs.compiling = 6 * million;
  needs.passing_site = sizeof(SiteTexel);
  needs.slice = feedback_bytes / needs.answer;
  needs.drawn_slice = feedback_bytes / status;
  needs.polygon = status;
  needs.pixel = target_pixel;
  needs.resizing_pixel = target_pixel;
  needs.rasterizing = 48 * million;
  return needs;
}

}  // namespace

DeviceNeeds deviceNeeds(std::string_view backend, int threads) {
  if (backend == "vulkan-compute") return ofCompute();
  // The backend behind these two names is only known once it is open; it needs no more.
  if (backend == "vulkan-geometry" || backend == "vulkan" || backend == "auto") return ofGeometry(threads);
  if (backend == "opengl") return ofOpenGl();
  return of_cpu;
}

}  // namespace vorpipe
