#include "space/cell_places.h"

#include <array>
#include <cmath>

#include "space/place.h"

namespace vorpipe::space {

void CellPlaces::take(Label site, const Row& row) {
  site_ = site;
  row_ = row;
  face_.resize(row.faces);
  for (std::size_t f = 0; f < row.faces; ++f) face_[f] = relative(places_, site, row.neighbor[f]);
}

VertexPlace CellPlaces::at(const std::array<std::uint32_t, 3>& faces) const {
  const Relative &a = face_[faces[0]], &b = face_[faces[1]], &c = face_[faces[2]];
  const double bc_x = b.y * c.z - b.z * c.y, bc_y = b.z * c.x - b.x * c.z, bc_z = b.x * c.y - b.y * c.x;
  const double ca_x = c.y * a.z - c.z * a.y, ca_y = c.z * a.x - c.x * a.z, ca_z = c.x * a.y - c.y * a.x;
  const double ab_x = a.y * b.z - a.z * b.y, ab_y = a.z * b.x - a.x * b.z, ab_z = a.x * b.y - a.y * b.x;
  const double det = (a.x * bc_x + a.y * bc_y) + a.z * bc_z;
  const double size_a = a.size(), size_b = b.size(), size_c = c.size();
  const double sizes = size_a * size_b * size_c;
  // The bound that the design proves: u k (16 sum H / m + 10 R), k = m m m / det.
  constexpr double well_conditioned = 32;
  if (!(det * well_conditioned >= sizes)) {
    VertexPlace place{};
    const Point3 p = vertexPlace(places_, site_, row_.neighbor[faces[0]], row_.neighbor[faces[1]],
                                 row_.neighbor[faces[2]], &place.error);
    place.x = p.x;
    place.y = p.y;
    place.z = p.z;
    return place;
  }
  const double part = 0.5 / det;
  const double x = (a.lift * bc_x + b.lift * ca_x + c.lift * ab_x) * part;
  const double y = (a.lift * bc_y + b.lift * ca_y + c.lift * ab_y) * part;
  const double z = (a.lift * bc_z + b.lift * ca_z + c.lift * ab_z) * part;
  const double lifts = std::abs(a.lift) / size_a + std::abs(b.lift) / size_b + std::abs(c.lift) / size_c;
  const double error = 0x1p-53 * (sizes / det) * (8 * lifts + 10 * (std::abs(x) + std::abs(y) + std::abs(z)));
  return {x, y, z, error};
}

}  // namespace vorpipe::space
