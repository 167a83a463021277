/// Cells with a free surface (Surface::free), to be written and drawn: their borders are edges and arcs.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe/cell.h"
#include "vorpipe/cells.h"
#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

class Session;

/// The cells of sites whose weights are the squares of radii: of its power cell each has what lies in the
/// disc around its site; all else is air. As Session::cells has them, with Detail::polygons, but that an arc
/// is as many lines as one of `points_of_turn` to a whole circle needs, at least 3; these edges belong to
/// Wall::outline. Numbers are those of the arcs, so that polygons have a little less area than is said of
/// their cells. Cells of which the disc has nothing are empty. Errors: those of Session::cells; a density, an
/// outline or a period (input).
Result<Diagram> freeCells(Session& session, const Sites& sites, const CellsOptions& options,
                          int points_of_turn = 96);

/// A part of the line around a cell of freeCells(), counter-clockwise.
struct BorderPart {
  Point from, to;
  double angle = 0;           ///< of an arc around the site, up to a whole turn; 0: it is straight
  std::int64_t neighbor = 0;  ///< as Diagram::neighbors
};

/// The whole line around a cell of freeCells(): each arc is one part again.
std::vector<BorderPart> borderOf(const Cell& cell, Point site);

/// Whether a diagram is one of freeCells(): in a domain without an outline, these alone have edges at one.
bool hasFreeSurface(const Diagram& diagram, const Outline& outline);

/// Takes from the picture of a power diagram, which Session::render drew with these options, what is air:
/// these pixels have no site. With several places in a pixel, its color covers as much of it as is not air.
/// Errors (input): a period; colors by area or by neighbors, which are those before; a legend, labels, the
/// dual or sites, which would lose what lies over air. Pictures of shapes (.svg, .pdf) of freeCells() have
/// all but the first.
Result<void> takeOutAir(const Sites& sites, const RenderOptions& options, Image& image, int threads = 0);

/// Whitens what is air in such a picture, with all that was drawn there: for pictures that follow one
/// another, which have any marks and colors of the cells before. These pixels have no site either.
void whitenAir(const Sites& sites, const RenderOptions& options, Image& image, int threads = 0);

}  // namespace vorpipe
