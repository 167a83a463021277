"""Sessions, and the ones that the functions of the package share."""
from __future__ import annotations

import atexit
import os
import threading
from typing import Any, Callable, Dict, Mapping, NoReturn, Optional, Sequence, Tuple, Union

from . import _arguments, _attributes, _crs, _look, _scalars, _vorpipe
from ._arguments import PathLike
from ._diagram import Diagram
from ._errors import CheckError
from ._picture import Picture
from ._points import given
from ._relaxed import Relaxed
from ._transported import Transported
from ._warnings import warn

Progress = Callable[[str, float], Optional[bool]]
StepCallback = Callable[[_vorpipe.TransportStep], Optional[bool]]
Project = Union[None, bool, str, Sequence[float]]
Margin = Union[None, float, str]

# Up to this many points and pixels "auto" does not look for a GPU: the processor is done before one is ready.
FEW_POINTS, FEW_PIXELS = 100_000, 4_000_000


def input_of(points: Any, weights: Any, domain: _vorpipe.Domain, periodic: Union[None, bool, str],
             density: Any = None, attributes: Any = None, crs: Any = None,
             surface: Optional[str] = None, density_box: Optional[Sequence[float]] = None) -> _vorpipe.Input:
    taken = given(points)
    own = taken.attributes if isinstance(taken, _vorpipe.Table) else None
    made = _vorpipe.Input(taken, _arguments.weights_of(weights, len(taken)), domain,
                          _arguments.periodic_of(periodic), _arguments.density_of(density, density_box),
                          _attributes.attributes_of(attributes, len(taken), own), _crs.system_of(crs),
                          _arguments.surface_of(surface))
    warn(made.notes)
    return made


def without_zeros(taken: _vorpipe.Input, masses: _arguments.Floats) -> Tuple[_vorpipe.Input, _arguments.Floats]:
    """Without the points whose mass is 0, which can have no cell."""
    if not len(masses):
        raise _scalars.refuse('skip_zero', 'is for masses; equal ones are more than 0')
    kept = masses != 0
    # Of masses that are not as many as points the transport tells.
    if len(masses) != len(taken) or kept.all():
        return taken, masses
    if not kept.any():
        raise _scalars.refuse('masses', 'no point has any')
    warn([f'skip_zero: {len(kept) - kept.sum()} of {len(kept)} points, whose mass is 0, are left out'])
    return taken.kept(_arguments.listed(kept)), masses[kept]


