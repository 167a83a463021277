#include "space/cell_places.h"

#include <array>

#include "space/place.h"

namespace vorpipe::space {

void CellPlaces::take(Label site, const Row& row) {
  site_ = site;
  row_ = row;
  face_.resize(row.faces);
  for (std::size_t f = 0; f < row.faces; ++f) face_[f] = relative(places_, site, row.neighbor[f]);
}

VertexPlace CellPlaces::at(const std::array<std::uint32_t, 3>& faces) const {
  const PlaceInDouble near(face_[faces[0]], face_[faces[1]], face_[faces[2]]);
  constexpr double well_enough = 32;
  constexpr double known = 1e-12;
  const bool is_known = places_.weights == nullptr || near.error <= known * near.distance;
  if (near.condition <= well_enough && is_known)
    return {near.place.x, near.place.y, near.place.z, near.error};
  VertexPlace place{};
  const Point3 p = vertexPlace(places_, site_, row_.neighbor[faces[0]], row_.neighbor[faces[1]],
                               row_.neighbor[faces[2]], &place.error);
  place.x = p.x;
  place.y = p.y;
  place.z = p.z;
  return place;
}

}  // namespace vorpipe::space
