"""Sessions: what runs take, and what they bring."""
from __future__ import annotations

from typing import Any, Callable, Mapping, NoReturn, Optional, Sequence, Union

from . import _arguments, _attributes, _crs, _look, _scalars, _shared, _vorpipe
from ._arguments import PathLike, Size
from ._diagram import Diagram
from ._errors import CheckError
from ._names import renamed
from ._picture import Picture
from ._points import given
from ._relaxed import Relaxed
from ._shared import Device, Progress
from ._transported import Transported
from ._warnings import warn

StepCallback = Callable[[_vorpipe.TransportStep], Optional[bool]]
Project = Union[None, bool, str, Sequence[float]]
Margin = Union[None, float, str]


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
        self._threads = _arguments.threads_of(threads)
        self._session = _shared.opened(backend, device, threads, validation, disabled, limits)

    @classmethod
    def _around(cls, session: _vorpipe.Session, threads: Optional[int]) -> Session:
        made = cls.__new__(cls)
        made._session, made._threads = session, _arguments.threads_of(threads)
        return made

    @renamed(outline='domain')
    def cells(self, points: Any, weights: Any = None, domain: Any = None, *, periodic: Union[None, bool, str] = None,
              density: Any = None, check: bool = False, detail: str = 'all', search: str = 'grid',
              progress: Optional[Progress] = None, attributes: Optional[Mapping[str, Any]] = None,
              project: Project = None, margin: Margin = None, domain_layer: Optional[str] = None, repair: bool = False,
              crs: Any = None, surface: Optional[str] = None, density_box: Optional[Sequence[float]] = None,
              globe: bool = False) -> Diagram:
        """As `vorpipe.cells`."""
        found = given(points)
        wanted = _arguments.domain_of(domain, margin, repair, project, domain_layer, globe)
        taken = input_of(found, weights, wanted, periodic, density, attributes, crs, surface, density_box=density_box)
        method, neighbors = _arguments.search_of(search)
        made = self._session.cells(taken, _arguments.detail_of(detail), method, neighbors,
                                   _scalars.call_of('progress', progress))
        diagram = Diagram(made, found.index)
        if check:
            raise_broken(diagram.check(self._threads or None))
        return diagram

    @renamed(outline='domain')
    def render(self, points: Any, weights: Any = None, domain: Any = None, *, size: Size = None, color: Any = 'site',
               colormap: Union[None, str, Sequence[str]] = None, edges: bool = False, show_sites: bool = False,
               periodic: Union[None, bool, str] = None, check: bool = False, search: str = 'grid',
               progress: Optional[Progress] = None, color_scale: Optional[str] = None,
               color_range: Optional[Sequence[float]] = None, legend: Union[bool, str] = False, edge_width: float = 1,
               dot_size: Optional[float] = None, fit: Optional[str] = None, project: Project = None,
               margin: Margin = None, domain_layer: Optional[str] = None, repair: bool = False, crs: Any = None,
               antialias: int = 1, dual: bool = False, labels: Any = False, label_size: float = 10, fill: bool = True,
               edge_color: Optional[str] = None, background: Optional[str] = None,
               view: Optional[Sequence[float]] = None, surface: Optional[str] = None, title: Optional[str] = None,
               legend_title: Optional[str] = None) -> Picture:
        """As `vorpipe.render`."""
        found = given(points)
        wanted = _arguments.domain_of(domain, margin, repair, project, domain_layer)
        taken = input_of(found, weights, wanted, periodic, crs=crs, surface=surface)
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

    @renamed(outline='domain')
    def draw(self, points: Any, path: PathLike, weights: Any = None, domain: Any = None, *, size: Size = None,
             color: Any = 'site', colormap: Union[None, str, Sequence[str]] = None,
             edges: bool = False, show_sites: bool = False,
             periodic: Union[None, bool, str] = None, check: bool = False, search: str = 'grid',
             progress: Optional[Progress] = None, color_scale: Optional[str] = None,
             color_range: Optional[Sequence[float]] = None, legend: Union[bool, str] = False, edge_width: float = 1,
             dot_size: Optional[float] = None, fit: Optional[str] = None, project: Project = None,
             margin: Margin = None, domain_layer: Optional[str] = None, repair: bool = False, crs: Any = None,
             antialias: int = 1, dual: bool = False, labels: Any = False, label_size: float = 10, fill: bool = True,
             edge_color: Optional[str] = None, background: Optional[str] = None,
             view: Optional[Sequence[float]] = None, surface: Optional[str] = None, title: Optional[str] = None,
             legend_title: Optional[str] = None) -> Diagram:
        """As `vorpipe.draw`."""
        found = given(points)
        wanted = _arguments.domain_of(domain, margin, repair, project, domain_layer)
        taken = input_of(found, weights, wanted, periodic, crs=crs, surface=surface)
        look = _look.look_of(len(taken), size, color, colormap=colormap, color_scale=color_scale,
                             color_range=color_range, legend=legend, fit=fit, search=search, fill=fill,
                             edge_color=edge_color, background=background, view=view, edges=edges,
                             show_sites=show_sites, dual=dual, labels=labels, edge_width=edge_width,
                             dot_size=dot_size, label_size=label_size, antialias=antialias, title=title,
                             legend_title=legend_title)
        to = _scalars.path_of(path)
        cells = self._session.shapes(taken, look, to, _scalars.call_of('progress', progress))
        diagram = Diagram(cells, found.index)
        if check:
            raise_broken(diagram.check(self._threads or None))
        _vorpipe.save_shapes(cells, look, to, self._threads)
        return diagram

    @renamed(outline='domain')
    def relax(self, points: Any, weights: Any = None, domain: Any = None, *, periodic: Union[None, bool, str] = None,
              density: Any = None, method: str = 'lbfgs', iterations: int = 50, tolerance: float = 0,
              equal_masses: bool = False, search: str = 'grid', progress: Optional[Progress] = None,
              attributes: Optional[Mapping[str, Any]] = None, project: Project = None, margin: Margin = None,
              domain_layer: Optional[str] = None, repair: bool = False, crs: Any = None,
              density_box: Optional[Sequence[float]] = None) -> Relaxed:
        """As `vorpipe.relax`."""
        found = given(points)
        wanted = _arguments.domain_of(domain, margin, repair, project, domain_layer)
        taken = input_of(found, weights, wanted, periodic, density, attributes, crs, density_box=density_box)
        options = _arguments.options_of(_vorpipe.RELAX, {'method': method, 'iterations': iterations,
                                                         'tolerance': tolerance, 'equal_masses': equal_masses})
        arguments = _vorpipe.RelaxArguments(options, *_arguments.search_of(search))
        return Relaxed(self._session.relax(taken, arguments, _scalars.call_of('progress', progress)), found.index)

    @renamed(outline='domain')
    def transport(self, points: Any, masses: Any = None, density: Any = None, domain: Any = None, weights: Any = None,
                  *, tolerance: float = 1e-8, diagrams: int = 400, normalize: bool = False,
                  surface: Optional[str] = None, fill: Optional[float] = None, callback: Optional[StepCallback] = None,
                  periodic: Union[None, bool, str] = None, search: str = 'grid', progress: Optional[Progress] = None,
                  attributes: Optional[Mapping[str, Any]] = None, project: Project = None, margin: Margin = None,
                  domain_layer: Optional[str] = None, repair: bool = False, crs: Any = None,
                  density_box: Optional[Sequence[float]] = None, skip_zero: bool = False) -> Transported:
        """As `vorpipe.transport`."""
        found = given(points)
        wanted = _arguments.domain_of(domain, margin, repair, project, domain_layer)
        taken = input_of(found, weights, wanted, periodic, density, attributes, crs, density_box=density_box)
        masses, index = _arguments.masses_of(masses), found.index
        if _scalars.flag_of('skip_zero', skip_zero):
            kept = kept_of(masses, len(taken))
            if kept is not None:
                taken, masses = taken.kept(_arguments.listed(kept)), masses[kept]
                index = None if index is None else index[kept]
        method, neighbors = _arguments.search_of(search)
        options = _arguments.options_of(_vorpipe.TRANSPORT, {'tolerance': tolerance, 'diagrams': diagrams})
        arguments = _vorpipe.TransportArguments(masses=masses, normalize=_scalars.flag_of('normalize', normalize),
                                                fill=_scalars.number_or_none('fill', fill),
                                                free_surface=_arguments.surface_of(surface), options=options,
                                                search=method, neighbors=neighbors)
        found_weights = self._session.transport(taken, arguments, _scalars.call_of('callback', callback),
                                                _scalars.call_of('progress', progress))
        return Transported(found_weights, index, self._session)

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
