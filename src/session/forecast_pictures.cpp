/// Memory of Session::render, array by array: each line stands for one of picture.cpp and its callees.
#include <algorithm>
#include <bit>

#include "backend/backend.h"
#include "session/forecast.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

using namespace core;

namespace {

/// Plans the device's render targets, and the arrays that a view is read into.
Arrays planViews(MemoryPlan& plan, const Workload& work, std::uint64_t width, std::uint64_t height) {
  const DeviceNeeds needs = needsOf(work);
  const auto largest = static_cast<std::uint64_t>(needs.largest_view);
  const auto view = std::min(width, largest) * std::min(height, largest);
  const bool several = width > largest || height > largest;
  if (work.device_on_host) {
    const auto devices = plannedDevices(needs, work.sites);
    for (std::uint64_t k = 0; k < devices; ++k) plan.take("the picture on the device", view * needs.pixel);
    if (several) plan.take("the picture on the device", view * needs.resizing_pixel);
  }
  return {plan.take("a view of the picture", view * 2 * word),
          plan.take("a view of the picture", view * needs.pool_pixel)};
}

/// Plans a device's memory for drawing sites: the polygons of a slice at a time.
void planDrawing(MemoryPlan& plan, const Workload& work, std::uint64_t sites) {
  const DeviceNeeds needs = needsOf(work);
  planUpload(plan, work, sites, true);
  const auto step = plannedStep(sites);
  const auto fast = plan.take("the search", sites * word);
  if (work.device_on_host && needs.entry > 0) {
    plan.take("the driver", needs.rasterizing);
    const auto slice = std::min(step, needs.drawn_slice);
    plan.take("polygons on the device", slice * needs.polygon + step * needs.entry);
  }
  plan.take("when cells were drawn", sites * needs.drawn);
  plan.drop(fast);
}

/// Plans cells that the device finds and draws, and those that the judge finds.
Arrays planSearchAndDrawing(MemoryPlan& plan, const Workload& work, std::uint64_t sites) {
  Arrays kept{plan.take("the search", sites * word)};
  const auto even = plan.take("the search", sites * word);
  const auto rest = plan.take("the search", sites * word);
  planDrawing(plan, work, sites);
  // The rows of cells left to the judge: with many sites there are always some.
  kept.push_back(plan.take("neighbors of cells", sites * (number + 2 * word)));
  append(kept, {even, rest});
  // All cells may be left to it, and come from a triangulation, which stays with the session.
  const auto lists = plan.take("the search", sites * (5 * word + 3));
  append(kept, planMesh(plan, work, sites));
  kept.push_back(plan.take("neighbors of cells", sites * (6 * word + number + word + 1)));
  plan.drop(plan.take("the search", sites * (number + 2 * word)));
  plan.drop(lists);
  return kept;
}

/// Plans known cells drawn as polygons, some at a time.
Arrays planPolygons(MemoryPlan& plan, const Workload& work, std::uint64_t sites) {
  const DeviceNeeds needs = needsOf(work);
  Arrays kept{plan.take("the search", sites * word)};
  if (needs.entry == 0) return kept;  // cpu has no triangles
  constexpr std::uint64_t cells_at_once = 1 << 16;
  const auto corners = std::min(sites, cells_at_once) * mean_edges;
  const auto bytes = corners * sizeof(DrawMark) + 3 * corners * word;
  const Arrays passing{plan.take("triangles of cells", bytes), plan.take("triangles of cells", bytes)};
  if (work.device_on_host) {
    plan.take("the driver", needs.rasterizing);
    plan.take("triangles on the device", bytes);
  }
  plan.drop(passing);
  plan.take("when cells were drawn", sites * needs.drawn);
  return kept;
}

/// Plans a nanoflann tree over all sites, from which "cpu" draws.
void planNearest(MemoryPlan& plan, const Workload& work, std::uint64_t sites) {
  if (work.backend != "cpu") return;
  // Leaves have up to sixteen sites, a dozen on average.
  constexpr std::uint64_t node = 5 * number, leaf_sites = 12;
  plan.take("the search tree of pixels", sites * (2 * word + (work.weighted ? number : 0)));
  plan.take("the search tree of pixels", 2 * sites / leaf_sites * node);
}

/// Plans sceneOf: the sites of a periodic domain with their images.
Arrays planScene(MemoryPlan& plan, const Workload& work) {
  if (!work.periodic) return {};
  const std::string_view what = "sites and images";
  const int coordinates = work.weighted ? 3 : 2;
  Arrays placed{plan.take(what, work.sites * 2)};
  for (int k = 0; k < coordinates; ++k) placed.push_back(plan.take(what, work.sites * number));
  Arrays scene{plan.take(what, 2 * work.images * number)};
  for (int k = 0; k < coordinates; ++k) {
    const auto copy = plan.take(what, work.sites * number);
    scene.push_back(plan.take(what, 2 * work.sites * number, (work.sites + work.images) * number));
    plan.drop(copy);
  }
  plan.drop(placed);
  return scene;
}

/// For any color: cells are known if weights or an outline require them.
bool cellsAreKnown(const Workload& work, ColorBy color) {
  return color == ColorBy::area || color == ColorBy::neighbors || work.weighted || work.outlined;
}

/// Plans marksOf(), whose lines grow by doubling.
Arrays planMarks(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const std::string_view what = "lines and labels";
  const auto edges = work.sites * mean_edges / 2;
  const std::uint64_t line = sizeof(Line), capacity = std::bit_ceil(edges);
  Arrays kept;
  const auto lines = [&] {
    const auto shorter = plan.take(what, capacity / 2 * line);
    kept.push_back(plan.take(what, capacity * line, edges * line));
    plan.drop(shorter);
  };
  if (options.edges && options.antialias > 1) lines();
  if (options.dual) lines();
  if (options.labels) {
    if (work.periodic) plan.drop(plan.take(what, 2 * work.sites * number));
    const double box = options.label_size * options.label_size;
    const auto room = static_cast<std::uint64_t>(options.width / box * options.height);
    kept.push_back(plan.take(what, std::min(work.sites, room) * 2 * sizeof(SiteLabel)));
  }
  return kept;
}

/// Plans the places of pixels, some rows of them at a time.
Arrays planPlaces(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const auto in_pixel = static_cast<std::uint64_t>(options.antialias);
  const auto rows =
      static_cast<std::uint64_t>(std::min(options.height, rowsAtOnce(options.width, options.antialias)));
  const auto width = in_pixel * static_cast<std::uint64_t>(options.width), height = in_pixel * rows;
  Arrays passing{plan.take("places of pixels", 2 * width * height * word)};
  append(passing, planViews(plan, work, width, height));
  return passing;
}

}  // namespace

