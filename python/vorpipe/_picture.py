"""Cells as pixels."""
from __future__ import annotations

from typing import TYPE_CHECKING, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _arguments, _scalars, _vorpipe
from ._arguments import Floats, PathLike
from ._names import formerly
from ._shown import Shown, fewer

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Picture(Shown):
    """A picture of the cells of N points; made by `render`.

    Arrays are read-only, and show the memory of the picture without a copy; each keeps it alive. Row 0 is the top,
    where y is largest.
    """

    __slots__ = ('_picture',)
    _made_of = ('_picture',)

    def __init__(self, picture: _vorpipe.Picture) -> None:
        self._picture = picture

    def __repr__(self) -> str:
        height, width = self.ids.shape
        return f'<vorpipe.Picture: {width} x {height} pixels, {self.report.backend}>'

    def _pixels(self) -> npt.NDArray[np.uint8]:
        return fewer(self.rgba)

    @property
    def rgba(self) -> npt.NDArray[np.uint8]:
        """(H, W, 4): red, green, blue, alpha."""
        return self._picture.rgba

    @property
    def ids(self) -> npt.NDArray[np.uint32]:
        """(H, W): the point whose cell the pixel's center is in; NO_SITE outside of an outline."""
        return self._picture.ids

    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """(N,): a `Status` each."""
        return self._picture.status

    @property
    def owners(self) -> npt.NDArray[np.int32]:
        """(N,): the point that owns the cell: itself unless it is a duplicate."""
        return self._picture.owner

    owner = formerly('owner', 'owners')

    @property
    def sites(self) -> Floats:
        """(N, 2): the points that were given. A copy with each call."""
        return self._picture.input.points

    points = formerly('points', 'sites')

    @property
    def domain(self) -> Tuple[float, float, float, float]:
        """(xmin, ymin, xmax, ymax): where there are cells."""
        xmin, ymin, xmax, ymax = self._picture.input.domain
        return xmin, ymin, xmax, ymax

    @property
    def extent(self) -> Tuple[float, float, float, float]:
        """(xmin, xmax, ymin, ymax) of all pixels: the domain or the view, and what stands beside it."""
        xmin, xmax, ymin, ymax = self._picture.extent
        return xmin, xmax, ymin, ymax

    @property
    def key(self) -> Optional[_vorpipe.ColorKey]:
        """What the colors stand for; None by site."""
        return self._picture.key

    @property
    def report(self) -> _vorpipe.Report:
        """Backend, device, times, and what became of how many points."""
        return self._picture.report

    def check(self, threads: Optional[int] = None) -> List[str]:
        """As `vorpipe.check`."""
        return _vorpipe.check_picture(self._picture, _arguments.threads_of(threads))

    def save(self, path: PathLike) -> None:
        """Writes the picture as .png, its ids as .npy or .tif (GeoTIFF), or where its pixels lie as .pgw."""
        self._picture.save(_scalars.path_of(path))

    def plot(self, ax: Optional[Axes] = None) -> Axes:
        """Shows it on matplotlib's axes, in the units of the points; returns the axes."""
        from ._plot import plot_picture
        return plot_picture(self, ax)
