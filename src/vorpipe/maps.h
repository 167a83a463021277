/// Sites, domains and cells on the Earth, by projection to a plane.
#pragma once

#include <span>

#include "vorpipe/cells.h"
#include "vorpipe/outline.h"
#include "vorpipe/projection.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"
#include "vorpipe/topology.h"

namespace vorpipe {

/// Returns a projection centered among places in degrees, rounded to 0.01 degrees; places may lie across the
/// antimeridian or around a pole. The center is in the direction of the middle of their bounding box in
/// space. For an outline that goes around the Earth, such as the equator, the center belongs to the region on
/// its left. Errors (input): a latitude beyond 90 or a longitude beyond 360 degrees from 0; no places.
Result<Projection> projectionAmid(const Sites& degrees);
Result<Projection> projectionAmid(const Outline& degrees);

/// A box in degrees as an outline, with sides along parallels in steps of a few degrees. Its longitudes may
/// be of any turn; a box of 360 degrees goes around the Earth. Errors (input): a latitude beyond 90 or a
/// longitude beyond 360 degrees from 0; more than 360 degrees of longitude; a box around the Earth on both
/// sides of the equator.
Result<Outline> outlineOfDegrees(const Box& degrees);

/// Projects sites from degrees to the plane; weights are unchanged, then in square kilometers. Errors: those
/// of projectionAmid.
Result<Sites> toPlane(const Projection& projection, const Sites& degrees, int threads = 0);

/// Projects an outline from degrees to the plane. Its sides are straight in longitude and latitude; added
/// points keep them within a millionth of its extent. A side of more than 180 and less than 360 degrees goes
/// the other way round, across the antimeridian. Parts that share a side still share it. Errors: those of
/// projectionAmid.
Result<Outline> toPlane(const Projection& projection, const Outline& degrees);

/// The same, mended in degrees and in the plane. Halves of a country that a file cuts at the antimeridian
/// touch, and so do two stretches of a ring that follows the antimeridian to a pole. Errors: those of
/// mended() and toPlane().
Result<MendedOutline> mendedToPlane(const Projection& projection, const Outline& degrees, bool repair);

/// Largest distance of a domain in the plane from the center, in degrees of the sphere of equal area. Error
/// (input): more than 90.
Result<double> reachOf(const Outline& kilometers);
Result<double> reachOf(const Box& kilometers);

/// Largest relative error of distances at a place `degrees_from_center` degrees from the center: distances
/// around the center are too long, those away from it too short.
double distortionAt(double degrees_from_center);

/// Sites in degrees, each in the turn within 180 degrees of the center's longitude, as the positions of
/// toDegrees.
Sites turned(const Projection& projection, Sites degrees);

/// Converts all positions of a diagram from the plane to degrees; `degrees` are its sites as turned() returns
/// them. Longitudes are continuous along each ring, in the turn in which a cell contains its site. They may
/// be beyond 180, and nothing is cut at the antimeridian. Around a pole a ring covers all longitudes, from
/// 180 degrees west of the center to 180 degrees east of it. One edge connects the last to the first; in
/// degrees the ring is no polygon without the pole. Measures stay in kilometers, to their powers. Edges are
/// straight in the plane.
void toDegrees(const Projection& projection, const Sites& degrees, Diagram& diagram, int threads = 0);

/// Converts the vertices of a topology that was found in the plane, where cells share positions; in degrees
/// their positions may be of different turns. Longitudes are within 180 degrees of the center's.
void toDegrees(const Projection& projection, Topology& topology, int threads = 0);

/// How far a domain extends beyond its content, on every side.
struct Margin {
  double value = 0.05;
  bool relative = true;  ///< relative to the longer side of the sites' box; else in the unit of coordinates
};

/// domainOf with another margin, 0 or more. A box without area, when sites lie on a line, is not a valid
/// domain.
Box domainOf(const Sites& sites, const Margin& margin);

}  // namespace vorpipe
