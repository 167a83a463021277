"""Sessions: what runs take, and what they bring."""
from __future__ import annotations

from typing import Any, Mapping, NoReturn, Optional, Sequence, Tuple, TypeVar, Union, Unpack

from . import _arguments, _attributes, _crs, _look, _scalars, _shared, _vorpipe
from ._arguments import PathLike
from ._diagram import Diagram
from ._errors import CheckError
from ._names import renamed
from ._options import CellsOptions, PictureOptions, RelaxOptions, TransportOptions, taking
from ._picture import Picture
from ._points import Given, given
from ._relaxed import Relaxed
from ._space import Diagram3, cells_in_space, sites_in_space
from ._transported import Transported
from ._warnings import warn

_Result = TypeVar('_Result', Diagram, Diagram3, Picture)


def input_of(points: Any, weights: Any, domain: _vorpipe.Domain, periodic: Union[None, bool, str],
             density: Any = None, attributes: Any = None, crs: Any = None,
             surface: Optional[str] = None, density_box: Optional[Sequence[float]] = None) -> _vorpipe.Input:
    found = given(points)
    taken, count, system = found.taken, len(found.taken), _crs.system_of(crs)
    own = taken.attributes if isinstance(taken, _vorpipe.Table) else None
    if system is not None and isinstance(taken, _vorpipe.Table):
        names = _vorpipe.differing_systems(taken.system, system)
        if names is not None:
            raise _scalars.refuse('crs', f'is {names[1]}, and the points say that they are in {names[0]}; their to_crs '
                                         'takes them to another system')
    made = _vorpipe.Input(taken, _arguments.weights_of(weights, count), domain, _arguments.periodic_of(periodic),
                          _arguments.density_of(density, density_box),
                          _attributes.attributes_of(attributes, count, own), system, _arguments.surface_of(surface))
    warn(made.notes)
    return made


def taken_of(points: Any, weights: Any, domain: Any, options: Mapping[str, Any]) -> Tuple[Given, _vorpipe.Input]:
    """What is given for points, and the input of a run with these options."""
    found = given(points)
    wanted = _arguments.domain_of(domain, options['margin'], options['repair'], options['project'],
                                  options['domain_layer'], options.get('globe', False))
    return found, input_of(found, weights, wanted, options['periodic'], options.get('density'),
                           options.get('attributes'), options['crs'], options.get('surface'),
                           options.get('density_box'))


def kept_of(masses: _arguments.Floats, count: int) -> Optional[_arguments.Bools]:
    """Which points have a mass that is not 0, without which there is no cell; None: all."""
    if not len(masses):
        raise _scalars.refuse('skip_zero', 'is for masses; equal ones are more than 0')
    kept = masses != 0
    # Of masses that are not as many as points the transport tells.
    if len(masses) != count or kept.all():
        return None
    if not kept.any():
        raise _scalars.refuse('masses', 'no point has any')
    warn([f'skip_zero: {len(kept) - kept.sum()} of {len(kept)} points, whose mass is 0, are left out'])
    return kept


