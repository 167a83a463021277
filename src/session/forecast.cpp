/// The forecast of memory: a table of bytes per site, as measured with a million sites of the kinds random,
/// square, clusters and circle. The kind that takes most counts, so the forecast may be 40 % too
/// high, and for pictures of even sites two or three times as high; never too low. tests/cli/forecast.sh
/// holds runs to it.
#include <algorithm>
#include <bit>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/try.h"
#include "vorpipe.h"
#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

using Array = MemoryPlan::Array;

constexpr std::uint64_t million = 1'000'000, word_size = 4, number_size = 8, point_size = 16;

/// Memory of a backend, in bytes. Of a device, it counts only where it is the host's memory. Drivers are
/// measured with Mesa 22.3.6 and LLVM 15; newer ones, as 25.0.7 with LLVM 19, need 17 MB more.
struct BackendMemory {
  std::string_view name;
  std::uint64_t program;              ///< code, libraries and driver, with compiled pipelines
  std::uint64_t site, weighted_site;  ///< while cells are found, for each site
  std::uint64_t drawing, drawn_site;  ///< while cells are drawn, in all and for each site
  std::uint64_t pixel;                ///< of a view
  std::uint64_t largest_view;         ///< width and height of a view, at most
  std::uint64_t further_device;       ///< for each device after the first, up to one per thread
};
constexpr BackendMemory backends[]{
    {"cpu", 16 * million, 0, 0, 0, 0, 0, 8192, 0},
    {"vulkan-compute", 117 * million, 25, 45, 75 * million, 8, 16, 4096, 0},
    {"vulkan-geometry", 127 * million, 30, 55, 50 * million, 20, 24, 4096, 5 * million},
    {"opengl", 175 * million, 65, 65, 50 * million, 8, 16, 4096, 0}};
/// Drivers that were looked through remain in memory.
constexpr std::uint64_t looked_through = 74 * million;

const BackendMemory& memoryOf(const Workload& work) {
  const auto* found = std::ranges::find(backends, work.backend, &BackendMemory::name);
  // "vulkan" and "auto": the backend behind these names is known once it is open, and needs no more.
  if (found == std::end(backends))
    found = std::ranges::find(backends, "vulkan-geometry", &BackendMemory::name);
  return *found;
}

std::uint64_t allSites(const Workload& work) { return work.sites + work.images; }

/// Memory that searches leave in the heap, in all.
std::uint64_t heapOf(const Workload& work) {
  return std::min<std::uint64_t>(10 * million, 400 * allSites(work));
}

/// Bytes per site or image at the peak of Session::cells, besides a device.
std::uint64_t peakOfCells(const Workload& work, Detail detail) {
  if (work.globe && work.outlined)
    return (detail == Detail::measures ? 780u : 915u) + (work.weighted ? 65u : 0u);
  if (work.globe) return (detail == Detail::measures ? 320u : 565u) + (work.weighted ? 50u : 0u);
  if (work.periodic) return work.outlined ? 700 : work.weighted ? 560 : 535;
  if (work.outlined) return detail == Detail::everything ? 660 : 635;
  constexpr std::uint64_t measures = 290, polygons = 400, everything = 495;
  return detail == Detail::everything ? everything : detail == Detail::polygons ? polygons : measures;
}

/// Bytes per site of a Diagram.
std::uint64_t bytesOfCells(Detail detail, bool measured_by_density) {
  constexpr std::uint64_t measures = point_size + 2 * number_size + 1 + word_size + mean_edges * number_size;
  constexpr std::uint64_t polygons = mean_edges * (point_size + number_size) + 4 * number_size,
                          triangles = word_size * 2 * 3;
  return measures + (detail == Detail::measures ? 0 : polygons) +
         (detail == Detail::everything ? triangles : 0) +
         (measured_by_density ? number_size + point_size : 0);
}

std::uint64_t imagePixels(const RenderOptions& options) {
  return static_cast<std::uint64_t>(options.width) * static_cast<std::uint64_t>(options.height);
}

