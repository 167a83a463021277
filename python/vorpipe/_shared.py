"""Sessions that the functions of the package share, and results open again: one for each device and process."""
from __future__ import annotations

import atexit
import os
import threading
from typing import Callable, Dict, Mapping, Optional, Sequence, Tuple, Union

from . import _arguments, _scalars, _vorpipe

Device = Union[None, int, str]
Progress = Callable[[str, float], Optional[bool]]

# Up to this many points and pixels "auto" does not look for a GPU: the processor is done before one is ready.
FEW_POINTS, FEW_PIXELS = 100_000, 4_000_000

_Key = Tuple[int, str, str, int]
_shared: Dict[_Key, _vorpipe.Session] = {}
_lock = threading.Lock()


def opened(backend: str, device: Device, threads: Optional[int], validate: bool = False,
           disable: Sequence[str] = (), limit: Optional[Mapping[str, int]] = None) -> _vorpipe.Session:
    """A session of its own."""
    if backend not in _vorpipe.backend_names():
        raise _scalars.refuse('backend', f'{backend!r} is none of {", ".join(_vorpipe.backend_names())}')
    return _vorpipe.Session(backend, '' if device is None else str(device), _arguments.threads_of(threads),
                            _scalars.flag_of('validate', validate), _arguments.mask_of(disable, limit))


def backend_for(backend: str, device: Device, points: int, pixels: int = 0) -> str:
    """What "auto" means for a run of `points` points and `pixels` pixels."""
    few = points <= FEW_POINTS and pixels <= FEW_PIXELS
    return 'cpu' if backend == 'auto' and device is None and few else backend


def shared(backend: str, device: Device, threads: Optional[int]) -> _vorpipe.Session:
    """The session that this process has for them; opened when it is first asked for."""
    key = (os.getpid(), backend, '' if device is None else str(device), _arguments.threads_of(threads))
    with _lock:
        session = _shared.get(key)
        if session is None or session.closed:
            session = _shared[key] = opened(backend, device, threads)
        return session


def shared_for(points: int) -> _vorpipe.Session:
    """For so many points, where nobody says which."""
    return shared(backend_for('auto', None, points), None, None)


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
