"""Arguments of any kind to arrays of the shapes that vorpipe takes; what cannot be is refused by name."""
from __future__ import annotations

import os
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union, cast

import numpy as np
import numpy.typing as npt

from . import _vorpipe
from ._crs import System, system_of
from ._scalars import MOST, flag_of, number_of, path_of, refuse, text_of, text_or_none, whole_of
from ._warnings import deprecated

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]
Mask = Tuple[List[str], List[Tuple[str, int]]]
#: points, offsets of rings and of polygons, the file, the coordinate system
Outline = Tuple[Floats, npt.NDArray[np.uint64], npt.NDArray[np.uint64], bytes, Optional[System]]
#: values, the box of their pixels, the file, the system of that box
Density = Tuple[Floats, Optional[Tuple[float, float, float, float]], bytes, Optional[System]]
PathLike = Union[str, 'os.PathLike[str]']
#: of a picture: the longer side, or (width, height)
Size = Union[None, int, Sequence[int]]


def listed(array: npt.NDArray[Any]) -> List[Any]:
    """Of an array with axes. NumPy's own types have allowed for one without since 2.2."""
    return cast(List[Any], array.tolist())


def numbers(argument: str, value: Any) -> Floats:
    """As float64, without a copy where it is that already; strides of any kind."""
    array = array_of(argument, value)
    if array.dtype.kind not in 'biuf':
        try:
            if array.dtype.kind == 'c':
                raise TypeError
            return array.astype(np.float64)
        except (TypeError, ValueError):
            raise refuse(argument, f'expected numbers, got {array.dtype}') from None
    return array.astype(np.float64, copy=False)


def array_of(argument: str, value: Any) -> npt.NDArray[Any]:
    """Of any type; rows are as long as each other, and nothing is masked."""
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise refuse(argument, 'some elements are masked; leave them out')
    try:
        return np.asarray(value)
    except (TypeError, ValueError):
        raise refuse(argument, 'expected numbers in rows of one length') from None


def points_of(value: Any, argument: str = 'points') -> Floats:
    """An array of shape (N, 2)."""
    array = numbers(argument, value)
    if array.size == 0 and array.ndim < 3:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise refuse(argument, f'shape {array.shape}, must be (N, 2): one row for each point')
    return array


def weights_of(value: Any, count: int) -> Optional[Floats]:
    """An array of shape (N,)."""
    if value is None:
        return None
    if isinstance(value, (str, os.PathLike)):
        raise refuse('weights', f'{value!r} is a path: read_weights reads them from a file, and what is computed is '
                                'written by its save(path)')
    array = numbers('weights', value)
    if array.shape != (count,):
        raise refuse('weights', f'shape {array.shape}, must be ({count},): one for each point')
    return array


def box_of(value: Any, argument: str = 'domain') -> Optional[Tuple[float, float, float, float]]:
    """(xmin, ymin, xmax, ymax)."""
    if value is None:
        return None
    if isinstance(value, str) or hasattr(value, '__geo_interface__'):
        shown = repr(value) if isinstance(value, str) else f'a {type(value).__name__}'
        raise refuse(argument, f'{shown} is not 4 numbers: xmin, ymin, xmax, ymax')
    array = numbers(argument, value)
    if array.shape != (4,):
        raise refuse(argument, f'shape {array.shape}, must be 4 numbers: xmin, ymin, xmax, ymax')
    xmin, ymin, xmax, ymax = listed(array)
    return xmin, ymin, xmax, ymax


def margin_of(value: Union[None, float, str]) -> Optional[Tuple[float, bool]]:
    """A length, or a part of the longer side, as "10%"; and whether it is such a part."""
    if value is None:
        return None
    is_part = isinstance(value, str) and value.endswith('%')
    try:
        number = float(value[:-1]) / 100 if isinstance(value, str) and is_part else float(value)
    except (TypeError, ValueError):
        raise refuse('margin', f'{value!r} is neither a number nor one with %, as in "10%"') from None
    return number, is_part


def project_of(value: Any) -> Tuple[bool, Optional[Tuple[float, float]]]:
    """Whether to project, and the center if it is named: "auto" or (longitude, latitude)."""
    if value is None or value is False:
        return False, None
    if value is True or (isinstance(value, str) and value == 'auto'):
        return True, None
    try:
        longitude, latitude = (float(degrees) for degrees in value)
    except (TypeError, ValueError):
        raise refuse('project', f'{value!r} is neither "auto" nor (longitude, latitude)') from None
    return True, (longitude, latitude)


def domain_of(domain: Any, margin: Union[None, float, str] = None, repair: bool = False, project: Any = None,
              layer: Optional[str] = None, globe: bool = False) -> _vorpipe.Domain:
    """A box, "hull", or an outline; or the whole Earth."""
    hull = isinstance(domain, str) and domain == 'hull'
    is_outline = domain is not None and not hull and _is_outline(domain)
    if isinstance(domain, str) and not (hull or os.path.splitext(domain)[1]):
        raise refuse('domain', f'{domain!r} is neither "hull" nor a file with an outline')
    if layer is not None and not isinstance(domain, (str, os.PathLike)):
        raise refuse('domain_layer', 'is for a GeoPackage, and the domain is no path')
    wanted, center = project_of(project)
    return _vorpipe.Domain(None if hull or is_outline else box_of(domain), hull,
                           outline_of(domain, layer) if is_outline else None, margin_of(margin),
                           flag_of('repair', repair), wanted, center, flag_of('globe', globe))


