/// Memory of Session::cells, array by array: each line stands for one of cells_run.cpp and its callees.
#include <algorithm>
#include <utility>

#include "cells/cell_record.h"
#include "session/forecast.h"

namespace vorpipe {

using namespace core;

namespace {

/// Edges that the search proposes per cell: 6 on average, since cells cover the plane, plus some that only
/// one of two cells has, at points where four cells meet.
constexpr double proposed_edges = 6.3;

/// Plans findNeighbors; returns the arrays that remain.
Arrays planNeighbors(MemoryPlan& plan, const Workload& work, std::uint64_t sites) {
  const DeviceNeeds needs = needsOf(work);
  const std::string_view rows = "neighbors of cells", search = "the search";
  const auto inside = plan.take(search, sites * word);
  Arrays kept{plan.take(rows, sites * (number + 2 * word))};
  const auto even = plan.take(search, sites * word);
  planUpload(plan, work, sites, false);
  const auto rest = plan.take(search, sites * word);
  const auto step = plannedStep(sites);
  const auto answer = work.weighted ? needs.weighted_answer : needs.answer;
  if (work.device_on_host && needs.entry > 0) {
    const auto slices = std::min(step, needs.devices * needs.slice);
    plan.take("answers of the device", slices * answer + step * needs.entry);
  }
  // If a device returns its answers in parts, rows are assembled from them.
  const auto row = partOf(word, proposed_edges);
  for (std::uint64_t done = 0; done < sites; done += step) {
    const auto here = std::min(step, sites - done);
    const auto status = plan.take(search, here * (number + 1));
    if (needs.entry == 0) {
      const auto answers = plan.take(search, here * answer);
      kept.push_back(plan.take(rows, here * row));
      plan.drop(answers);
    } else if (needs.reserves_rows) {
      kept.push_back(plan.take(rows, here * (answer - word), here * row));
    } else {
      const auto before = plan.take(search, here * row);
      kept.push_back(plan.take(rows, 2 * here * row, here * row));
      plan.drop(before);
    }
    plan.drop(status);
  }
  plan.drop({rest, even, inside});
  // All cells may come from a triangulation instead of a device.
  plan.drop({kept.begin() + 1, kept.end()});
  kept.resize(1);
  const auto wanted = plan.take(search, sites);
  const auto mesh = planMesh(plan, work, sites);
  const auto walls = plan.take(search, 2 * sites);
  kept.push_back(plan.take(rows, sites * (row + number + word + 1)));
  plan.drop(mesh);
  plan.drop({walls, wanted});
  if (work.weighted) {
    const auto all = plan.take(search, sites * word);
    plan.drop(all);
  }
  return kept;
}

/// Plans reconcileCells: a tied cell has a corner for each edge, and each
/// vertex has three corners, or more at ties.
Arrays planTies(MemoryPlan& plan, const Workload& work, std::uint64_t sites) {
  const std::string_view what = "vertices at ties";
  constexpr std::uint64_t one_in = 8;
  const auto cells = work.on_lattice ? sites : sites / one_in;
  const auto corners = partOf(cells, proposed_edges + 0.7);
  const auto vertices = partOf(cells, 2);
  const auto rough = plan.take("the check of cells", sites);
  Arrays kept{plan.take(what, sites * word)};
  // These lists grow by doubling.
  const auto shorter = plan.take(what, cells * (number + word) / 2);
  kept.push_back(plan.take(what, cells * number));
  kept.push_back(plan.take(what, cells * word));
  plan.drop(shorter);
  const auto sets = plan.take(what, corners * word + 2 * cells);
  for (const auto bytes : {1 * corners, word * corners, 33 * vertices, word * vertices, word * corners}) {
    kept.push_back(plan.take(what, bytes));
  }
  const auto next = plan.take(what, vertices * word);
  plan.drop({next, sets, rough});
  return kept;
}

/// Plans the arrays of a Diagram of `sites` sites.
Arrays planArrays(MemoryPlan& plan, std::uint64_t sites, Detail detail) {
  const auto edges = sites * mean_edges;
  Arrays arrays;
  const auto take = [&](std::string_view what, std::uint64_t bytes) {
    arrays.push_back(plan.take(what, bytes));
  };
  if (detail != Detail::measures) {
    take("vertices", edges * point);
    take("lengths of edges", edges * number);
    take("second moments", sites * 3 * number);
    take("perimeters", sites * number);
  }
  take("neighbors", edges * number);
  take("areas and centroids", sites * point);
  take("areas and centroids", sites * number);
  take("where cells begin", sites * number);
  take("statuses", sites);
  return arrays;
}

/// Plans clipToOutline, which replaces all arrays by edge.
void planClipping(MemoryPlan& plan, const Workload& work, Arrays& arrays) {
  const auto edges = work.sites * mean_edges;
  const std::string_view what = "cells clipped to the outline";
  const auto fate = plan.take(what, work.sites * (number + 1));
  const auto first = plan.take(what, work.sites * number);
  for (const auto bytes :
       {work.sites * number, work.sites * number, edges * point, edges * number, edges * number}) {
    arrays.push_back(plan.take(what, bytes));
  }
  // They replace the first, second, fifth and eighth arrays of makeArrays.
  plan.drop({arrays[0], arrays[1], arrays[4], arrays[7], first, fate});
}

/// Plans boxDiagramOn for all sites, including images. For pictures, and for masses of cells, the data of the
/// search stays.
PlannedCells planRun(MemoryPlan& plan, const Workload& work, std::uint64_t sites, Detail detail,
                     ImagesFor purpose) {
  PlannedSet set = planPrepare(plan, sites, work.weighted);
  Arrays working = planNeighbors(plan, work, sites);
  const auto records = plan.take("records of cells", sites * sizeof(CellRecord));
  const auto ties = planTies(plan, work, sites);
  const Detail found = work.outlined ? std::max(detail, Detail::polygons) : detail;
  Arrays arrays = planArrays(plan, sites, found);
  const bool triangulated = detail == Detail::everything && !work.periodic;
  // If a tie hides a triangle, all are made anew. This happens in 1 of 8 random sets of a million sites, and
  // 5 of 8 of two million. No array of the mesh fits in a gap.
  if (triangulated) plan.drop(planMesh(plan, work, sites));
  plan.drop(records);
  if (triangulated) {
    arrays.push_back(plan.take("triangles", 2 * sites * 3 * word));
    const auto numbers = plan.take("triangles", sites * (word + (work.weighted ? 1 : 0)));
    plan.drop(numbers);
  }
  if (work.outlined) planClipping(plan, work, arrays);
  planReserve(plan);
  // The mesh of all sites also leaves gaps.
  if (triangulated && !work.weighted) planReserve(plan);
  if (triangulated && work.outlined) planReserve(plan);
  // Then the search is the peak: a second step, shorter than the first, leaves gaps of up to 10 %.
  if (found == Detail::measures && (work.weighted || sites > plannedStep(sites))) {
    planReserve(plan);
    if (!work.weighted) planReserve(plan);
  }
  plan.drop(ties);
  append(working, set.sites);
  if (purpose == ImagesFor::cells) plan.drop(std::exchange(working, {}));
  arrays.push_back(set.owner);
  return {std::move(arrays), std::move(working)};
}

/// Plans periodicCellsOn around that: the sites as placed in the domain, and with their images.
PlannedCells planPeriodic(MemoryPlan& plan, const Workload& work, Detail detail, ImagesFor purpose) {
  const std::string_view what = "sites and images";
  const auto all = work.sites + work.images;
  const std::uint64_t coordinates = work.weighted ? 3 : 2;
  Arrays placed;
  for (std::uint64_t k = 0; k < coordinates; ++k) placed.push_back(plan.take(what, work.sites * number));
  placed.push_back(plan.take(what, work.sites * 2));
  // A copy that grows by the images.
  for (std::uint64_t k = 0; k < coordinates; ++k) {
    const auto copy = plan.take(what, work.sites * number);
    placed.push_back(plan.take(what, 2 * work.sites * number, all * number));
    plan.drop(copy);
  }
  placed.push_back(plan.take(what, 2 * work.images * number));
  PlannedCells cells = planRun(plan, work, all, std::max(detail, Detail::polygons), purpose);
  cells.diagram.push_back(plan.take("shifts of neighbors", work.sites * mean_edges * 2 * word));
  if (purpose == ImagesFor::cells) {
    plan.drop(placed);
  } else {
    append(cells.run, placed);
  }
  return cells;
}

/// Plans measureMass. Its memory beside the masses does not fit in the reserve of the cells, which is used up
/// if polygons are not wanted.
void planMasses(MemoryPlan& plan, const Workload& work, Arrays& arrays) {
  arrays.push_back(plan.take("masses", work.sites * number));
  arrays.push_back(plan.take("masses", work.sites * point));
  if (work.periodic) {
    const auto placed = plan.take("sites and images", work.sites * (work.weighted ? 3 : 2) * number);
    plan.drop(placed);
  }
  planReserve(plan);
}

}  // namespace

PlannedCells core::planCellsFor(MemoryPlan& plan, const Workload& work, Detail detail, ImagesFor purpose) {
  const bool massive = work.density_pixels > 0;
  const auto until = massive ? ImagesFor::pictures : purpose;
  PlannedCells cells = work.periodic ? planPeriodic(plan, work, detail, until)
                                     : planRun(plan, work, work.sites, detail, until);
  Arrays& arrays = cells.diagram;
  // Polygons that were not requested.
  if (detail == Detail::measures && work.periodic) {
    plan.drop({arrays[0], arrays[1], arrays[2], arrays[3]});
  }
  if (massive) planMasses(plan, work, arrays);
  if (purpose == ImagesFor::cells) plan.drop(std::exchange(cells.run, {}));
  return cells;
}

Arrays planCells(MemoryPlan& plan, const Workload& work, Detail detail) {
  return planCellsFor(plan, work, detail, ImagesFor::cells).diagram;
}

void planCellsCheck(MemoryPlan& plan, const Workload& work, Detail detail) {
  const std::string_view what = "the check";
  // Owners by position, in a table between half and quarter full; the tree; corners of twins.
  std::uint64_t slots = 1;
  while (slots < 2 * work.sites + 1) slots *= 2;
  const auto tree = plan.take(what, work.sites * (2 * word + number));
  const auto owners = plan.take(what, (slots + 2 * work.sites) * word);
  plan.drop(owners);
  const auto edges = work.sites * mean_edges;
  const auto twins = plan.take(what, edges * word);
  if (detail == Detail::everything) {
    constexpr std::uint64_t side = 4 * word;
    const auto sides = plan.take(what, 2 * work.sites * 3 * side);
    const auto after = plan.take(what, work.sites * word);
    plan.drop({after, sides});
  }
  // Places of sampled cells, with what is nearest.
  constexpr std::uint64_t most_sampled = 10'000, place = 4 * point;
  const auto sampled = std::min(work.sites, most_sampled) * (mean_edges + 1);
  const auto places = plan.take(what, sampled * place);
  plan.drop({places, twins, tree});
}

}  // namespace vorpipe