/// Plans the views of a picture, on the device and as they are read; with several samples in a pixel, these
/// as well.
void planViews(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const BackendMemory& memory = memoryOf(work);
  auto width = static_cast<std::uint64_t>(options.width), height = static_cast<std::uint64_t>(options.height);
  if (options.antialias > 1) {
    const auto in_pixel = static_cast<std::uint64_t>(options.antialias);
    height = std::min(height, static_cast<std::uint64_t>(rowsAtOnce(options.width, options.antialias)));
    width *= in_pixel;
    height *= in_pixel;
    plan.take("samples of pixels", width * height * 2 * word_size);
  }
  const auto view = std::min(width, memory.largest_view) * std::min(height, memory.largest_view);
  plan.take("a view of the picture", view * 2 * word_size);
  if (work.device_on_host) plan.take("the picture on the device", view * memory.pixel);
}

/// Plans marksOf(): lists that grow by doubling.
void planMarks(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const auto lines = 3 * work.sites * sizeof(Line) * 3 / 2;
  if (options.edges && options.antialias > 1) plan.take("lines and labels", lines);
  if (options.dual) plan.take("lines and labels", lines);
  if (!options.labels) return;
  const double box = options.label_size * options.label_size;
  const auto fit = static_cast<std::uint64_t>(static_cast<double>(imagePixels(options)) / box);
  // Names may leave their cells, so that all wait for a place, among boxes that are taken.
  const bool all = hasNames(options) && options.show_sites;
  const std::uint64_t label = 2 * sizeof(SiteLabel) + (all ? 6 * sizeof(Box) : 0);
  plan.take("lines and labels", (all ? work.sites : std::min(work.sites, fit)) * label);
}

/// A table of sites between half and quarter full, and a tree over them.
std::uint64_t checkBytes(const Workload& work) {
  return (std::bit_ceil(2 * work.sites + 1) + 2 * work.sites) * word_size;
}

}  // namespace

Array MemoryPlan::take(std::string_view what, std::uint64_t bytes) {
  arrays_.push_back({std::string(what), bytes});
  bytes_ += bytes;
  if (bytes_ <= peak_) return arrays_.size() - 1;
  peak_ = bytes_;
  parts_.clear();
  for (const MemoryPart& array : arrays_) {
    if (array.bytes == 0) continue;
    const auto part = std::ranges::find(parts_, array.what, &MemoryPart::what);
    part == parts_.end() ? parts_.push_back(array) : void(part->bytes += array.bytes);
  }
  std::ranges::stable_sort(parts_, std::greater<>(), &MemoryPart::bytes);
  return arrays_.size() - 1;
}

void MemoryPlan::drop(Array array) { bytes_ -= std::exchange(arrays_[array].bytes, 0); }

void MemoryPlan::dropSince(Array first, const std::vector<Array>& kept) {
  for (auto array = first; array < arrays_.size(); ++array) {
    if (std::ranges::find(kept, array) == kept.end()) drop(array);
  }
}

Result<Workload> workloadOf(const Sites& sites, const CellsOptions& options, ImagesFor purpose,
                            const DeviceInfo& device, int threads) {
  Workload work;
  work.sites = sites.size();
  work.weighted = !sites.weight.empty();
  work.outlined = !options.outline.empty();
  work.periodic = options.periodic != Periodic::none;
  work.globe = options.globe;
  work.density_pixels = options.density.values.size();
  work.backend = device.backend;
  work.device_on_host = device.type == "cpu";
  work.beside_drivers = device.beside_drivers;
  work.threads = threads;
  VORPIPE_LET(all, sitesAndImages(sites, options.domain, options.periodic, purpose, threads));
  work.images = all - work.sites;
  return work;
}

ImagesFor imagesFor(ColorBy color) { return colorsNeedCells(color) ? ImagesFor::cells : ImagesFor::pictures; }

ImagesFor imagesFor(const RenderOptions& options) {
  return marksNeedCells(options) ? ImagesFor::cells : imagesFor(options.color);
}