def _is_outline(domain: Any) -> bool:
    """A box is a row of numbers."""
    if isinstance(domain, (str, os.PathLike, Mapping)) or hasattr(domain, '__geo_interface__'):
        return True
    inside = domain[0] if isinstance(domain, (list, tuple, np.ndarray)) and len(domain) else None
    return isinstance(inside, (list, tuple)) or np.ndim(inside) > 0 or hasattr(inside, '__geo_interface__')


def detail_of(value: str) -> str:
    if value == 'everything':
        deprecated('detail="everything" is "all" now')
        return 'all'
    return text_of('detail', value)


def range_of(value: Optional[Sequence[float]]) -> Optional[Tuple[float, float]]:
    """(low, high)."""
    if value is None:
        return None
    try:
        low, high = (float(end) for end in value)
    except (TypeError, ValueError):
        raise refuse('color_range', f'{value!r} is not (low, high)') from None
    return low, high


def options_of(usual: Mapping[str, Any], given: Mapping[str, Any]) -> Dict[str, Any]:
    """Those that are given, each of the type of its default; None is that of a text that need not be there."""
    options: Dict[str, Any] = {}
    for name, default in usual.items():
        if name not in given:
            continue
        value = given[name]
        if default is None:
            options[name] = text_or_none(name, value)
        elif isinstance(default, bool):
            options[name] = flag_of(name, value)
        elif isinstance(default, str):
            options[name] = text_of(name, value)
        elif isinstance(default, tuple):
            options[name] = pair_of(name, value)
        elif name in ('iterations', 'diagrams'):
            options[name] = iterations_of(value, name)
        elif isinstance(default, int):
            options[name] = whole_of(name, value, -2**31, 2**31 - 1)
        else:
            options[name] = number_of(name, value)
    return options


def density_of(value: Any, box: Optional[Sequence[float]] = None) -> Optional[Density]:
    """An array of shape (H, W), row 0 at the top, or the path of a .png or .npy file; and where its pixels lie."""
    place = box_of(box, 'density_box')
    if value is None:
        if place is not None:
            raise refuse('density_box', 'places a density, and there is none')
        return None
    if isinstance(value, (str, os.PathLike)):
        return _vorpipe.read_density(path_of(value, 'density'), place)
    array = numbers('density', value)
    if array.ndim != 2 or array.size == 0:
        raise refuse('density', f'shape {array.shape}, must be (H, W): one value for each pixel')
    return array, place, b'', None


def periodic_of(value: Union[None, bool, str]) -> str:
    if value is None or value is False:
        return 'none'
    if value is True:
        return 'xy'
    if not isinstance(value, str):
        raise refuse('periodic', f'{value!r} is none of "x", "y", "xy"')
    return value


def search_of(value: Any) -> Tuple[str, int]:
    """ "grid", "flann" or "flann:K" """
    method, colon, count = str(value).partition(':')
    if not colon:
        return method, 30
    if method != 'flann' or not count.isdecimal() or int(count) >= 2**31:
        raise refuse('search', f'{value!r} is none of "grid", "flann", "flann:K"')
    return method, int(count)


def size_of(value: Size) -> Optional[Tuple[int, Optional[int]]]:
    """(width, height), or the longer side and None."""
    if value is None:
        return None
    try:
        sides = (value,) if np.ndim(cast(Any, value)) == 0 and not isinstance(value, str) else tuple(cast(Any, value))
        if len(sides) > 2 or not sides or isinstance(value, str):
            raise ValueError
    except (TypeError, ValueError):
        raise refuse('size', f'{value!r} is neither the longer side nor (width, height) in pixels') from None
    pixels = [whole_of('size', side, -MOST, MOST, 'is no number of pixels') for side in sides]
    if min(pixels) < 1 or max(pixels) > _vorpipe.LARGEST_SIDE:
        raise refuse('size', f'{" x ".join(map(str, pixels))} pixels: must be 1 to {_vorpipe.LARGEST_SIDE} each')
    return pixels[0], pixels[1] if len(pixels) > 1 else None


def most_pixels(size: Optional[Tuple[int, Optional[int]]]) -> int:
    return 0 if size is None else size[0] * (size[1] or size[0])


def threads_of(value: Optional[int]) -> int:
    if value is None:
        return 0
    return whole_of('threads', value, 1, 2**31 - 1, 'is no number of threads; None takes all processors')


def iterations_of(value: int, argument: str = 'iterations') -> int:
    return whole_of(argument, value, 0, MOST, 'is no number of diagrams')


def masses_of(value: Any) -> Floats:
    """(N,); empty where there are none."""
    if value is None:
        return np.empty(0)
    array = numbers('masses', value)
    if array.ndim != 1:
        raise refuse('masses', f'shape {array.shape}, must be (N,)')
    return array