class Session:
    """One backend and device, ready to work; its runs share what opening it took.

    Any thread may use it. Runs of several threads come one after the other; sessions of their own run side by
    side. It can be used in a with statement, and closes at its end. A process that was forked cannot use the
    sessions of its parent.

    Args:
        backend: "auto", "vulkan", "vulkan-compute", "vulkan-geometry", "opengl" or "cpu". "auto" takes the best.
        device: an index or a part of a name, as `devices` lists them; None for the best.
        threads: of the processor; None for all.
        validation: Vulkan's validation layers; what they say is in `Report.validation_messages`.
        disabled: features that the device is to do without, by their Vulkan names.
        limits: limits that it is to have, by their Vulkan names.

    Raises:
        InputError: no such backend.
        DeviceError: it is not here, or fails; the message says what would help.
    """

    def __init__(self, backend: str = 'auto', device: Union[None, int, str] = None, threads: Optional[int] = None,
                 validation: bool = False, *, disabled: Sequence[str] = (),
                 limits: Optional[Mapping[str, int]] = None) -> None:
        if backend not in _vorpipe.backend_names():
            raise _scalars.refuse('backend', f'{backend!r} is none of {", ".join(_vorpipe.backend_names())}')
        self._threads = _arguments.threads_of(threads)
        self._session = _vorpipe.Session(backend, '' if device is None else str(device), self._threads,
                                         _scalars.flag_of('validation', validation),
                                         _arguments.mask_of(disabled, limits))

    def cells(self, points: Any, weights: Any = None, domain: Any = None, *,
              periodic: Union[None, bool, str] = None, density: Any = None, outline: Any = None,
              check: bool = False, detail: str = 'everything', search: str = 'grid',
              progress: Optional[Progress] = None, attributes: Optional[Mapping[str, Any]] = None,
              project: Project = None, margin: Margin = None, repair: bool = False, crs: Any = None,
              surface: Optional[str] = None,
              density_box: Optional[Sequence[float]] = None) -> Diagram:
        """As `vorpipe.cells`."""
        wanted = _arguments.domain_of(domain, outline, margin, repair, project)
        taken = input_of(points, weights, wanted, periodic, density, attributes, crs, surface, density_box=density_box)
        method, neighbors = _arguments.search_of(search)
        diagram = Diagram(self._session.cells(taken, _scalars.text_of('detail', detail), method, neighbors,
                                              _scalars.call_of('progress', progress)))
        if check:
            raise_broken(diagram.check(self._threads or None))
        return diagram

    def render(self, points: Any, weights: Any = None, domain: Any = None, *,
               size: Optional[Sequence[int]] = None, color: Any = 'site',
               colormap: Union[None, str, Sequence[str]] = None,
               edges: bool = False, show_sites: bool = False, periodic: Union[None, bool, str] = None,
               outline: Any = None, check: bool = False, search: str = 'grid',
               progress: Optional[Progress] = None, color_scale: Optional[str] = None,
               color_range: Optional[Sequence[float]] = None, legend: Union[bool, str] = False, edge_width: float = 1,
               dot_size: Optional[float] = None, fit: Optional[str] = None, project: Project = None,
               margin: Margin = None, repair: bool = False, crs: Any = None, antialias: int = 1, dual: bool = False,
               labels: Any = False, label_size: float = 10, fill: bool = True,
               edge_color: Optional[str] = None, background: Optional[str] = None,
               view: Optional[Sequence[float]] = None, surface: Optional[str] = None, title: Optional[str] = None,
               legend_title: Optional[str] = None) -> Picture:
        """As `vorpipe.render`."""
        wanted = _arguments.domain_of(domain, outline, margin, repair, project)
        taken = input_of(points, weights, wanted, periodic, crs=crs, surface=surface)
        look = _look.look_of(len(taken), size, color, colormap=colormap, color_scale=color_scale,
                                  color_range=color_range, legend=legend, fit=fit, search=search, fill=fill,
                                  edge_color=edge_color, background=background, view=view, edges=edges,
                                  show_sites=show_sites, dual=dual, labels=labels, edge_width=edge_width,
                                  dot_size=dot_size, label_size=label_size, antialias=antialias, title=title,
                                  legend_title=legend_title)
        picture = Picture(self._session.render(taken, look, _scalars.call_of('progress', progress)))
        if check:
            raise_broken(picture.check(self._threads or None))
        return picture

    def draw(self, points: Any, path: PathLike, weights: Any = None, domain: Any = None, *,
             size: Optional[Sequence[int]] = None, color: Any = 'site',
               colormap: Union[None, str, Sequence[str]] = None,
             edges: bool = False, show_sites: bool = False, periodic: Union[None, bool, str] = None,
             outline: Any = None, check: bool = False, search: str = 'grid', progress: Optional[Progress] = None,
             color_scale: Optional[str] = None, color_range: Optional[Sequence[float]] = None, legend: Union[bool, str] = False,
             edge_width: float = 1, dot_size: Optional[float] = None, fit: Optional[str] = None,
             project: Project = None, margin: Margin = None, repair: bool = False, crs: Any = None,
             antialias: int = 1, dual: bool = False, labels: Any = False, label_size: float = 10,
             fill: bool = True, edge_color: Optional[str] = None, background: Optional[str] = None,
             view: Optional[Sequence[float]] = None, surface: Optional[str] = None, title: Optional[str] = None,
             legend_title: Optional[str] = None) -> Diagram:
        """As `vorpipe.draw`."""
        wanted = _arguments.domain_of(domain, outline, margin, repair, project)
        taken = input_of(points, weights, wanted, periodic, crs=crs, surface=surface)
        look = _look.look_of(len(taken), size, color, colormap=colormap, color_scale=color_scale,
                                  color_range=color_range, legend=legend, fit=fit, search=search, fill=fill,
                                  edge_color=edge_color, background=background, view=view, edges=edges,
                                  show_sites=show_sites, dual=dual, labels=labels, edge_width=edge_width,
                                  dot_size=dot_size, label_size=label_size, antialias=antialias, title=title,
                                  legend_title=legend_title)
        to = _scalars.path_of(path)
        cells = self._session.shapes(taken, look, to, _scalars.call_of('progress', progress))
        diagram = Diagram(cells)
        if check:
            raise_broken(diagram.check(self._threads or None))
        _vorpipe.save_shapes(cells, look, to, self._threads)
        return diagram

    def relax(self, points: Any, weights: Any = None, domain: Any = None, *,
              periodic: Union[None, bool, str] = None, density: Any = None, outline: Any = None,
              method: str = 'lbfgs', iterations: int = 50, tolerance: float = 0, equal_masses: bool = False,
              search: str = 'grid', progress: Optional[Progress] = None,
              attributes: Optional[Mapping[str, Any]] = None, project: Project = None, margin: Margin = None,
              repair: bool = False, crs: Any = None,
              density_box: Optional[Sequence[float]] = None) -> Relaxed:
        """As `vorpipe.relax`."""
        wanted = _arguments.domain_of(domain, outline, margin, repair, project)
        taken = input_of(points, weights, wanted, periodic, density, attributes, crs, density_box=density_box)
        found, neighbors = _arguments.search_of(search)
        options = _arguments.options_of(_vorpipe.RELAX, {'method': method, 'iterations': iterations,
                                                         'tolerance': tolerance, 'equal_masses': equal_masses})
        arguments = _vorpipe.RelaxArguments(options, found, neighbors)
        return Relaxed(self._session.relax(taken, arguments, _scalars.call_of('progress', progress)))

    def transport(self, points: Any, masses: Any = None, density: Any = None, domain: Any = None,
                  weights: Any = None, *, tolerance: float = 1e-8, diagrams: int = 400, normalize: bool = False,
                  surface: Optional[str] = None, fill: Optional[float] = None, callback: Optional[StepCallback] = None,
                  periodic: Union[None, bool, str] = None, outline: Any = None, search: str = 'grid',
                  progress: Optional[Progress] = None, attributes: Optional[Mapping[str, Any]] = None,
                  project: Project = None, margin: Margin = None, repair: bool = False,
                  crs: Any = None, density_box: Optional[Sequence[float]] = None,
                  skip_zero: bool = False) -> Transported:
        """As `vorpipe.transport`."""
        wanted = _arguments.domain_of(domain, outline, margin, repair, project)
        taken = input_of(points, weights, wanted, periodic, density, attributes, crs, density_box=density_box)
        masses = _arguments.masses_of(masses)
        if _scalars.flag_of('skip_zero', skip_zero):
            taken, masses = without_zeros(taken, masses)
        found, neighbors = _arguments.search_of(search)
        options = _arguments.options_of(_vorpipe.TRANSPORT, {'tolerance': tolerance, 'diagrams': diagrams})
        arguments = _vorpipe.TransportArguments(masses=masses, normalize=_scalars.flag_of('normalize', normalize),
                                                fill=_scalars.number_or_none('fill', fill),
                                                free_surface=_arguments.surface_of(surface), options=options,
                                                search=found, neighbors=neighbors)
        found_weights = self._session.transport(taken, arguments, _scalars.call_of('callback', callback),
                                                _scalars.call_of('progress', progress))
        return Transported(found_weights, self)

    @property
    def device(self) -> _vorpipe.DeviceInfo:
        """Backend, device and driver in use."""
        return self._session.device()

    @property
    def choice(self) -> str:
        """Why "auto" or "vulkan" took this backend; empty where the caller named it."""
        return self._session.choice()

    def arithmetic(self) -> _vorpipe.Arithmetic:
        """Measures how the device rounds."""
        return self._session.arithmetic()

    @property
    def closed(self) -> bool:
        return self._session.closed

    def close(self) -> None:
        """Gives the device back, once the run in progress is over."""
        self._session.close()

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __reduce__(self) -> NoReturn:
        raise TypeError('a Session is of the process that opened it: let each process open its own')

    def __repr__(self) -> str:
        return '<vorpipe.Session, closed>' if self.closed else f'<vorpipe.Session {self.device!r}>'


