/// What Session::render takes, array by array: each line stands for one of picture.cpp and of what it calls.
#include <algorithm>

#include "core/forecast/forecast.h"

namespace vorpipe {

using namespace core;

namespace {

using Arrays = std::vector<MemoryPlan::Array>;

/// Plans what the device draws into, and the arrays that a view is read into.
Arrays planViews(MemoryPlan& plan, const Workload& work, std::uint64_t width, std::uint64_t height) {
  const DeviceNeeds needs = needsOf(work);
  const auto largest = static_cast<std::uint64_t>(needs.largest_view);
  const auto view = std::min(width, largest) * std::min(height, largest);
  const bool several = width > largest || height > largest;
  if (work.device_on_host) {
    const auto devices = std::clamp<std::uint64_t>(
        needs.device_cells == 0 ? 1 : work.sites / needs.device_cells, 1, needs.devices);
    for (std::uint64_t k = 0; k < devices; ++k) plan.take("the picture on the device", view * needs.pixel);
    if (several) plan.take("the picture on the device", view * needs.resizing_pixel);
  }
  return {plan.take("a view of the picture", view * 2 * word),
          plan.take("a view of the picture", view * needs.pool_pixel)};
}

/// Plans what a device takes to draw sites: the polygons of a slice at a time.
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

/// A tree of nanoflann over all sites, from which "cpu" draws.
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

}  // namespace

Arrays planPicture(MemoryPlan& plan, const Workload& work, int width, int height, ColorBy color) {
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const bool measured =
      color == ColorBy::area || color == ColorBy::neighbors || work.weighted || work.outlined;
  const Arrays cells = measured ? planCells(plan, work, Detail::measures) : Arrays{};
  const auto sites = work.sites + work.images;
  const Arrays scene = planScene(plan, work);
  const PlannedSet set = planPrepare(plan, sites, work.weighted);
  Arrays working{plan.take("colors of sites", sites * (word + 1))};
  if (color != ColorBy::site) plan.drop(plan.take("colors of sites", sites * number));
  working.push_back(plan.take("statuses", sites + sites / number));
  Arrays image{plan.take("the picture", pixels * word), plan.take("the picture", pixels * word)};
  const auto on_device = plan.take("the search", sites * word);
  const auto even = plan.take("the search", sites * word);
  const auto rest = plan.take("the search", sites * word);
  planDrawing(plan, work, sites);
  plan.drop({rest, even});
  for (const auto array : planJudge(plan, work, sites)) working.push_back(array);
  working.push_back(on_device);
  for (const auto array :
       planViews(plan, work, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height))) {
    working.push_back(array);
  }
  planNearest(plan, work, sites);
  image.push_back(plan.take("statuses", work.sites));
  planReserve(plan);
  plan.drop(working);
  plan.drop(set.sites);
  plan.drop(scene);
  plan.drop(cells);
  image.push_back(set.owner);
  return image;
}

void planPictureCheck(MemoryPlan& plan, const Workload& work, int width, int height) {
  std::uint64_t slots = 1;
  while (slots < 2 * work.sites + 1) slots *= 2;
  const auto tree = plan.take("the check", work.sites * (2 * word + number));
  const auto owners = plan.take("the check", (slots + 2 * work.sites) * word);
  plan.drop(owners);
  // Ids as they should be, and how each compares.
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const auto compared = plan.take("the check", pixels * (word + 1));
  plan.drop({compared, tree});
}

}  // namespace vorpipe
