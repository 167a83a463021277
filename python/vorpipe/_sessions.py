"""Sessions, and the ones that the functions of the package share."""
from __future__ import annotations

import atexit
import os
import threading
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Tuple, Union

from . import _arguments, _vorpipe
from ._diagram import Diagram
from ._errors import CheckError
from ._picture import Picture

Progress = Callable[[str, float], Optional[bool]]

# Up to this many points and pixels "auto" does not look for a GPU: the processor is done before one is ready.
FEW_POINTS, FEW_PIXELS = 100_000, 4_000_000


def input_of(points: Any, weights: Any, domain: Any, periodic: Union[None, bool, str], outline: Any,
             density: Any) -> _vorpipe.Input:
    array = _arguments.points_of(points)
    return _vorpipe.Input(array, _arguments.weights_of(weights, len(array)), _arguments.box_of(domain),
                          _arguments.periodic_of(periodic), _arguments.outline_of(outline),
                          _arguments.density_of(density))


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
            raise _arguments.refuse('backend', f'{backend!r} is none of {", ".join(_vorpipe.backend_names())}')
        self._threads = _arguments.threads_of(threads)
        self._session = _vorpipe.Session(backend, '' if device is None else str(device), self._threads, validation,
                                         _arguments.mask_of(disabled, limits))

    def cells(self, points: Any, weights: Any = None, domain: Any = None, *,
              periodic: Union[None, bool, str] = None, density: Any = None, outline: Any = None,
              check: bool = False, detail: str = 'everything', search: str = 'grid',
              progress: Optional[Progress] = None) -> Diagram:
        """As `vorpipe.cells`."""
        given = input_of(points, weights, domain, periodic, outline, density)
        method, neighbors = _arguments.search_of(search)
        diagram = Diagram(self._session.cells(given, detail, method, neighbors, progress))
        if check:
            raise_broken(diagram.check(self._threads or None))
        return diagram

    def render(self, points: Any, weights: Any = None, domain: Any = None, *,
               size: Optional[Sequence[int]] = None, color: str = 'site', colormap: str = 'viridis',
               edges: bool = False, show_sites: bool = False, periodic: Union[None, bool, str] = None,
               outline: Any = None, check: bool = False, search: str = 'grid',
               progress: Optional[Progress] = None) -> Picture:
        """As `vorpipe.render`."""
        given = input_of(points, weights, domain, periodic, outline, None)
        if colormap not in _vorpipe.colormaps():
            raise _arguments.refuse('colormap', f'{colormap!r} is none of {", ".join(_vorpipe.colormaps())}')
        method, neighbors = _arguments.search_of(search)
        picture = Picture(self._session.render(given, _arguments.size_of(size), color, colormap, edges, show_sites,
                                               method, neighbors, progress))
        if check:
            raise_broken(picture.check(self._threads or None))
        return picture

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


def _renew_lock() -> None:
    global _lock
    _lock = threading.Lock()


atexit.register(_vorpipe.wait_for_runs)
atexit.register(close_sessions)
os.register_at_fork(after_in_child=_renew_lock)
