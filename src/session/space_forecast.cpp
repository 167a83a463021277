#include "vorpipe.h"

namespace vorpipe {
namespace {

// Averages of cells of white noise, rounded up; others have fewer faces.
constexpr std::uint64_t faces_of_cell = 16, ring_entries_of_cell = 82, vertices_of_site = 7,
                        labels_of_vertex = 4;

/// Of a site's record, without and with what belongs to polyhedra.
constexpr std::uint64_t record_bytes = sizeof(Status) + sizeof(std::uint32_t) + 2 * sizeof(double) +
                                       sizeof(Point3) + sizeof(std::uint64_t),
                        face_bytes = sizeof(std::int64_t) + sizeof(double);

std::uint64_t polyhedronBytes() {
  return sizeof(double[6]) + faces_of_cell * sizeof(std::uint64_t) +
         ring_entries_of_cell * sizeof(std::uint32_t) +
         vertices_of_site *
             (sizeof(Point3) + sizeof(std::uint64_t) + labels_of_vertex * sizeof(std::int64_t));
}

}  // namespace

MemoryPlan::Array planCells(MemoryPlan& plan, const Workload& work, Detail3 detail) {
  // Rows, sites in the order of their bins, and places, besides the cells that are written meanwhile. As
  // measured with crystals whose cells are found by exact signs, and with random sites, whose polyhedra take
  // more.
  constexpr std::uint64_t searched_measures = 880, searched_polyhedra = 800, weight_bytes = 16;
  // Their places, twice, and whose they are.
  constexpr std::uint64_t image_bytes = 64;
  const bool polyhedra = detail == Detail3::polyhedra;
  const std::uint64_t cell = record_bytes + faces_of_cell * face_bytes + (polyhedra ? polyhedronBytes() : 0);
  const std::uint64_t run = work.sites + work.images;
  const auto cells = plan.take("cells", run * cell);
  const std::uint64_t searched =
      (polyhedra ? searched_polyhedra : searched_measures) + (work.weighted ? weight_bytes : 0);
  plan.drop(plan.take("the search for cells", run * searched + work.images * image_bytes));
  return cells;
}

void planCellsCheck(MemoryPlan& plan, const Workload& work, Detail3) {
  constexpr std::uint64_t order_and_tree = 24;
  plan.drop(plan.take("the check", work.sites * order_and_tree));
}

}  // namespace vorpipe
