"""What was reinterpreted or changed, as warnings about the caller's line."""
from __future__ import annotations

import sys
import warnings
from typing import Iterable, Type

PACKAGE = __name__.partition('.')[0]


class InputWarning(UserWarning):
    """Part of the input was reinterpreted, changed or ignored: coordinates look like degrees, an outline was mended."""


def warn(notes: Iterable[str], category: Type[Warning] = InputWarning) -> None:
    """Warns of each, of the first line beyond this package."""
    notes = [note for note in notes if note]
    if not notes:
        return
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals.get('__name__', '').partition('.')[0] == PACKAGE:
        level, frame = level + 1, frame.f_back
    for note in notes:
        warnings.warn(note, category, stacklevel=level)


def deprecated(note: str) -> None:
    """An old name, which serves for a release."""
    warn([note], DeprecationWarning)
