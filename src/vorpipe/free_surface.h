/// Cells with a free surface (Surface::free), for output and pictures: their borders are edges and arcs.
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

/// The cells of sites whose weights are squared radii. Each cell is the part of the site's power cell inside
/// the disc around the site; all else is air. The result is as from Session::cells with Detail::polygons, but
/// each arc becomes lines: `points_of_turn` to a whole circle, at least 3. These edges belong to
/// Wall::outline. The measures are those of the arcs, so the polygons have slightly less area than the cells'
/// measures state. A cell is empty if the disc contains none of it. Errors: those of Session::cells; a
/// density, an outline or a period (input).
Result<Diagram> freeCells(Session& session, const Sites& sites, const CellsOptions& options,
                          int points_of_turn = 96);

/// A part of the border of a cell of freeCells(), counter-clockwise.
struct BorderPart {
  Point from, to;
  double angle = 0;           ///< of an arc around the site, up to a whole turn; 0: straight
  std::int64_t neighbor = 0;  ///< as Diagram::neighbors
};

/// The whole border of a cell of freeCells(): each arc is one part again.
std::vector<BorderPart> borderOf(const Cell& cell, Point site);

/// Whether a diagram comes from freeCells(): without an outline in the domain, only these have edges at
/// Wall::outline.
bool hasFreeSurface(const Diagram& diagram, const Outline& outline);

/// Removes air from a picture of a power diagram that Session::render drew with these options: air pixels
/// have no site. With several samples in a pixel, its color covers only the part of it that is not air.
/// Errors (input): a period; colors by area or by neighbors, which would still be those of the power cells; a
/// legend, labels, the dual or sites, which would vanish over air. Vector pictures (.svg, .pdf) of
/// freeCells() support all of these except a period.
Result<void> takeOutAir(const Sites& sites, const RenderOptions& options, Image& image, int threads = 0);

/// Whitens air in such a picture, with everything drawn there. This is for sequences of pictures, which may
/// have any marks and the colors of the power cells. These pixels have no site either.
void whitenAir(const Sites& sites, const RenderOptions& options, Image& image, int threads = 0);

}  // namespace vorpipe
