"""scipy.spatial.SphericalVoronoi."""
from __future__ import annotations

from functools import cached_property
from typing import Any, List, Optional

import numpy as np
import numpy.typing as npt

from .. import _scalars, _vorpipe
from .._arguments import Floats, listed, numbers
from .._functions import cells
from ._points import Indices
from ._scipy import SphericalBase

DIMENSIONS = 3


class SphericalVoronoi(SphericalBase):
    """The Voronoi diagram of points on a sphere, with the attributes of scipy.spatial.SphericalVoronoi.

    Its vertices are the centers of the circles around triangles of the convex hull, one for each; where more than
    three cells meet, several are the same place.

    Args:
        points: (N, 3), four at least, on the sphere and not on one circle.
        radius: of the sphere.
        center: (3,) of the sphere; None for the origin.
        threshold: how near points may be to each other, and how far from the sphere, as a part of the radius.

    Raises:
        ValueError: points nearer to each other, off the sphere, or on one circle.
    """

    def __init__(self, points: Any, radius: Optional[float] = 1, center: Any = None, threshold: float = 1e-06) -> None:
        if radius is None:
            raise ValueError('`radius` is `None`. Please provide a floating point number (i.e. `radius=1`).')
        self.radius = float(radius)
        self.points: Floats = np.array(numbers('points', points), order='C')
        if self.points.ndim != 2 or self.points.shape[1] != DIMENSIONS:
            raise _scalars.refuse('points', f'shape {self.points.shape}, must be (N, {DIMENSIONS}); scipy.spatial has '
                                            'spheres of other dimensions')
        self._dim = DIMENSIONS
        self.center: Floats = np.zeros(DIMENSIONS) if center is None else np.array(numbers('center', center))
        self._find(self.points - self.center, threshold * self.radius)

    def _find(self, ways: Floats, tolerance: float) -> None:
        """Of points as they are seen from the center."""
        # On a circle all differences lie in its plane.
        self._rank = int(np.linalg.matrix_rank(ways - ways[0], tol=tolerance)) if len(ways) else 0
        if self._rank < DIMENSIONS:
            raise ValueError(f'Rank of input points must be at least {DIMENSIONS}')
        lengths = np.sqrt(np.einsum('ij,ij->i', ways, ways))
        x, y, z = (ways / lengths[:, None]).T
        places = np.degrees(np.column_stack((np.arctan2(y, x), np.arctan2(z, np.hypot(x, y)))))
        self._diagram = cells(places, globe=True)
        corners = self._diagram.triangles
        sides = ways[corners] - ways[corners[:, [1, 2, 0]]]
        nearest = np.einsum('ijk,ijk->ij', sides, sides).min()
        # The nearest neighbor of a point is one of its neighbors in the triangulation.
        if nearest < tolerance**2 or (self._diagram.owners != np.arange(len(ways))).any():
            raise ValueError('Duplicate generators present.')
        if np.abs(lengths - self.radius).max() >= tolerance:
            raise ValueError('Radius inconsistent with generators.')
        across = np.cross(sides[:, 0], sides[:, 1])
        across /= np.sqrt(np.einsum('ij,ij->i', across, across))[:, None]
        self.vertices: Floats = self.radius * across + self.center
        self._simplices: Indices = corners

    @cached_property
    def regions(self) -> List[List[int]]:
        """By point: its vertices, counter-clockwise seen from outside."""
        triangles, count = self._simplices.view(np.uint32), len(self.points)
        adjacent = _vorpipe.adjacent_triangles(triangles, count)
        offsets, fans, _ = _vorpipe.triangle_fans(triangles, adjacent, count)
        around: List[int] = listed(fans)
        bounds: List[int] = listed(offsets)
        return [around[begin:end] for begin, end in zip(bounds, bounds[1:])]

    def sort_vertices_of_regions(self) -> None:
        """Does nothing: regions are in order."""

    def calculate_areas(self) -> npt.NDArray[np.float64]:
        """(N,): the areas of the regions on the sphere."""
        return self._diagram.solid_angles * self.radius**2
