"""Weights that give cells their masses."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _shared, _vorpipe
from ._arguments import Floats, PathLike
from ._diagram import Diagram
from ._scalars import call_of, path_of
from ._shared import Progress
from ._shown import Shown, pixels_of_cells


class Transported(Shown):
    """The weights that give each cell its mass, and the way to them; made by `transport`."""

    __slots__ = ('_found', '_index', '_session')
    _made_of = ('_found', '_index')

    def __init__(self, found: _vorpipe.Transported, index: Any = None,
                 session: Optional[_vorpipe.Session] = None) -> None:
        self._found = found
        self._index = index
        self._session = session

    def __len__(self) -> int:
        return len(self._found.input)

    def __repr__(self) -> str:
        return f'<vorpipe.Transported: {len(self)} points, {len(self.trace)} diagrams, {self.end}>'

    def _pixels(self) -> Optional[npt.NDArray[np.uint8]]:
        return pixels_of_cells(self._found.weighted)

    @property
    def weights(self) -> Floats:
        """(N,): `cells(points, weights)` has these masses; of a free surface `cells(points, weights,
        surface="free")`."""
        return self._found.weights

    @property
    def masses(self) -> Floats:
        """(N,): what the cells have; areas where there is no density."""
        return self._found.masses

    @property
    def areas(self) -> Floats:
        """(N,)"""
        return self._found.areas

    @property
    def centroids(self) -> Floats:
        """(N, 2): of the masses."""
        return self._found.centroids

    @property
    def cost(self) -> float:
        """The integral of the squared distance to the point over all cells: the squared Wasserstein distance between
        the density and the points' masses."""
        return self._found.cost

    @property
    def trace(self) -> npt.NDArray[Any]:
        """(K,), a row for each diagram, with the fields of a step: "diagram", "newton", "length", the part of the
        Newton step that was tried, "taken", whether it was kept, "norm", "worst" and "least" of what is left, as parts
        of the masses asked for and NaN where a cell was empty, "linear_iterations" and "seconds"."""
        return self._found.trace

    @property
    def end(self) -> str:
        """Why it ended: "converged", "stagnated", at what rounding allows, "diagrams" or "cancelled"."""
        return self._found.end

    @property
    def converged(self) -> bool:
        """Whether each cell has its mass, to the tolerance."""
        return self.end == 'converged'

    @property
    def report(self) -> _vorpipe.Report:
        """What the run did."""
        return self._found.report

    @property
    def surface(self) -> Optional[str]:
        """ "free" where air is around the cells, else None."""
        return 'free' if self._found.free_surface else None

    def cells(self, detail: str = 'all', progress: Optional[Progress] = None) -> Diagram:
        """The cells that have these masses, in the same domain; with a free surface they end at discs.

        Its session must be open; one that comes out of a pickle takes that of `vorpipe.cells`. `detail` and `progress`
        are as there.
        """
        session = self._session or _shared.shared_for(len(self))
        return Diagram(session.cells(self._found.weighted, detail, 'grid', 30, call_of('progress', progress)),
                       self._index)

    def save(self, path: PathLike) -> None:
        """Writes the points, these weights and attributes: .csv, .txt, .npy, .geojson, .geojsonl, .gpkg or .wkt."""
        self._found.save(path_of(path))
