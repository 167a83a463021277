"""Cells on matplotlib's axes, which is imported here alone."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Optional

import numpy as np

from . import _arguments, _scalars, _vorpipe

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._diagram import Diagram
    from ._picture import Picture


def plot_cells(diagram: Diagram, ax: Optional[Axes], color: Any, show_sites: bool,
               properties: Dict[str, Any]) -> Axes:
    from matplotlib.collections import PathCollection

    ax = _axes(ax)
    counts = np.diff(diagram.cell_offsets)
    drawn = np.flatnonzero(diagram.status == 0 if diagram.globe else counts)
    options = {'edgecolor': 'black', 'linewidth': 0.5, **properties}
    paths = PathCollection(_paths(diagram, drawn), transform=ax.transData, **options)
    if color is None:
        if not {'facecolor', 'facecolors', 'fc'} & properties.keys():
            paths.set_facecolor('none')
    else:
        paths.set_array(_values(diagram, color)[drawn])
    ax.add_collection(paths, autolim=False)
    if show_sites:
        ax.plot(*diagram.sites.T, '.', color='black', markersize=2)
    if diagram.globe:
        _frame(ax, (-180, -90), (180, 90))
    else:
        _frame(ax, diagram.cell_vertices.min(axis=0), diagram.cell_vertices.max(axis=0))
    return ax


def plot_picture(picture: Picture, ax: Optional[Axes]) -> Axes:
    ax = _axes(ax)
    ax.imshow(picture.rgba, extent=picture.extent, interpolation='nearest')
    return ax


def _axes(ax: Optional[Axes]) -> Axes:
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.gca()


def _values(diagram: Diagram, color: Any) -> _arguments.Floats:
    if isinstance(color, str):
        known = ('areas', 'perimeters', 'mass', 'weights', 'status')
        if color not in known:
            raise _scalars.refuse('color', f'{color!r} is none of {", ".join(known)}, nor an array')
        color = getattr(diagram, color)
    values = _arguments.numbers('color', color)
    if values.shape != (len(diagram),):
        raise _scalars.refuse('color', f'shape {values.shape}, must be ({len(diagram)},): one for each point')
    return values


def _paths(diagram: Diagram, drawn: Any) -> Any:
    from matplotlib.path import Path

    if diagram.globe:
        # 180 degrees cuts cells.
        parts = [_vorpipe.polygons_of(diagram._cells, int(site)) for site in drawn]
        return [Path.make_compound_path(*(Path(np.concatenate((ring, ring[:1])), closed=True)
                                          for polygon in polygons for ring in polygon)) for polygons in parts]
    if not len(diagram.ring_starts):
        polygons = diagram.polygons()
        return [Path(np.concatenate((polygons[site], polygons[site][:1])), closed=True) for site in drawn]
    return [Path.make_compound_path(*(Path(np.concatenate((ring, ring[:1])), closed=True)
                                      for ring in diagram[int(site)].rings())) for site in drawn]


def _frame(ax: Axes, low: Any, high: Any) -> None:
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect('equal')
