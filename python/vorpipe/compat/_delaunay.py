"""scipy.spatial.Delaunay."""
from __future__ import annotations

from functools import cached_property
from typing import Any, Optional, Tuple

import numpy as np

from .. import _vorpipe
from .._arguments import Floats
from ._points import Indices, PlaneSet
from ._scipy import DelaunayBase

EPSILON = float(np.finfo(np.float64).eps)


class Delaunay(PlaneSet, DelaunayBase):
    """The Delaunay triangulation of points in the plane, with the attributes of scipy.spatial.Delaunay.

    Triangles between the hull and a point that lies on it as far as doubles can tell are left out, so that the point
    is one of the hull; `Diagram.triangles` has them.

    Args:
        points: (N, 2), three at least that are not on a line.
        furthest_site: only False.
        incremental: whether `add_points` may be called.
        qhull_options: those that say how Qhull deals with rounding change nothing; others are refused.

    Raises:
        InputError: which is a ValueError: points of other dimensions, or not finite. QhullError: too few of them.
    """

    def __init__(self, points: Any, furthest_site: bool = False, incremental: bool = False,
                 qhull_options: Optional[str] = None) -> None:
        super().__init__(points, furthest_site, incremental, qhull_options)

    def _take(self, points: Floats) -> None:
        for name in ('transform', 'equations', 'convex_hull', 'vertex_neighbor_vertices', 'vertex_to_simplex',
                     'coplanar'):
            self.__dict__.pop(name, None)
        super()._take(points)
        self.simplices: Indices = self._triangles.astype(np.int32)
        self.neighbors: Indices = self._adjacent
        self._vertices: Indices = self.simplices  # of scipy's deprecated name
        self.nsimplex = len(self.simplices)
        # Of Qhull's facets that are left out for a point that is named, of which there is none here.
        self.good: Indices = np.ones(self.nsimplex, dtype=np.int32)
        self.paraboloid_scale, self.paraboloid_shift = 1.0, 0.0

    @cached_property
    def vertex_to_simplex(self) -> Indices:
        """(N,): a triangle of each point; of a duplicate, one of the point that it repeats."""
        found = np.full(self.npoints, -1, dtype=np.int32)
        found[self._triangles.ravel()] = np.repeat(np.arange(self.nsimplex, dtype=np.int32), 3)
        return found[self._owner]

    @cached_property
    def coplanar(self) -> Indices:
        """(P, 3): points that are in no triangle: each one, a triangle next to it, the corner that it repeats."""
        repeated = np.flatnonzero(self._owner != np.arange(self.npoints))
        return np.column_stack((repeated, self.vertex_to_simplex[repeated],
                                self._owner[repeated])).astype(np.int32)

    @cached_property
    def convex_hull(self) -> Indices:
        """(E, 2): the edges of the convex hull."""
        triangle, corner = np.nonzero(self.neighbors < 0)
        return np.column_stack((self.simplices[triangle, (corner + 1) % 3],
                                self.simplices[triangle, (corner + 2) % 3]))

    @cached_property
    def vertex_neighbor_vertices(self) -> Tuple[Indices, Indices]:
        """(indptr, indices): the neighbors of point k are indices[indptr[k] : indptr[k + 1]]."""
        edges = self.simplices[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        both = np.concatenate((edges, edges[:, ::-1]))
        key = np.unique(both[:, 0].astype(np.int64) * self.npoints + both[:, 1])
        counts = np.bincount(key // self.npoints, minlength=self.npoints)
        return np.append(0, np.cumsum(counts)).astype(np.int32), (key % self.npoints).astype(np.int32)

    @cached_property
    def transform(self) -> Floats:
        """(T, 3, 2): to barycentric coordinates: c = transform[i, :2] @ (x - transform[i, 2]); nan where a triangle
        is too flat."""
        corners = self.points[self.simplices]
        last = corners[:, 2]
        (ax, ay), (bx, by) = (corners[:, 0] - last).T, (corners[:, 1] - last).T
        determinant = ax * by - ay * bx
        # As scipy does: by the condition of the matrix, in the norm that sums columns.
        norm = np.maximum(np.abs(ax) + np.abs(ay), np.abs(bx) + np.abs(by))
        norm_of_inverse = np.maximum(np.abs(by) + np.abs(ay), np.abs(bx) + np.abs(ax))
        flat = ~(np.abs(determinant) > 1000 * EPSILON * norm * norm_of_inverse)
        with np.errstate(divide='ignore', invalid='ignore'):
            inverse = np.stack((by, -bx, -ay, ax), axis=-1) / determinant[:, None]
        result = np.concatenate((inverse.reshape(-1, 2, 2), last[:, None]), axis=1)
        result[flat] = np.nan
        return result

    @cached_property
    def equations(self) -> Floats:
        """(T, 4): unit normal and offset of the lifted triangles, which lie on the paraboloid from below."""
        a, b, c = self.lift_points(self.points)[self.simplices].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        normal[normal[:, 2] > 0] *= -1
        return np.column_stack((normal, -np.einsum('ij,ij->i', normal, c)))

    def lift_points(self, x: Any) -> Floats:
        """Points (..., 2) onto the paraboloid, (..., 3)."""
        array = np.asarray(x, dtype=np.float64)
        return np.concatenate((array, (array**2).sum(axis=-1, keepdims=True)), axis=-1)

    def plane_distance(self, xi: Any) -> Floats:
        """(..., T): distances of lifted points (..., 2) to the planes of all triangles."""
        return self.lift_points(xi) @ self.equations[:, :3].T + self.equations[:, 3]

    def find_simplex(self, xi: Any, bruteforce: bool = False, tol: Optional[float] = None) -> Any:
        """(...): the triangle that holds each point of (..., 2), -1 outside of all.

        Args:
            bruteforce: changes nothing; the walk from triangle to triangle finds what is to be found.
            tol: how far outside, as a part of a triangle's height, still counts as inside.
        """
        places = np.asarray(xi, dtype=np.float64)
        if places.shape[-1:] != (2,):
            raise ValueError('wrong dimensionality in xi')
        tolerance = 100 * EPSILON if tol is None else float(tol)
        found = _vorpipe.triangles_at(self._points, self._triangles, self._adjacent, places.reshape(-1, 2), tolerance)
        shape: Tuple[int, ...] = places.shape[:-1]
        return found.reshape(shape) if shape else found[0]
