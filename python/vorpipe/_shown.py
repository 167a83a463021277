"""Results as notebooks show them: a small picture, and a line of what it is."""
from __future__ import annotations

import base64
import html
import re
from typing import Optional

import numpy as np
import numpy.typing as npt

from . import _look, _shared, _vorpipe
from ._kept import Kept

#: pixels of the longer side; of a picture that is there already the most
SIDE, LARGEST_SIDE = 400, 1000
#: with more points there is only the line, since the picture takes a second and more
MOST_POINTS = 1_000_000
#: with more points edges would be all that is seen, and as shapes it would be slow
MOST_EDGES = 2000


class Shown(Kept):
    """Has pixels to show."""

    __slots__ = ()

    def _pixels(self) -> Optional[npt.NDArray[np.uint8]]:
        """(H, W, 4); None where there are too many points for a small picture."""
        raise NotImplementedError

    def _repr_png_(self) -> Optional[bytes]:
        pixels = self._pixels()
        return None if pixels is None else _vorpipe.png_of(pixels)

    def _repr_html_(self) -> str:
        png, line = self._repr_png_(), html.escape(repr(self))
        if png is None:
            return f'<div>{line}</div>'
        source = f'data:image/png;base64,{base64.b64encode(png).decode()}'
        return f'<div><img src="{source}" alt="{line}"><br><small>{line}</small></div>'


def pixels_of_cells(given: _vorpipe.Input) -> Optional[npt.NDArray[np.uint8]]:
    """A picture of the cells of these points."""
    if len(given) > MOST_POINTS:
        return None
    look = _look.look_of(len(given), {'size': SIDE, 'edges': len(given) <= MOST_EDGES, 'fit': 'letterbox'})
    return _shared.shared('cpu', None, None).render(given, look, None).rgba


def smaller(drawing: str) -> str:
    """An SVG of the size of a small picture; its own is 1000 pixels long."""
    part = SIDE / 1000
    return re.sub(r'(width|height)="([\d.]+)"', lambda side: f'{side[1]}="{float(side[2]) * part:g}"', drawing, 2)


def fewer(pixels: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Every second one, third one ... of a large picture."""
    step = -(-max(pixels.shape[:2]) // LARGEST_SIDE)
    return np.ascontiguousarray(pixels[::step, ::step])
