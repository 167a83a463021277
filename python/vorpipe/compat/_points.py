"""What both classes begin with: points, and the triangles of all of them."""
from __future__ import annotations

import re
from typing import Any, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .. import _scalars, _vorpipe
from .._arguments import Floats, numbers
from .._errors import InputError
from .._functions import cells
from .._warnings import warn
from ._scipy import ErrorBase

Indices = npt.NDArray[np.int32]

DEFAULT_OPTIONS, INCREMENTAL_OPTIONS = 'Qbb Qc Qz Q12', 'Qc'


# How Qhull gets along with rounding, what it prints, and how it checks itself: nothing of it is to be done here.
OF_NO_MEANING = re.compile(r'Q(J[\d.e+-]*|bb|bB|[cistvwxz]|\d+)|[ACE]-?[\d.e+-]+|P[op]|T[cnsv]')


class QhullError(InputError, ErrorBase):
    """What scipy.spatial.QhullError is raised for: too few points, or all on a line. It is one where there is scipy."""


def options_of(options: Optional[str], furthest_site: bool, incremental: bool) -> str:
    """The options of Qhull: those that ask for another diagram are refused, not ignored."""
    if furthest_site:
        raise _scalars.refuse('furthest_site', 'only the diagram of nearest points is computed')
    default = INCREMENTAL_OPTIONS if incremental else DEFAULT_OPTIONS
    chosen = default if options is None else options
    if isinstance(chosen, bytes):
        chosen = chosen.decode('latin1')
    for option in chosen.split():
        if OF_NO_MEANING.fullmatch(option) is None:
            raise _scalars.refuse('qhull_options', f'{option} asks for another diagram than that of nearest points')
        if incremental and option in ('Qbb', 'QbB', 'Qz'):
            raise _scalars.refuse('qhull_options', f'{option} is not for incremental=True')
    return chosen


def plane_points(value: Any) -> Floats:
    """As scipy takes them, a copy: (N, 2), finite, not masked."""
    array = np.array(numbers('points', value), order='C')
    if array.ndim != 2:
        raise _scalars.refuse('points', f'shape {array.shape}, must be (N, 2)')
    if array.shape[1] != 2:
        raise _scalars.refuse('points', f'{array.shape[1]} dimensions: vorpipe.compat is for points in the plane; '
                                        'take scipy.spatial for others')
    if not np.isfinite(array).all():
        raise _scalars.refuse('points', 'some are not finite')
    return array


def triangulated(points: Floats) -> Tuple[npt.NDArray[np.uint32], Indices]:
    """The triangles of all points, and the owner of each position."""
    if len(points) < 3:
        raise QhullError(f'points: {len(points)}, it takes three', 'input', 'points')
    diagram = cells(points)
    if not len(diagram.triangles):
        raise QhullError('points: all of them lie on a line', 'input', 'points')
    return diagram.triangles.view(np.uint32), diagram.owners


class PlaneSet:
    """Points, and what came of them; more may be added where the caller said so."""

    def __init__(self, points: Any, furthest_site: bool, incremental: bool, qhull_options: Optional[str]) -> None:
        self._options = options_of(qhull_options, furthest_site, bool(incremental))
        self.furthest_site = False
        self._incremental = bool(incremental)
        self._take(plane_points(points))
        repeated = np.count_nonzero(self._owner != np.arange(self.npoints))
        if repeated and re.search(r'(^|\s)QJ', self._options):
            warn([f'qhull_options: QJ moves no points here: {repeated} that repeat others are in no triangle'])

    def _take(self, points: Floats) -> None:
        if len(points) == 0:
            raise _scalars.refuse('points', 'there are none')
        self._points = points
        self.ndim = 2
        self.npoints = len(points)
        self.min_bound = points.min(axis=0)
        self.max_bound = points.max(axis=0)
        self._triangles, self._owner = triangulated(points)
        self._adjacent = _vorpipe.adjacent_triangles(self._triangles, len(points))
        self._triangles, self._adjacent = _vorpipe.flipped_triangles(points, self._triangles, self._adjacent)
        flat = _vorpipe.flat_on_hull(points, self._triangles, self._adjacent)
        if flat.any():
            self._triangles = self._triangles[flat == 0]
            self._adjacent = _vorpipe.adjacent_triangles(self._triangles, len(points))

    @property
    def points(self) -> Floats:
        """(N, 2)."""
        return self._points

    def add_points(self, points: Any, restart: bool = False) -> None:
        """Adds points, where the object was made with incremental=True; all is computed anew."""
        if not self._incremental:
            raise RuntimeError('incremental mode not enabled or already closed')
        self._take(np.concatenate((self._points, plane_points(points))))

    def close(self) -> None:
        """No more points can be added."""
        self._incremental = False
