"""Voronoi (Thiessen, Dirichlet) and power (Laguerre, radical) diagrams of points in the plane and in space.

    diagram = vorpipe.cells(points)

`cells` computes them as data, a `Diagram`, of points (N, 3) a `Diagram3`; `render` draws a `Picture`, `draw` a file of shapes; `relax` moves points
to where cells are alike; `transport` finds the weights that give cells their masses; a `Fluid` flows. `read` has the
points of a file, with all that it says of them. `Session` keeps a device for many runs. `vorpipe.compat` has
scipy.spatial's Voronoi and Delaunay. Lengths are in the points' own units, areas in their squares.
"""
from . import _numpy, _vorpipe  # first: NumPy for all others, and one that the module knows
from ._cell import BorderPart, Cell
from ._diagram import Diagram, Status, Wall
from ._errors import Cancelled, CheckError, DeviceError, Error, InputError
from ._fluid import Fluid
from ._functions import (Forecast, backends, cells, check, colormaps, compare, devices, draw, drawn_points, forecast,
                         generate, random_weights, read_sites, read_weights, relax, render, selftest, transport,
                         voronoi_polygons)
from ._picture import Picture
from ._points import Sites, read
from ._relaxed import Relaxed
from ._sessions import Session
from ._shared import close_sessions
from ._space import Diagram3, SpaceSites
from ._transported import Transported
from ._vorpipe import NO_SITE, __version__
from ._warnings import InputWarning

__all__ = [
    'BorderPart', 'Cancelled', 'Cell', 'CheckError', 'DeviceError', 'Diagram', 'Diagram3', 'Error', 'Fluid', 'Forecast',
    'InputError', 'InputWarning', 'NO_SITE', 'Picture', 'Relaxed', 'Session', 'Sites', 'SpaceSites', 'Status', 'Transported', 'Wall',
    '__version__', 'backends', 'cells', 'check', 'close_sessions', 'colormaps', 'compare', 'devices', 'draw',
    'drawn_points', 'forecast', 'generate', 'random_weights', 'read', 'read_sites', 'read_weights', 'relax', 'render',
    'selftest', 'transport', 'voronoi_polygons'
]
