"""Points that have moved."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _shared, _vorpipe
from ._arguments import Bools, Floats, PathLike
from ._diagram import Diagram
from ._names import formerly
from ._scalars import call_of, path_of
from ._shared import Progress
from ._shown import Shown, pixels_of_cells


class Relaxed(Shown):
    """Where points have moved to, and how their energy fell; made by `relax`."""

    __slots__ = ('_relaxed', '_index', '_sites')
    _made_of = ('_relaxed', '_index')

    def __init__(self, relaxed: _vorpipe.Relaxed, index: Any = None) -> None:
        self._relaxed = relaxed
        self._index = index
        self._sites: Optional[Floats] = None

    def __len__(self) -> int:
        return len(self._relaxed.input)

    def __repr__(self) -> str:
        return f'<vorpipe.Relaxed: {len(self)} points, {len(self.energy)} diagrams, {self.end}>'

    def _pixels(self) -> Optional[npt.NDArray[np.uint8]]:
        return pixels_of_cells(self._relaxed.moved)

    @property
    def sites(self) -> Floats:
        """(N, 2): where they are now, in the order and unit in which they were given."""
        if self._sites is None:
            self._sites = self._relaxed.points
        return self._sites

    points = formerly('points', 'sites')

    @property
    def weights(self) -> Optional[Floats]:
        """(N,): their weights, which stay; None where there are none."""
        return self._relaxed.input.weights

    @property
    def energy(self) -> Floats:
        """(K,): by diagram, the first of them that of the points as they were given: the sum over all cells of the
        integral of the squared distance to the point, times the density; less weights times masses."""
        return self._relaxed.energy

    @property
    def hexagonal(self) -> Floats:
        """(K,): the energy as a part of that of the hexagonal lattice of as many cells, NaN with weights."""
        return self._relaxed.hexagonal

    @property
    def farthest(self) -> Floats:
        """(K,): the longest way of a point to its centroid, in spacings: sqrt(area / N)."""
        return self._relaxed.farthest

    @property
    def seconds(self) -> Floats:
        """(K,): since the beginning."""
        return self._relaxed.seconds

    @property
    def taken(self) -> Bools:
        """(K,): False where the energy was too high, and the points went back to where they were before."""
        return self._relaxed.taken

    @property
    def end(self) -> str:
        """Why it ended: "iterations", "tolerance" or "stagnated", where nothing was left to gain but rounding."""
        return self._relaxed.end

    @property
    def report(self) -> _vorpipe.Report:
        """What the run did; `notes` tells of points that were set elsewhere."""
        return self._relaxed.report

    def cells(self, detail: str = 'all', progress: Optional[Progress] = None) -> Diagram:
        """The cells of the points where they are now, in the same domain; as `vorpipe.cells`."""
        return Diagram(_shared.shared_for(len(self)).cells(self._relaxed.moved, detail, 'grid', 30,
                                                           call_of('progress', progress)), self._index)

    def save(self, path: PathLike) -> None:
        """Writes the points, their weights and attributes: .csv, .txt, .npy, .geojson, .geojsonl, .gpkg or .wkt."""
        self._relaxed.save(path_of(path))
