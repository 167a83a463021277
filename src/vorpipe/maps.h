/// Sites, domains and cells of the Earth, by way of a plane.
#pragma once

#include <span>

#include "vorpipe/cells.h"
#include "vorpipe/outline.h"
#include "vorpipe/projection.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"
#include "vorpipe/topology.h"

namespace vorpipe {

/// A projection whose center is amid places in degrees, however they lie to the antimeridian and the poles,
/// rounded to 0.01 degrees: in the direction of the middle of the box around them in space. Amid an outline
/// that is all around the Earth, as the equator is, it is that of what lies to the left. Errors (input): a
/// place has a latitude beyond 90 or a longitude beyond 360 degrees from 0; there is none.
Result<Projection> projectionAmid(const Sites& degrees);
Result<Projection> projectionAmid(const Outline& degrees);

/// A box in degrees as an outline, its sides along parallels in steps of a few degrees. Its longitudes may be
/// of any turn; a box of 360 degrees goes around the Earth. Errors (input): a latitude beyond 90 or a
/// longitude beyond 360 degrees from 0, more than 360 degrees of longitude; all around the Earth on both
/// sides of the equator.
Result<Outline> outlineOfDegrees(const Box& degrees);

/// Sites from degrees to the plane; weights stay, which are square kilometers then. Errors: as
/// projectionAmid's.
Result<Sites> toPlane(const Projection& projection, const Sites& degrees, int threads = 0);

/// An outline from degrees to the plane: its sides are straight in longitude and latitude, and get as many
/// points more as keep them within a millionth of its extent. One of more than 180 and less than 360 degrees
/// goes the other way round, across the antimeridian. Parts that share a side still do. Errors: as
/// projectionAmid's.
Result<Outline> toPlane(const Projection& projection, const Outline& degrees);

/// The same, mended in degrees and in the plane: halves of a country that a file cuts at the antimeridian
/// touch, and so does a ring itself that goes along it to a pole. Errors: those of mended() and toPlane().
Result<MendedOutline> mendedToPlane(const Projection& projection, const Outline& degrees, bool repair);

/// How far a domain in the plane reaches from the center, in degrees of the sphere of equal area. Error
/// (input): farther than 90.
Result<double> reachOf(const Outline& kilometers);
Result<double> reachOf(const Box& kilometers);

/// By which part distances are wrong, at most, at a place that is `degrees_from_center` degrees from the
/// center: those around the center are too long, those away from it too short.
double distortionAt(double degrees_from_center);

/// Sites in degrees, each in the turn that is within 180 degrees of the center's longitude, as toDegrees has
/// positions.
Sites turned(const Projection& projection, Sites degrees);

/// All positions of a diagram from the plane to degrees; `degrees` are its sites as turned() has them.
/// Longitudes are continuous along each ring, in the turn in which a cell holds its site: they may be beyond
/// 180, and nothing is cut at the antimeridian. Around a pole a ring has all longitudes, from 180 degrees
/// west of the center to 180 degrees east of it, with one edge from the last to the first: in degrees it is
/// no polygon without the pole. Measures stay in kilometers, to their powers. Edges are straight in the
/// plane.
void toDegrees(const Projection& projection, const Sites& degrees, Diagram& diagram, int threads = 0);

/// The vertices of a topology, which was found in the plane: there cells share positions, which may be of
/// other turns in degrees. Longitudes are within 180 degrees of the center's.
void toDegrees(const Projection& projection, Topology& topology, int threads = 0);

/// How much a domain is larger than what it is around, on every side.
struct Margin {
  double value = 0.05;
  bool relative = true;  ///< to the longer side of the sites' box; else in the unit of coordinates
};

/// domainOf with another margin: 0 or more. A box without area, where sites lie on a line, is no domain.
Box domainOf(const Sites& sites, const Margin& margin);

}  // namespace vorpipe
