"""Options of functions, as keywords: each stands here once, with its type and its default."""
import functools
import inspect
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, TypedDict, TypeVar, Union, cast

from . import _vorpipe
from ._arguments import Size
from ._names import renamed
from ._shared import Progress
from ._warnings import deprecated

StepCallback = Callable[[_vorpipe.TransportStep], Optional[bool]]
Project = Union[None, bool, str, Sequence[float]]
Margin = Union[None, float, str]
_Function = TypeVar('_Function', bound=Callable[..., Any])


class RunOptions(TypedDict, total=False):
    """Of every run, for its input and its progress."""

    periodic: Union[None, bool, str]
    project: Project
    margin: Margin
    domain_layer: Optional[str]
    repair: bool
    crs: Any
    search: str
    progress: Optional[Progress]


class DensityOptions(RunOptions, total=False):
    density_box: Optional[Sequence[float]]
    attributes: Optional[Mapping[str, Any]]


class CellsOptions(DensityOptions, total=False):
    density: Any
    surface: Optional[str]
    check: bool
    detail: str
    globe: bool
    lattice: Any


class PictureOptions(RunOptions, total=False):
    size: Size
    fit: Optional[str]
    view: Optional[Sequence[float]]
    color: Any
    colormap: Union[None, str, Sequence[str]]
    color_scale: Optional[str]
    color_range: Optional[Sequence[float]]
    legend: Union[bool, str]
    legend_title: Optional[str]
    title: Optional[str]
    edges: bool
    edge_color: Optional[str]
    dual: bool
    edge_width: float
    show_sites: bool
    dot_size: Optional[float]
    labels: Any
    label_size: float
    fill: bool
    background: Optional[str]
    antialias: int
    surface: Optional[str]
    check: bool
    globe: bool
    map: Optional[str]
    view_from: Optional[Sequence[float]]
    graticule: float


class RelaxOptions(DensityOptions, total=False):
    density: Any
    method: str
    iterations: int
    tolerance: float
    equal_masses: bool
    globe: bool


class TransportOptions(DensityOptions, total=False):
    tolerance: float
    diagrams: int
    normalize: bool
    skip_zero: bool
    surface: Optional[str]
    fill: Optional[float]
    callback: Optional[StepCallback]


# Others are None.
_USUAL: Dict[Any, Dict[str, Any]] = {
    CellsOptions: {'check': False, 'detail': 'all', 'globe': False},
    PictureOptions: {**_vorpipe.MARKS, 'dot_size': None, 'color': 'site', 'legend': False, 'fill': True,
                     'check': False, 'globe': False},
    RelaxOptions: {**_vorpipe.RELAX, 'globe': False},
    TransportOptions: {**_vorpipe.TRANSPORT, 'normalize': False, 'skip_zero': False},
}


def usual(kind: Any) -> Dict[str, Any]:
    """The default of each option."""
    return {**dict.fromkeys(kind.__annotations__), 'repair': False, 'search': 'grid', **_USUAL[kind]}


def taking(kind: Any, *once_placed: str) -> Callable[[_Function], _Function]:
    """For a function with **options of this kind: has all of them, shows them in its signature, and refuses others.

    What was taken by its place before still is, for a release.
    """

    def decorate(function: _Function) -> _Function:
        defaults, signature = usual(kind), inspect.signature(function)
        *own, _ = signature.parameters.values()
        most = sum(parameter.kind == parameter.POSITIONAL_OR_KEYWORD for parameter in own)
        options = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=defaults[name], annotation=hint)
                   for name, hint in kind.__annotations__.items()]
        shown = signature.replace(parameters=own + options)

        @functools.wraps(function)
        def call(*arguments: Any, **named: Any) -> Any:
            for name, value in zip(once_placed, arguments[most:]):
                deprecated(f'{name} is a keyword now: {name}=')
                if named.setdefault(name, value) is not value:
                    raise TypeError(f'{function.__name__}() got multiple values for argument {name!r}')
            for name in named.keys() - shown.parameters.keys():
                raise TypeError(f'{function.__name__}() got an unexpected keyword argument {name!r}')
            placed = arguments[:most] + arguments[most + len(once_placed):]
            return function(*placed, **{**defaults, **named})

        call.__signature__ = shown  # type: ignore[attr-defined]
        return renamed(outline='domain')(cast(_Function, call))

    return decorate