def vectors_of(argument: str, value: Any, count: int) -> Optional[Floats]:
    """(N, 2), all finite."""
    if value is None:
        return None
    array = points_of(value, argument)
    if array.shape != (count, 2):
        raise refuse(argument, f'shape {array.shape}, must be ({count}, 2): one row for each point')
    if not np.isfinite(array).all():
        raise refuse(argument, 'they are not all finite')
    return array


def positive_of(argument: str, value: Any, count: int) -> Optional[Floats]:
    """(N,), all of them more than 0."""
    if value is None:
        return None
    array = numbers(argument, value)
    if array.shape != (count,):
        raise refuse(argument, f'shape {array.shape}, must be ({count},): one for each point')
    if not (np.isfinite(array) & (array > 0)).all():
        raise refuse(argument, 'they are not all more than 0')
    return array


def pair_of(argument: str, value: Any) -> Tuple[float, float]:
    """(x, y)."""
    array = numbers(argument, value)
    if array.shape != (2,):
        raise refuse(argument, f'shape {array.shape}, must be 2 numbers: x, y')
    return float(array[0]), float(array[1])


def surface_of(value: Optional[str]) -> bool:
    """Whether it is free."""
    if value not in (None, 'free'):
        raise refuse('surface', f'{value!r} is neither "free" nor None')
    return value == 'free'


def mask_of(disable: Sequence[str], limit: Optional[Mapping[str, int]]) -> Mask:
    if isinstance(disable, str) or not hasattr(disable, '__iter__'):
        raise refuse('disable', f'{disable!r} is no list of names')
    if limit is not None and not isinstance(limit, Mapping):
        raise refuse('limit', f'{limit!r} is no mapping from names to numbers')
    for name in disable:
        if name not in _vorpipe.feature_names():
            raise refuse('disable', f'{name!r} is none of {", ".join(_vorpipe.feature_names())}')
    for name in limit or {}:
        if name not in _vorpipe.limit_names():
            raise refuse('limit', f'{name!r} is none of {", ".join(_vorpipe.limit_names())}')
    return list(disable), [(name, whole_of('limit', most, 0, 2**64 - 1)) for name, most in (limit or {}).items()]


def outline_of(value: Any, layer: Optional[str] = None) -> Outline:
    """A path, what has a __geo_interface__, or coordinates nested like those of GeoJSON."""
    if isinstance(value, (str, os.PathLike)):
        return _vorpipe.read_outline(path_of(value, 'domain'), text_or_none('domain_layer', layer) or '')
    polygons = _polygons(getattr(value, '__geo_interface__', value))
    rings = [_ring(ring) for polygon in polygons for ring in polygon]
    if not rings:
        raise refuse('domain', 'it has no ring')
    ring_offsets = np.cumsum([0] + [len(ring) for ring in rings], dtype=np.uint64)
    polygon_offsets = np.cumsum([0] + [len(polygon) for polygon in polygons], dtype=np.uint64)
    return np.concatenate(rings), ring_offsets, polygon_offsets, b'', system_of(getattr(value, 'crs', None))


def _polygons(value: Any) -> List[Any]:
    """Polygons, each a list of rings."""
    if isinstance(value, Mapping):
        return _polygons_of_geojson(value)
    if isinstance(value, (list, tuple)) and value and hasattr(value[0], '__geo_interface__'):
        return [polygon for part in value for polygon in _polygons(part.__geo_interface__)]
    depth, inside = 0, value
    # Deeper than polygons go, which a list that holds itself is too.
    while depth < 5 and not isinstance(inside, np.ndarray) and hasattr(inside, '__len__') and len(inside) > 0:
        depth, inside = depth + 1, inside[0]
    depth += inside.ndim if isinstance(inside, np.ndarray) else 0
    if depth == 2:
        return [[value]]
    if depth == 3:
        return [value]
    if depth == 4:
        return list(value)
    raise refuse('domain', 'neither a ring of shape (M, 2), nor a list of rings (a polygon, then its holes), nor a '
                            'list of such polygons')


def _polygons_of_geojson(value: Optional[Mapping[str, Any]]) -> List[Any]:
    # A feature may have no geometry.
    if value is None:
        return []
    kind = value.get('type')
    if kind == 'Polygon':
        return [value['coordinates']]
    if kind == 'MultiPolygon':
        return list(value['coordinates'])
    if kind == 'Feature':
        return _polygons_of_geojson(value['geometry'])
    if kind == 'FeatureCollection':
        return [polygon for feature in value['features'] for polygon in _polygons_of_geojson(feature)]
    if kind == 'GeometryCollection':
        return [polygon for part in value['geometries'] for polygon in _polygons_of_geojson(part)]
    raise refuse('domain', f'a {kind} is no polygon')


def _ring(value: Any) -> Floats:
    """Without the first point repeated at its end, and without heights."""
    array = numbers('domain', value)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise refuse('domain', f'a ring of shape {array.shape}, must be (M, 2)')
    array = array[:, :2]
    if len(array) > 1 and np.array_equal(array[0], array[-1]):
        array = array[:-1]
    return np.ascontiguousarray(array)
