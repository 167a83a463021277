"""What the arrays of cells in space say of their shapes."""
from __future__ import annotations

from typing import Any, Dict, NamedTuple

import numpy as np
import numpy.typing as npt

from ._arguments import Floats
from ._diagram import Integers


class VtkArrays(NamedTuple):
    """Polyhedra as VTK takes them."""

    points: Floats  #: (V, 3)
    cells: Integers  #: for each cell how many numbers follow, of how many faces; for each its size and its points
    types: npt.NDArray[np.uint8]  #: VTK_POLYHEDRON each
    data: Dict[str, npt.NDArray[Any]]  #: by cell


def sums_of(values: npt.NDArray[Any], offsets: Integers) -> npt.NDArray[Any]:
    """The sum of each row, in its order."""
    rows = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    sums = np.zeros(len(offsets) - 1, values.dtype)
    np.add.at(sums, rows, values)
    return sums


def sphericities(volumes: Floats, areas: Floats) -> Floats:
    with np.errstate(invalid='ignore'):
        return np.where(areas > 0, np.pi ** (1 / 3) * (6 * volumes) ** (2 / 3) / np.where(areas > 0, areas, 1), np.nan)


def orders(sides: Integers, offsets: Integers, counted: npt.NDArray[np.bool_], first: int, last: int) -> Integers:
    """How many of the counted faces of each cell have `first` to `last` edges."""
    rows = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    chosen = counted & (sides >= first) & (sides <= last)
    found = np.zeros((len(offsets) - 1, last - first + 1), np.int64)
    np.add.at(found, (rows[chosen], sides[chosen] - first), 1)
    return found


def _following(offsets: Integers) -> Integers:
    """The index of the vertex after each one around its face."""
    following = np.arange(1, offsets[-1] + 1)
    whole = np.diff(offsets) > 0
    following[offsets[1:][whole] - 1] = offsets[:-1][whole]
    return following


def perimeters(vertices: Floats, rings: npt.NDArray[np.int32], offsets: Integers) -> Floats:
    places = vertices[rings]
    return sums_of(np.linalg.norm(places[_following(offsets)] - places, axis=1), offsets)


def solid_angles(sites: Floats, vertices: Floats, rings: npt.NDArray[np.int32], offsets: Integers,
                 face_offsets: Integers) -> Floats:
    """Of faces as fans of triangles (van Oosterom and Strackee 1983)."""
    faces_of = np.diff(face_offsets)
    own = np.repeat(np.repeat(np.arange(len(sites)), faces_of), np.diff(offsets))
    seen = vertices[rings] - sites[own]
    distance = np.linalg.norm(seen, axis=1)
    first = np.repeat(offsets[:-1], np.diff(offsets))
    a, b, c = seen[first], seen, seen[_following(offsets)]
    la, lb, lc = distance[first], distance, distance[_following(offsets)]

    def dot(p: Floats, q: Floats) -> Floats:
        return np.einsum('ij,ij->i', p, q)

    above = dot(a, np.cross(b, c))
    below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    return sums_of(2 * np.arctan2(above, below), offsets)


def vtk_cells(rings: npt.NDArray[np.int32], offsets: Integers, face_offsets: Integers, chosen: Integers) -> Integers:
    """The cells as numbers: how many follow, how many faces, and of each how many points and which."""
    sizes = np.diff(offsets)
    # Each face is its size and its ring; faces of all cells lie one after the other.
    faces = np.empty(len(rings) + len(sizes), np.int64)
    starts = offsets[:-1] + np.arange(len(sizes))
    faces[starts] = sizes
    is_size = np.zeros(len(faces), bool)
    is_size[starts] = True
    faces[~is_size] = rings
    # Before those of a cell stand two numbers.
    counts = np.diff(np.append(starts, len(faces))[face_offsets])
    is_chosen = np.zeros(len(counts), bool)
    is_chosen[chosen] = True
    numbers = counts[chosen] + 2
    heads = np.cumsum(numbers) - numbers
    cells = np.empty(numbers.sum(), np.int64)
    is_body = np.ones(len(cells), bool)
    is_body[heads] = is_body[heads + 1] = False
    cells[heads] = numbers - 1
    cells[heads + 1] = np.diff(face_offsets)[chosen]
    cells[is_body] = faces[np.repeat(is_chosen, counts)]
    return cells


def tetrahedra(sites: Floats, rings: npt.NDArray[np.int32], offsets: Integers, faces: Integers,
               vertex_sites: Integers, vertex_offsets: Integers) -> Integers:
    """The tetrahedra of the sites around each vertex that no wall meets; `faces` are the two sites of each.

    The sites of a vertex are corners of a polytope: each edge from the vertex is one of its facets, each face at that
    edge one of the facet's sides. All but the facets of its lowest site are joined with it, and all sides of a facet
    but those of its lowest site with that: facets that two polytopes share are divided in the same way.
    """
    inside = np.minimum.reduceat(vertex_sites, vertex_offsets[:-1]) if len(vertex_sites) else np.empty(0, np.int64)
    following = rings[_following(offsets)]
    pairs = np.repeat(faces, np.diff(offsets), axis=0)
    chosen = (pairs[:, 0] < pairs[:, 1]) & (pairs[:, 0] >= 0)
    tail, head, pairs = rings[chosen].astype(np.int64), following[chosen].astype(np.int64), pairs[chosen]
    tail, head, pairs = np.append(tail, head), np.append(head, tail), np.concatenate((pairs, pairs))
    _, edge = np.unique(tail * len(inside) + head, return_inverse=True)
    lowest = np.full(len(tail), np.iinfo(np.int64).max)
    np.minimum.at(lowest, edge, pairs[:, 0])
    lowest = lowest[edge]
    apex = inside[tail]
    joined = (apex >= 0) & (lowest != apex) & (pairs[:, 0] != lowest)
    found = np.column_stack((apex, lowest, pairs))[joined]
    corners = sites[found]
    turned = np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0
    found[turned, 2:] = found[turned, 3:1:-1]
    return found