class Session:
    """One backend and device, ready to work; its runs share what opening it took.

    Any thread may use it. Runs of several threads come one after the other; sessions of their own run side by
    side. It can be used in a with statement, and closes at its end. A process that was forked cannot use the
    sessions of its parent.

    Args:
        backend: "auto", "vulkan", "vulkan-compute", "vulkan-geometry", "opengl" or "cpu". "auto" takes the best.
        device: an index or a part of a name, as `devices` lists them; None for the best.
        threads: of the processor; None for all.
        validate: Vulkan's validation layers; what they say is in `Report.validation_messages`.
        disable: features that the device is to do without, by their Vulkan names.
        limit: limits that it is to have, by their Vulkan names.

    Raises:
        InputError: no such backend.
        DeviceError: it is not here, or fails; the message says what would help.
    """

    @renamed(validation='validate', disabled='disable', limits='limit')
    def __init__(self, backend: str = 'auto', device: Union[None, int, str] = None, threads: Optional[int] = None,
                 validate: bool = False, *, disable: Sequence[str] = (),
                 limit: Optional[Mapping[str, int]] = None) -> None:
        self._threads = _arguments.threads_of(threads)
        self._session = _shared.opened(backend, device, threads, validate, disable, limit)

    @classmethod
    def _around(cls, session: _vorpipe.Session, threads: Optional[int]) -> Session:
        made = cls.__new__(cls)
        made._session, made._threads = session, _arguments.threads_of(threads)
        return made

    @taking(CellsOptions)
    def cells(self, points: Any, weights: Any = None, domain: Any = None,
              **options: Unpack[CellsOptions]) -> Diagram:
        """As `vorpipe.cells`."""
        in_space = sites_in_space(points)
        if in_space is not None:
            cells: Any = cells_in_space(self._session, in_space, weights, domain, options)
            return self._checked(cells, options['check'])
        if options['lattice'] is not None:
            raise _scalars.refuse('lattice', 'is of points in space, (N, 3)')
        found, taken = taken_of(points, weights, domain, options)
        made = self._session.cells(taken, _arguments.detail_of(options['detail']),
                                   *_arguments.search_of(options['search']),
                                   _scalars.call_of('progress', options['progress']))
        return self._checked(Diagram(made, found.index), options['check'])

    @taking(PictureOptions)
    def render(self, points: Any, weights: Any = None, domain: Any = None,
               **options: Unpack[PictureOptions]) -> Picture:
        """As `vorpipe.render`."""
        _, taken = taken_of(points, weights, domain, options)
        look = _look.look_of(len(taken), options)
        made = self._session.render(taken, look, _scalars.call_of('progress', options['progress']))
        return self._checked(Picture(made), options['check'])

    @taking(PictureOptions)
    def draw(self, points: Any, path: PathLike, weights: Any = None, domain: Any = None,
             **options: Unpack[PictureOptions]) -> Diagram:
        """As `vorpipe.draw`."""
        found, taken = taken_of(points, weights, domain, options)
        look, to = _look.look_of(len(taken), options), _scalars.path_of(path)
        cells = self._session.shapes(taken, look, to, _scalars.call_of('progress', options['progress']))
        diagram = self._checked(Diagram(cells, found.index), options['check'])
        _vorpipe.save_shapes(cells, look, to, self._threads)
        return diagram

    @taking(RelaxOptions)
    def relax(self, points: Any, weights: Any = None, domain: Any = None, **options: Unpack[RelaxOptions]) -> Relaxed:
        """As `vorpipe.relax`."""
        found, taken = taken_of(points, weights, domain, options)
        arguments = _vorpipe.RelaxArguments(_arguments.options_of(_vorpipe.RELAX, options),
                                            *_arguments.search_of(options['search']))
        return Relaxed(self._session.relax(taken, arguments, _scalars.call_of('progress', options['progress'])),
                       found.index)

    @taking(TransportOptions)
    def transport(self, points: Any, masses: Any = None, density: Any = None, domain: Any = None, weights: Any = None,
                  **options: Unpack[TransportOptions]) -> Transported:
        """As `vorpipe.transport`."""
        # The cells may end in air; of the input that is not said.
        found, taken = taken_of(points, weights, domain, {**options, 'density': density, 'surface': None})
        masses, index = _arguments.masses_of(masses), found.index
        if _scalars.flag_of('skip_zero', options['skip_zero']):
            kept = kept_of(masses, len(taken))
            if kept is not None:
                taken, masses = taken.kept(_arguments.listed(kept)), masses[kept]
                index = None if index is None else index[kept]
        method, neighbors = _arguments.search_of(options['search'])
        arguments = _vorpipe.TransportArguments(
            masses=masses, normalize=_scalars.flag_of('normalize', options['normalize']),
            fill=_scalars.number_or_none('fill', options['fill']),
            free_surface=_arguments.surface_of(options['surface']),
            options=_arguments.options_of(_vorpipe.TRANSPORT, options), search=method, neighbors=neighbors)
        found_weights = self._session.transport(taken, arguments, _scalars.call_of('callback', options['callback']),
                                                _scalars.call_of('progress', options['progress']))
        return Transported(found_weights, index, self._session)

    def _checked(self, result: _Result, check: bool) -> _Result:
        broken = result.check(self._threads or None) if check else []
        if broken:
            raise CheckError('\n'.join(broken), 'check')
        return result

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

