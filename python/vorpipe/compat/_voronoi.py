"""scipy.spatial.Voronoi."""
from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .. import _vorpipe
from .._arguments import Floats, listed
from ._points import Indices, PlaneSet
from ._scipy import VoronoiBase


class Voronoi(PlaneSet, VoronoiBase):
    """The unbounded Voronoi diagram of points in the plane, with the attributes of scipy.spatial.Voronoi.

    Its vertices are the centers of the circles around Delaunay triangles. Triangles whose circles are one, as far as
    doubles can tell, share a vertex. The vertex at infinity is -1. As in Delaunay, points may lie on the hull as far
    as doubles can tell.

    Args:
        points: (N, 2), three at least that are not on a line.
        furthest_site: only False.
        incremental: whether `add_points` may be called.
        qhull_options: as for Delaunay; with Qz, as there, the regions begin with an empty one.

    Raises:
        InputError: which is a ValueError: points of other dimensions, or not finite. QhullError: too few of them.
    """

    def __init__(self, points: Any, furthest_site: bool = False, incremental: bool = False,
                 qhull_options: Optional[str] = None) -> None:
        super().__init__(points, furthest_site, incremental, qhull_options)

    def _take(self, points: Floats) -> None:
        for name in ('regions', 'ridge_vertices', 'ridge_dict'):
            self.__dict__.pop(name, None)
        super()._take(points)
        self._center_of, centers, triangles = _vorpipe.triangle_centers(points, self._triangles, self._adjacent)
        self.vertices: Floats = centers
        for index in np.flatnonzero(~np.isfinite(centers).all(axis=1)):
            centers[index] = _exact_center(points[self._triangles[triangles[index]]])
        self.ridge_points, self._ridges = self._find_ridges()
        first = self._begins_with_empty
        self.point_region: npt.NDArray[np.int64] = self._region_numbers() + first

    @property
    def _begins_with_empty(self) -> int:
        return 1 if 'Qz' in self._options.split() else 0

    def _region_numbers(self) -> npt.NDArray[np.int64]:
        """By point; a duplicate has that of the point that it repeats."""
        is_owner = self._owner == np.arange(self.npoints)
        return (np.cumsum(is_owner) - 1)[self._owner]

    def _find_ridges(self) -> Tuple[Indices, Indices]:
        """Pairs of points, and of vertices: an edge of two triangles once, from the lower one."""
        triangle, corner = np.nonzero(self._adjacent < np.arange(len(self._adjacent))[:, None])
        other = self._adjacent[triangle, corner]
        ends = np.column_stack((np.where(other < 0, -1, self._center_of[other]), self._center_of[triangle]))
        pairs = np.column_stack((self._triangles[triangle, (corner + 1) % 3],
                                 self._triangles[triangle, (corner + 2) % 3])).astype(np.int32)
        has_length = ends[:, 0] != ends[:, 1]
        return pairs[has_length], ends[has_length]

    @cached_property
    def ridge_vertices(self) -> List[List[int]]:
        """By ridge, which separates the two points of `ridge_points`: its two vertices."""
        vertices: List[List[int]] = listed(self._ridges)
        return vertices

    @cached_property
    def ridge_dict(self) -> Dict[Tuple[int, int], List[int]]:
        """The vertices of the ridge between two points."""
        return {(p, q): ends for (p, q), ends in zip(listed(self.ridge_points), self.ridge_vertices)}

    @cached_property
    def regions(self) -> List[List[int]]:
        """By region: its vertices, counter-clockwise; those of points on the hull have -1 among them."""
        offsets, fans, are_closed = _vorpipe.triangle_fans(self._triangles, self._adjacent, self.npoints)
        around: List[int] = listed(self._center_of[fans])
        bounds: List[int] = listed(offsets)
        regions: List[List[int]] = [[]] * self._begins_with_empty
        for point in listed(np.flatnonzero(self._owner == np.arange(self.npoints))):
            ring = around[bounds[point] : bounds[point + 1]]
            regions.append(_around(ring if are_closed[point] else [-1, *ring]))
        return regions


def _around(ring: List[int]) -> List[int]:
    """Each vertex once, where it stands several times in a row; that at infinity first."""
    kept = [vertex for k, vertex in enumerate(ring) if vertex != ring[k - 1]] or ring[:1]
    if -1 in kept:
        first = kept.index(-1)
        return kept[first:] + kept[:first]
    return kept


def _exact_center(corners: Floats) -> Tuple[float, float]:
    """Of a triangle too flat for anything else. Where it is beyond all doubles, it is infinite."""
    (ax, ay), (bx, by), (cx, cy) = [(Fraction(x), Fraction(y)) for x, y in listed(corners)]
    bx, by, cx, cy = bx - ax, by - ay, cx - ax, cy - ay
    doubled = 2 * (bx * cy - by * cx)
    bb, cc = bx * bx + by * by, cx * cx + cy * cy
    return _rounded(ax + (cy * bb - by * cc) / doubled), _rounded(ay + (bx * cc - cx * bb) / doubled)


def _rounded(number: Fraction) -> float:
    try:
        return float(number)
    except OverflowError:
        return float('inf') if number > 0 else float('-inf')
