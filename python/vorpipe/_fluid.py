"""Fluids made of cells."""
from __future__ import annotations

import math
import os
from typing import Any, Callable, List, NoReturn, Optional, Sequence, Tuple, Union

from . import _arguments, _scalars, _vorpipe
from ._arguments import Floats, PathLike
from ._diagram import Diagram
from ._names import formerly, renamed
from ._picture import Picture
from ._sessions import Session, input_of
from ._shared import Progress, backend_for, shared

Named = Union[str, 'os.PathLike[str]']


class Fluid:
    """A fluid whose parcels are cells that keep their areas.

    It begins with points and their velocities, or with a case or a file by its name:

        vorpipe.Fluid(points, velocities, domain=(0, 0, 1, 1))
        vorpipe.Fluid("dam-break", particles=1000)
        vorpipe.Fluid("state.npz")

    Arrays are read-only and of the state as it is when they are asked for; later steps do not change them. Options that
    are None are as the case or the file has them, or else as said below. Any thread may use it, while its session is
    open.

    Args:
        begin: (N, 2), the points; "taylor-green", "gresho", "shear", "rayleigh-taylor", "dam-break", "shear-wave" or
            "channel"; or an .npz file that `save` or the command line's --checkpoint has written.
        velocities: (N, 2); None: at rest.
        volumes: (N,), the areas of the cells; None for equal shares of the domain. A free surface asks for them.
        densities: (N,), mass per volume; None: 1.
        weights: (N,), where to begin to look for those that give cells their areas.
        domain, periodic, repair: as in `cells`; an outline is walls of any shape, with holes as obstacles. A case takes
            one, in which it begins; nothing else of these.
        surface: "free" where air is around the cells.
        particles: about how many cells a case has; None: 2048, and 8192 of "rayleigh-taylor".
        gravity: (x, y); None: none.
        scheme: "projection", for domains that are full; or "springs", which has free surfaces. None: the first, but for
            those.
        viscosity: kinematic, area per time; None: 0.
        centering: the rate, per time, at which points also move to the centroids of their cells, by projection;
            None: 0.
        walls: "slip", along which a viscous fluid slides, or "no-slip", to which it sticks; None: "slip".
        step: of time; None or 0: as long as speeds and springs allow.
        epsilon: a time, in 2 pi of which springs swing; None: 2 spacings over the largest first speed or half of that
            of a fall from the top, 3 spacings with a free surface.
        until: the time at which it ends; None: never.
        tolerance: no area differs from its volume by more than this part of it; None: 1e-6.
        diagrams: the most for each set of areas; None: 100.
        session: where it computes; None for the one of `backend`, `device` and `threads`, as in `cells`.
        progress: called with "fluid" and the part done while it begins; returning False stops that.
    """

    __slots__ = ('_fluid', '_session')

    @renamed(parcels='particles')
    def __init__(self, begin: Any, velocities: Any = None, *, volumes: Any = None, densities: Any = None,
                 weights: Any = None, domain: Any = None, repair: bool = False,
                 periodic: Union[None, bool, str] = None, surface: Optional[str] = None,
                 particles: Optional[int] = None, gravity: Optional[Sequence[float]] = None,
                 scheme: Optional[str] = None, viscosity: Optional[float] = None, walls: Optional[str] = None,
                 centering: Optional[float] = None,
                 step: Optional[float] = None, epsilon: Optional[float] = None, until: Optional[float] = None,
                 tolerance: Optional[float] = None, diagrams: Optional[int] = None, search: str = 'grid',
                 backend: str = 'auto', device: Union[None, int, str] = None, threads: Optional[int] = None,
                 session: Optional[Session] = None, progress: Optional[Progress] = None) -> None:
        arrays = {'velocities': velocities, 'volumes': volumes, 'densities': densities, 'weights': weights,
                  'domain': domain, 'periodic': periodic, 'surface': surface}
        if isinstance(begin, (str, os.PathLike)):
            setup, count = _named(begin, particles, arrays, repair)
        else:
            if particles is not None:
                raise _scalars.refuse('particles', 'is for cases; points are as many as there are')
            given = input_of(begin, weights, _arguments.domain_of(domain, repair=repair), periodic,
                             surface=surface)
            count = len(given)
            setup = _vorpipe.FluidSetup.of(given, _arguments.vectors_of('velocities', velocities, count),
                                           _arguments.positive_of('volumes', volumes, count),
                                           _arguments.positive_of('densities', densities, count))
        found, neighbors = _arguments.search_of(search)
        named = {'scheme': scheme, 'step': step, 'epsilon': epsilon, 'until': until, 'tolerance': tolerance,
                 'gravity': gravity, 'viscosity': viscosity, 'walls': walls, 'centering': centering}
        options = _arguments.options_of(_vorpipe.FLUID, {k: v for k, v in named.items() if v is not None})
        most = None if diagrams is None else _arguments.iterations_of(diagrams, 'diagrams')
        setup.choose(options, most, found, neighbors)
        if session is not None and not isinstance(session, Session):
            raise _scalars.refuse('session', f'a {type(session).__name__} is no Session')
        self._session = session or Session._around(shared(backend_for(backend, device, count), device, threads),
                                                   threads)
        self._fluid = _vorpipe.begin_fluid(self._session._session, setup, _scalars.call_of('progress', progress))

    def __len__(self) -> int:
        return len(self._fluid)

    def __reduce__(self) -> NoReturn:
        raise TypeError('a Fluid is of its session: save(path) writes it, and Fluid(path) goes on from there')

    def __repr__(self) -> str:
        last = self.last
        return f'<vorpipe.Fluid: {len(self)} points, time {last.time:g} after {last.step} steps>'

    def step(self, progress: Optional[Progress] = None) -> Optional[_vorpipe.FluidStep]:
        """Makes a step, and says what it has come to; None: the fluid has ended, and `end` says why.

        A step that is stopped, by `progress` or Ctrl-C, has not been; the next one begins where it did.
        """
        return self.last if self._fluid.step(_scalars.call_of('progress', progress)) else None

    def run(self, until: Optional[float] = None, steps: Optional[int] = None,
            callback: Optional[Callable[[_vorpipe.FluidStep], Optional[bool]]] = None,
            progress: Optional[Progress] = None) -> _vorpipe.FluidStep:
        """Makes steps until that time, which is that of its end from now on, or some of them; returns the last.

        A fluid that had ended goes on, without another time from then on without an end. `callback` is called after
        each step, and may use the fluid; returning False ends the run.
        """
        most = None if steps is None else _scalars.whole_of('steps', steps, what='is no number of steps')
        _scalars.call_of('callback', callback)
        own = math.inf if self.end == 'time' else self._fluid.until
        to = own if until is None else _scalars.number_of('until', until)
        if math.isinf(to) and steps is None:
            raise _scalars.refuse('until', 'name the time at which it ends, or a number of steps')
        self._fluid.go_on(to, _scalars.call_of('progress', progress))
        made = 0
        while most is None or made < most:
            told = self.step(progress)
            if told is None or (callback is not None and _vorpipe.says_stop(callback(told))):
                break
            made += 1
        return self.last

    def push(self, velocities: Any) -> None:
        """Adds to the velocities, (N, 2): what stirs."""
        wanted = _arguments.vectors_of('velocities', velocities, len(self))
        if wanted is None:
            raise _scalars.refuse('velocities', 'there are none')
        self._fluid.push(wanted)

    # The state

    @property
    def sites(self) -> Floats:
        """(N, 2): where they are. A copy with each call."""
        return self._fluid.points

    points = formerly('points', 'sites')

    @property
    def weights(self) -> Floats:
        """(N,): with them the cells of the points have their volumes."""
        return self._fluid.weights

    @property
    def velocities(self) -> Floats:
        """(N, 2)"""
        return self._fluid.velocities

    @property
    def pressures(self) -> Floats:
        """(N,): of the last step; by projection (0,) before the first."""
        return self._fluid.pressures

    @property
    def volumes(self) -> Floats:
        """(N,): the areas of the cells, which they keep."""
        return self._fluid.volumes

    @property
    def densities(self) -> Floats:
        """(N,); (0,) where all are 1."""
        return self._fluid.densities

    @property
    def time(self) -> float:
        """Of the state."""
        return self._fluid.last.time

    @property
    def last(self) -> _vorpipe.FluidStep:
        """What the last step has come to; before the first, how it began."""
        return self._fluid.last

    @property
    def end(self) -> Optional[str]:
        """Why it ended: "time", "areas", which could not be found even for short steps, or "cancelled"; None: it has
        not."""
        return self._fluid.end

    @property
    def domain(self) -> Tuple[float, float, float, float]:
        """(xmin, ymin, xmax, ymax)."""
        xmin, ymin, xmax, ymax = self._fluid.domain
        return xmin, ymin, xmax, ymax

    @property
    def periodic(self) -> str:
        """ "none", "x", "y" or "xy"."""
        return self._fluid.periodic

    @property
    def surface(self) -> Optional[str]:
        """ "free" where air is around the cells, else None."""
        return 'free' if self._fluid.free_surface else None

    @property
    def scheme(self) -> str:
        """ "springs" or "projection"."""
        return self._fluid.scheme

    @property
    def viscosity(self) -> float:
        """Kinematic, area per time."""
        return self._fluid.viscosity

    @property
    def centering(self) -> float:
        """The rate, per time, at which points also move to the centroids of their cells, by projection."""
        return self._fluid.centering

    @property
    def walls(self) -> str:
        """ "slip" or "no-slip"."""
        return self._fluid.walls

    @property
    def outline(self) -> Optional[List[List[Floats]]]:
        """Polygons, each its outer ring and its holes as (M, 2); None: the domain is a box."""
        points, rings, polygons = self._fluid.outline
        if not len(points):
            return None
        parts = [points[first:last] for first, last in zip(rings[:-1], rings[1:])]
        return [parts[first:last] for first, last in zip(polygons[:-1], polygons[1:])]

    @property
    def report(self) -> _vorpipe.Report:
        """What the run of the last diagram did."""
        return self._fluid.report

    # What can be made of it

    def cells(self, detail: str = 'all', progress: Optional[Progress] = None) -> Diagram:
        """The cells of the points where they are; with a free surface they end at discs."""
        return self._session.cells(self.sites, self.weights, self.outline or self.domain, periodic=self.periodic,
                                   surface=self.surface, detail=detail, progress=progress)

    def render(self, **look: Any) -> Picture:
        """A picture of these cells; `look` is as in `vorpipe.render`. Air has no color, and NO_SITE."""
        return self._session.render(self.sites, self.weights, self.outline or self.domain, periodic=self.periodic,
                                    surface=self.surface, **look)

    def save(self, path: PathLike) -> None:
        """Writes all that later steps depend on, .npz, to go on from it with the same bytes; or the points with their
        weights: .csv, .txt, .npy, .geojson, .geojsonl, .gpkg or .wkt."""
        self._fluid.save(_scalars.path_of(path))


def _named(begin: Named, particles: Optional[int], arrays: Any,
           repair: bool) -> Tuple[_vorpipe.FluidSetup, int]:
    """A case or a file, which have all arrays themselves, and about how many cells; a case may have another outline."""
    path = _scalars.path_of(begin, 'begin')
    name = os.fsdecode(path)
    is_case = name in _vorpipe.fluid_cases()
    domain = arrays.pop('domain') if is_case else None
    for argument, value in arrays.items():
        if value is not None:
            raise _scalars.refuse(argument, f'{name} has its own')
    if particles is not None and not is_case:
        raise _scalars.refuse('particles', f'is for cases; {name} has as many as it has')
    count = _vorpipe.usual_particles(name if is_case else '') if particles is None else _scalars.whole_of(
        'particles', particles, 4, what='is no number of at least 4')
    outline = None if domain is None else _arguments.outline_of(domain)
    return _vorpipe.FluidSetup.named(path, count, outline, _scalars.flag_of('repair', repair)), count