void planSession(MemoryPlan& plan, const Workload& work) {
  plan.take("the program, its libraries and the driver", memoryOf(work).program);
  if (work.beside_drivers) plan.take("drivers that were looked through for hardware", looked_through);
}

Array planCells(MemoryPlan& plan, const Workload& work, Detail detail) {
  const BackendMemory& memory = memoryOf(work);
  const auto start = plan.next();
  if (work.device_on_host && !work.globe) {
    plan.take("sites on the device", allSites(work) * (work.weighted ? memory.weighted_site : memory.site));
  }
  const bool massive = work.density_pixels > 0;
  if (massive) plan.take("masses", work.sites * 22);
  plan.take("the search for cells", allSites(work) * peakOfCells(work, detail));
  plan.dropSince(start);
  return plan.take("cells", work.sites * bytesOfCells(detail, massive));
}

namespace {

/// A picture of the globe: its cells, in an outline also those of all the Earth, what the walk over them
/// needs, and samples of some rows.
Array planGlobePicture(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const auto start = plan.next();
  planCells(plan, work, marksDetail(options));
  if (work.outlined) {
    Workload whole = work;
    whole.outlined = false;
    planCells(plan, whole, Detail::measures);
  }
  constexpr std::uint64_t walked_site = 85, lines_of_site = 220, samples_at_once = std::uint64_t{1} << 22;
  plan.take("colors and statuses", work.sites * walked_site);
  if (options.dual || (options.edges && options.antialias > 1))
    plan.take("lines and labels", work.sites * lines_of_site);
  planMarks(plan, work, options);
  const auto in_pixel = static_cast<std::uint64_t>(options.antialias * options.antialias);
  if (in_pixel > 1)
    plan.take("samples", 2 * word_size * std::min(samples_at_once, in_pixel * imagePixels(options)));
  const auto image =
      plan.take("the picture", imagePixels(options) * 2 * word_size + work.sites * (word_size + 1));
  plan.dropSince(start, {image});
  return image;
}

}  // namespace

Array planPicture(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  if (work.globe) return planGlobePicture(plan, work, options);
  const bool known = imagesFor(options.color) == ImagesFor::cells || work.weighted || work.outlined;
  const BackendMemory& memory = memoryOf(work);
  const auto start = plan.next();
  if (known || marksNeedCells(options)) plan.drop(planCells(plan, work, marksDetail(options)));
  // The picture's sites, and what the search keeps for it.
  constexpr std::uint64_t known_site = 200, searched_site = 190;
  plan.take("the search for cells", allSites(work) * (known ? known_site : searched_site));
  plan.take("colors and statuses", allSites(work) * (number_size + 2 * word_size));
  plan.take("the search for cells", heapOf(work));
  planMarks(plan, work, options);
  if (work.device_on_host) {
    plan.take("the driver", memory.drawing);
    plan.take("sites on the device", allSites(work) * memory.drawn_site);
    const auto devices = static_cast<std::uint64_t>(threadCount(work.threads));
    plan.take("the driver", (devices - 1) * memory.further_device);
  }
  planViews(plan, work, options);
  const auto image =
      plan.take("the picture", imagePixels(options) * 2 * word_size + work.sites * (word_size + 1));
  plan.dropSince(start, {image});
  return image;
}

void planCellsCheck(MemoryPlan& plan, const Workload& work, Detail detail) {
  constexpr std::uint64_t tree = 2 * word_size + number_size, sides = word_size * 2 * 3 * 4 + word_size;
  constexpr std::uint64_t most_sampled = 10'000, nearest_of_corner = 4 * point_size;
  const auto sampled = std::min(work.sites, most_sampled) * (mean_edges + 1) * nearest_of_corner;
  const auto by_site = tree + mean_edges * word_size + (detail == Detail::everything ? sides : 0);
  plan.drop(plan.take("the check", checkBytes(work) + work.sites * by_site + sampled));
}

void planPictureCheck(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  constexpr std::uint64_t tree = 2 * word_size + number_size, compared = word_size + 1;
  plan.drop(plan.take("the check", checkBytes(work) + work.sites * tree + imagePixels(options) * compared));
}

}  // namespace vorpipe