def raise_broken(broken: Sequence[str]) -> None:
    if broken:
        raise CheckError('\n'.join(broken), 'check')


_Key = Tuple[int, str, str, int]
_shared: Dict[_Key, Session] = {}
_lock = threading.Lock()


def backend_for(backend: str, device: Union[None, int, str], points: int, pixels: int = 0) -> str:
    """What "auto" means for a run of `points` points and `pixels` pixels."""
    few = points <= FEW_POINTS and pixels <= FEW_PIXELS
    return 'cpu' if backend == 'auto' and device is None and few else backend


def shared_session(backend: str, device: Union[None, int, str], threads: Optional[int]) -> Session:
    """The session that this process has for them; opened when it is first asked for."""
    key = (os.getpid(), backend, '' if device is None else str(device), _arguments.threads_of(threads))
    with _lock:
        session = _shared.get(key)
        if session is None or session.closed:
            session = _shared[key] = Session(backend, device, threads)
        return session


def close_sessions() -> None:
    """Closes the sessions that `cells`, `render` and the other functions of the package share.

    They are kept, one for each backend, device and number of threads that was asked for, since opening a GPU may
    take half a second; the next call opens one again.
    """
    with _lock:
        for session in _shared.values():
            session.close()
        _shared.clear()


def _begin_anew() -> None:
    global _lock
    _vorpipe.forget_runs()
    _lock = threading.Lock()


def _close_at_exit() -> None:
    # A thread that opens one never comes back to give the lock: it goes with the program.
    if _lock.acquire(blocking=False):
        _lock.release()
        close_sessions()


# The last one comes first.
atexit.register(_close_at_exit)
atexit.register(_vorpipe.end_runs)
os.register_at_fork(after_in_child=_begin_anew)
