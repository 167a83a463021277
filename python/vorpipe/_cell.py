"""One cell."""
from __future__ import annotations

from typing import TYPE_CHECKING, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _vorpipe
from ._arguments import Floats

if TYPE_CHECKING:
    from ._diagram import Diagram, Status


class BorderPart(NamedTuple):
    """A part of the line around a cell of a free surface, counter-clockwise."""

    start: Tuple[float, float]
    end: Tuple[float, float]
    angle: float  #: of an arc around the point, up to a whole turn; 0: it is straight
    neighbor: int  #: a point, or a `Wall`


class Cell:
    """The cell of one point: a part of each array of its diagram."""

    __slots__ = ('_diagram', 'site')

    site: int  #: the point's index

    def __init__(self, diagram: Diagram, site: int) -> None:
        self._diagram = diagram
        self.site = site

    def __len__(self) -> int:
        """How many edges it has."""
        part = self._edges
        return part.stop - part.start

    def __repr__(self) -> str:
        return f'<vorpipe.Cell {self.site}: area {self.area:g}, {len(self)} edges>'

    @property
    def _edges(self) -> slice:
        begin, end = self._diagram.cell_offsets[self.site : self.site + 2]
        return slice(int(begin), int(end))

    @property
    def status(self) -> Status:
        return self._diagram._status_of(self.site)

    @property
    def owner(self) -> int:
        return int(self._diagram.owners[self.site])

    @property
    def area(self) -> float:
        return float(self._diagram.areas[self.site])

    @property
    def perimeter(self) -> float:
        return float(self._diagram.perimeters[self.site])

    @property
    def centroid(self) -> Floats:
        """(2,)."""
        return self._diagram.centroids[self.site]

    @property
    def second_moments(self) -> Floats:
        """(3,): xx, xy and yy about the centroid."""
        return self._diagram.second_moments[self.site]

    @property
    def mass(self) -> Optional[float]:
        """Of the density; None without one."""
        mass = self._diagram.mass
        return float(mass[self.site]) if len(mass) else None

    @property
    def mass_centroid(self) -> Optional[Floats]:
        """(2,); None without a density."""
        centroids = self._diagram.mass_centroids
        return centroids[self.site] if len(centroids) else None

    @property
    def vertices(self) -> Floats:
        """(K, 2), counter-clockwise."""
        return self._diagram.cell_vertices[self._edges]

    @property
    def neighbors(self) -> npt.NDArray[np.int64]:
        """(K,): neighbor k is beyond the edge from vertex k to the next; negative ones are a `Wall`."""
        return self._diagram.neighbors[self._edges]

    @property
    def neighbor_shifts(self) -> npt.NDArray[np.int32]:
        """(K, 2) in a periodic domain, else of length 0."""
        shifts = self._diagram.neighbor_shifts
        return shifts[self._edges] if len(shifts) else shifts

    @property
    def edge_lengths(self) -> Floats:
        """(K,)."""
        return self._diagram.edge_lengths[self._edges]

    def border(self) -> List[BorderPart]:
        """The line around it, of cells with surface="free": edges, and each arc as one part."""
        return [BorderPart(*part) for part in _vorpipe.border_of_cell(self._diagram._cells, self.site)]

    def rings(self) -> List[Floats]:
        """Its rings, (K, 2) each: outer ones counter-clockwise, each followed by its holes, clockwise."""
        part, starts, vertices = self._edges, self._diagram.ring_starts, self._diagram.cell_vertices
        if part.start == part.stop:
            return []
        if not len(starts):
            return [vertices[part]]
        first, end = np.searchsorted(starts, (part.start, part.stop))
        return np.split(vertices[part], starts[first + 1 : end] - part.start)

    def polygons(self) -> List[Tuple[Floats, List[Floats]]]:
        """Its parts: an outer ring with its holes each. A cell without an outline has one at most."""
        parts: List[Tuple[Floats, List[Floats]]] = []
        for ring in self.rings():
            if _area(ring) > 0 or not parts:
                parts.append((ring, []))
            else:
                parts[-1][1].append(ring)
        return parts


def _area(ring: Floats) -> float:
    x, y = (ring - ring[0]).T
    return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
