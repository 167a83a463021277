"""Points that have moved."""
from __future__ import annotations

from typing import Optional

from . import _vorpipe
from ._arguments import Bools, Floats, PathLike
from ._kept import Kept
from ._scalars import path_of


class Relaxed(Kept):
    """Where points have moved to, and how their energy fell; made by `relax`."""

    __slots__ = ('_relaxed', '_points')

    def __init__(self, relaxed: _vorpipe.Relaxed) -> None:
        self._relaxed = relaxed
        self._points: Optional[Floats] = None

    def __len__(self) -> int:
        return len(self._relaxed.input)

    def __repr__(self) -> str:
        return f'<vorpipe.Relaxed: {len(self)} points, {len(self.energy)} diagrams, {self.end}>'

    @property
    def points(self) -> Floats:
        """(N, 2): where they are now, in the order and unit in which they were given."""
        if self._points is None:
            self._points = self._relaxed.points
        return self._points

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

    def save(self, path: PathLike) -> None:
        """Writes the points, their weights and attributes: .csv, .txt, .npy, .geojson, .geojsonl, .gpkg or .wkt."""
        self._relaxed.save(path_of(path))