Arrays planPicture(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const ColorBy color = options.color;
  const bool known = cellsAreKnown(work, color), marked = marksNeedCells(options);
  const auto sites = work.sites + work.images;
  Arrays working, image, marks;
  if (known) {
    const PlannedCells cells = planCellsFor(plan, work, marksDetail(options), ImagesFor::pictures);
    append(working, cells.diagram);
    append(working, cells.run);
  } else {
    append(working, planScene(plan, work));
    const PlannedSet set = planPrepare(plan, sites, work.weighted);
    append(working, set.sites);
    image.push_back(set.owner);
  }
  if (marked) {
    const Arrays cells = known ? Arrays{} : planCells(plan, work, marksDetail(options));
    marks = planMarks(plan, work, options);
    plan.drop(cells);
  }
  working.push_back(plan.take("colors of sites", work.sites));
  if (color != ColorBy::site) plan.drop(plan.take("colors of sites", work.sites * number));
  working.push_back(plan.take("colors of sites", sites));
  working.push_back(plan.take("statuses", sites + sites / number));
  const auto width = static_cast<std::uint64_t>(options.width);
  const auto height = static_cast<std::uint64_t>(options.height);
  for (int k = 0; k < 2; ++k) image.push_back(plan.take("the picture", width * height * word));
  // Memory that searches leave in the heap, measured up to two million sites.
  plan.take("the search", std::min<std::uint64_t>(9'000'000, 256 * work.sites));
  append(working, known ? planPolygons(plan, work, sites) : planSearchAndDrawing(plan, work, sites));
  const Arrays views = planViews(plan, work, width, height);
  planNearest(plan, work, sites);
  image.push_back(plan.take("statuses", work.sites));
  image.push_back(plan.take("owners", work.sites * word));
  if (options.antialias > 1) plan.drop(views);
  append(working, options.antialias > 1 ? planPlaces(plan, work, options) : views);
  planReserve(plan);
  plan.drop(working);
  plan.drop(marks);
  return image;
}

Arrays planPicture(MemoryPlan& plan, const Workload& work, int width, int height, ColorBy color) {
  RenderOptions options{};
  options.width = width;
  options.height = height;
  options.color = color;
  return planPicture(plan, work, options);
}

ImagesFor imagesFor(const RenderOptions& options) {
  return marksNeedCells(options) ? ImagesFor::cells : imagesFor(options.color);
}

void planPictureCheck(MemoryPlan& plan, const Workload& work, int width, int height) {
  std::uint64_t slots = 1;
  while (slots < 2 * work.sites + 1) slots *= 2;
  const auto tree = plan.take("the check", work.sites * (2 * word + number));
  const auto owners = plan.take("the check", (slots + 2 * work.sites) * word);
  plan.drop(owners);
  // Expected ids, and how each compares.
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const auto compared = plan.take("the check", pixels * (word + 1));
  plan.drop({compared, tree});
}

}  // namespace vorpipe
