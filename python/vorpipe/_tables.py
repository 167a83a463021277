"""Points of other programs: tables that name their columns, as DataFrames, and geometries."""
from __future__ import annotations

from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _arguments, _attributes, _crs, _vorpipe
from ._errors import InputError
from ._scalars import refuse
from ._warnings import warn

Columns = Mapping[Any, Any]


class Read(NamedTuple):
    """What was found in a table."""

    table: _vorpipe.Table
    rows: Optional[npt.NDArray[np.int64]]  #: of each point, where rows have several


def table_of(points: Any) -> Optional[Read]:
    """Of a table by names, of geometries and of GeoJSON; None of anything else, which may be an array."""
    if isinstance(points, Mapping) and isinstance(points.get('type'), str):
        return _table_of_geojson(points)
    columns = _columns_of(points)
    if columns is not None:
        geometry = getattr(points, 'geometry', None)
        return _table_of_frame(geometry, columns) if hasattr(geometry, 'geom_type') else _table_of_columns(columns)
    if hasattr(points, 'geom_type') and hasattr(points, 'crs'):
        return _table_of_geometries(points, {}, _crs.system_of(points.crs))
    if hasattr(points, '__geo_interface__'):
        return _table_of_geojson(points.__geo_interface__)
    return _table_of_geometries(points, {}) if _are_geometries(points) else None


def places_of(value: Any, system: _crs.System) -> _arguments.Floats:
    """(P, 2) of an array, of geometries, or of a table by names; (2,) of one place. `system` is that of the diagram."""
    is_one = isinstance(getattr(value, 'geom_type', None), str) and value.geom_type == 'Point'
    try:
        read = table_of([value] if is_one else value)
    except InputError as error:
        raise refuse('places', str(error).partition(': ')[2]) from None
    if read is not None:
        table = read.table
        names = _vorpipe.differing_systems(table.system, system)
        if names is not None:
            raise refuse('places', f'they are in {names[0]}, the diagram in {names[1]}; take them to its system')
        warn(table.notes)
        return table.points[0] if is_one else table.points
    array = _arguments.array_of('places', value)
    return _arguments.numbers('places', array) if array.shape == (2,) else _arguments.points_of(array, 'places')


def _columns_of(value: Any) -> Optional[Columns]:
    """By name; None of what has no named columns."""
    if isinstance(value, Mapping):
        return value
    if isinstance(value, np.ndarray):
        return None if value.dtype.names is None else {name: value[name] for name in value.dtype.names}
    names = getattr(value, 'column_names', None)  # of Arrow's tables
    if names is None and hasattr(value, '__getitem__'):
        names = getattr(value, 'columns', None)
    if names is None:
        return None
    names = list(names)
    for name in names:
        if names.count(name) > 1:
            raise refuse('points', f'two columns are called {str(name)!r}')
    return {name: value[name] for name in names}


def _table_of_columns(columns: Columns) -> Read:
    """x, y and the weight by their names, as files have them; all others are attributes."""
    names = list(columns)
    found = _vorpipe.columns_named([_attributes.printable(str(name)) for name in names])
    if found is None:
        return _table_by_place(columns)
    x, y, geometry, weight, are_radii, kind, note = found
    others = {name: columns[name] for k, name in enumerate(names) if k not in (x, y, geometry, weight)}
    notes = [f'points: {note}'] if note else []
    weights = None if weight is None else _numbers(columns[names[weight]])
    if geometry is not None:
        return _table_of_geometries(_geometry_column(names[geometry], columns[names[geometry]]), others, None,
                                    weights, are_radii, notes)
    assert x is not None and y is not None
    places = _pairs(columns[names[x]], columns[names[y]])
    system = None if kind == 'unknown' else (kind, '', 0, '')
    return _table(places, others, system, weights, are_radii, notes)


def _table_by_place(columns: Columns) -> Read:
    """Two columns whose names say nothing are x and y; numbers for names, as arrays have, are not worth a warning."""
    names = list(columns)
    if len(names) != 2:
        listed = ', '.join(repr(str(name)) for name in names[:5]) + (' ...' if len(names) > 5 else '')
        raise refuse('points', f'of the columns {listed} none is called x or y, lon or lat, or by another usual name; '
                               'give an array of the two that are meant')
    x, y = names
    told = isinstance(x, str) or isinstance(y, str)
    notes = [f'points: {str(x)!r}, {str(y)!r} are taken as x, y'] if told else []
    return _table(_pairs(columns[x], columns[y]), {}, None, None, False, notes)


def _table_of_frame(geometry: Any, columns: Columns) -> Read:
    """Of a GeoDataFrame: its geometries, and weights by the names that files of features have."""
    others = {name: column for name, column in columns.items() if name != getattr(geometry, 'name', 'geometry')}
    return _table_of_geometries(geometry, others, _crs.system_of(getattr(geometry, 'crs', None)))


def _table_of_geojson(shape: Mapping[str, Any]) -> Read:
    """Properties are attributes."""
    features = shape['features'] if shape['type'] == 'FeatureCollection' else [shape]
    if shape['type'] not in ('FeatureCollection', 'Feature'):
        return _table_of_geometries(features, {})
    given = [feature.get('properties') or {} for feature in features]
    names = dict.fromkeys(name for properties in given for name in properties)
    columns = {name: [properties.get(name) for properties in given] for name in names}
    return _table_of_geometries([feature['geometry'] for feature in features], columns)


def _table_of_geometries(geometries: Any, columns: Columns, system: Optional[_crs.System] = None, weights: Any = None,
                         are_radii: bool = False, notes: Sequence[str] = ()) -> Read:
    """A MultiPoint is as many points, each with the values of its row."""
    places, counts = _places_of(geometries)
    others = dict(columns)
    if weights is None:
        for name in [name for name in columns if str(name).lower() in ('weight', 'radius')]:
            if weights is not None:
                raise refuse('points', 'it has both weights and radii; keep one')
            weights, are_radii = _numbers(others.pop(name)), str(name).lower() == 'radius'
            if name not in ('weight', 'radius'):
                notes = [*notes, f'points: {name!r} is taken as {str(name).lower()}']
    rows = None
    if any(count != 1 for count in counts):
        rows = np.repeat(np.arange(len(counts)), counts)
        others = {name: _repeated(values, rows) for name, values in others.items()}
        weights = None if weights is None else weights[rows]
    return _table(places, others, system, weights, are_radii, notes, rows)


def _table(places: _arguments.Floats, columns: Columns, system: Optional[_crs.System], weights: Any, are_radii: bool,
           notes: Sequence[str], rows: Optional[npt.NDArray[np.int64]] = None) -> Read:
    attributes = _attributes.attributes_of(columns, len(places)) or _vorpipe.Attributes()
    return Read(_vorpipe.Table(places, _arguments.weights_of(weights, len(places)), are_radii, attributes, system,
                               list(notes)), rows)


def _repeated(values: Any, rows: Any) -> Any:
    if hasattr(values, 'iloc'):
        return values.iloc[rows]
    return values[rows] if isinstance(values, np.ndarray) else [values[row] for row in rows]


def _pairs(x: Any, y: Any) -> _arguments.Floats:
    """(N, 2) of two columns."""
    pair = _numbers(x), _numbers(y)
    if pair[0].ndim != 1 or pair[0].shape != pair[1].shape:
        raise refuse('points', f'columns of the shapes {pair[0].shape} and {pair[1].shape}, must be (N,) each')
    return np.column_stack(pair)


def _numbers(column: Any) -> _arguments.Floats:
    """A column; NaN for what is missing in one of objects."""
    array = _arguments.array_of('points', column)
    if array.dtype.kind == 'O':
        array = _attributes.objects([np.nan if _attributes.is_missing(value) else value for value in array])
    return _arguments.numbers('points', array)


def _geometry_column(name: Any, column: Any) -> Any:
    if not _are_geometries(list(column)):
        raise refuse('points', f'the column {str(name)!r} holds no geometries; text in WKT is read from files')
    return column


def _are_geometries(value: Any) -> bool:
    """By the first of a list that is not None."""
    is_list = isinstance(value, (list, tuple)) or isinstance(value, np.ndarray) and value.dtype.kind == 'O'
    return is_list and _is_geometry(next((item for item in value if item is not None), None))


def _is_geometry(value: Any) -> bool:
    return hasattr(value, '__geo_interface__') or isinstance(value, Mapping) and 'coordinates' in value


def _places_of(geometries: Any) -> Tuple[_arguments.Floats, List[int]]:
    """(N, 2), and how many of them each geometry has."""
    if hasattr(geometries, 'geom_type') and hasattr(geometries, 'is_empty'):
        if (np.asarray(geometries.geom_type) == 'Point').all() and not np.asarray(geometries.is_empty).any():
            places = np.column_stack((np.asarray(geometries.x), np.asarray(geometries.y)))
            return places, [1] * len(places)
    found_places: List[Tuple[float, float]] = []
    counts: List[int] = []
    labels = getattr(geometries, 'index', None)
    for row, geometry in enumerate(geometries):
        label = row if labels is None or not hasattr(labels, 'take') else labels[row]
        found = [] if _attributes.is_missing(geometry) else _points_in(geometry, label)
        if not found:
            raise refuse('points', f'geometry {label!r} has no place; leave such rows out')
        found_places += found
        counts.append(len(found))
    return np.array(found_places, dtype=np.float64).reshape(-1, 2), counts


def _points_in(geometry: Any, label: Any) -> List[Tuple[float, float]]:
    """Points and MultiPoints; x and y of each."""
    if getattr(geometry, 'is_empty', False):
        return []
    if getattr(geometry, 'geom_type', '') == 'Point':
        return [(geometry.x, geometry.y)]
    shape = geometry if isinstance(geometry, Mapping) else geometry.__geo_interface__
    kind = shape['type']
    if kind == 'Feature':
        return _points_in(shape['geometry'], label)
    if kind == 'GeometryCollection':
        return [point for part in shape['geometries'] for point in _points_in(part, label)]
    if kind not in ('Point', 'MultiPoint'):
        raise refuse('points', f'geometry {label!r} is a {kind}; its centroid is a point')
    places = shape['coordinates'] if kind == 'MultiPoint' else [shape['coordinates']]
    return [(place[0], place[1]) for place in places if len(place) > 1]
