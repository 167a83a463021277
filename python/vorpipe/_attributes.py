"""What is said of points besides their places and weights: columns of values."""
from __future__ import annotations

import json
from typing import Any, Dict, List, Mapping, Optional

import numpy as np
import numpy.typing as npt

from . import _vorpipe
from ._arguments import listed
from ._scalars import refuse

Attributes = Mapping[str, npt.NDArray[Any]]

MOST, LEAST = 2**63 - 1, -2**63


def arrays_of(attributes: Optional[_vorpipe.Attributes]) -> Dict[str, npt.NDArray[Any]]:
    """Of int64, float64 with NaN for what is missing, or bool; else of objects, with None for what is missing."""
    if attributes is None:
        return {}
    return {name: _array_of(attributes, column) for column, name in enumerate(attributes.names)}


def attributes_of(given: Any, count: int, own: Optional[_vorpipe.Attributes] = None) -> Optional[_vorpipe.Attributes]:
    """Of a mapping from names to `count` values each, as a dict or a DataFrame; after those that points have."""
    if given is None:
        return own
    if not (hasattr(given, 'keys') and hasattr(given, '__getitem__')):
        raise refuse('attributes', f'a {type(given).__name__} is no mapping from names to values')
    columns = own.copy() if own is not None else _vorpipe.Attributes()
    for key in given.keys():
        name = str(key)
        if not name.isprintable() and name != printable(name):
            raise refuse('attributes', f'UTF-8 cannot say the name {name!r}')
        if '\0' in name:
            raise refuse('attributes', f'the name {name!r} has a zero byte, at which files would end it')
        if name in columns.names:
            raise refuse('attributes', f'there are two of the name {name!r}')
        _add(columns, name, given[key], count)
    return columns


def printable(name: str) -> str:
    """What UTF-8 can say of it."""
    return name.encode('utf-8', 'replace').decode()


def _array_of(attributes: _vorpipe.Attributes, column: int) -> npt.NDArray[Any]:
    values = attributes.values(column)
    if isinstance(values, list):
        if attributes.type(column) == 'json':
            values = [None if value is None else json.loads(value) for value in values]
        values = objects(values)
    values.setflags(write=False)
    return values


def objects(values: List[Any]) -> npt.NDArray[Any]:
    """An array of one axis, whatever the values are."""
    array = np.empty(len(values), dtype=object)
    for index, value in enumerate(values):
        array[index] = value
    return array


def _add(columns: _vorpipe.Attributes, name: str, given: Any, count: int) -> None:
    # Types of pandas' own become floats in newer versions, where something is missing.
    is_array = isinstance(getattr(given, 'dtype', None), np.dtype)
    values = np.asarray(given) if is_array else objects(list(given))
    if values.shape != (count,):
        raise refuse('attributes', f'{name!r} has the shape {values.shape}, must be ({count},): one for each point')
    kind = values.dtype.kind
    if kind == 'b':
        columns.add_booleans(name, values)
    elif kind == 'i' or (kind == 'u' and values.dtype.itemsize < 8):
        columns.add_integers(name, values.astype(np.int64))
    elif kind == 'f':
        columns.add_reals(name, values.astype(np.float64))
    elif kind in 'mM':
        missing = np.isnat(values)
        columns.add_texts(name, 'text', [None if gone else str(value) for gone, value in zip(missing, values)])
    else:
        _add_objects(columns, name, listed(values))


def _add_objects(columns: _vorpipe.Attributes, name: str, values: List[Any]) -> None:
    kept = [None if is_missing(value) else value for value in values]
    kinds = {_kind_of(value) for value in kept if value is not None}
    if kinds == {'boolean'}:
        texts, kind = [None if value is None else str(bool(value)).lower() for value in kept], 'boolean'
    elif kinds == {'integer'}:
        fits = all(value is None or LEAST <= value <= MOST for value in kept)
        texts, kind = [None if value is None else str(int(value)) for value in kept], 'integer' if fits else 'real'
    elif kinds and kinds <= {'integer', 'real'}:
        columns.add_reals(name, np.array([np.nan if value is None else value for value in kept], dtype=np.float64))
        return
    elif kinds <= {'text'}:
        texts, kind = [None if value is None else _text_of(value) for value in kept], 'text'
    else:
        texts, kind = [None if value is None else _json_of(name, value) for value in kept], 'json'
    try:
        columns.add_texts(name, kind, texts)
    except TypeError:
        raise refuse('attributes', f'{name!r} has a text that UTF-8 cannot say') from None


def is_missing(value: Any) -> bool:
    """None, NaN, and what pandas has for them."""
    return value is None or isinstance(value, float) and value != value or type(value).__name__ in ('NAType', 'NaTType')


def _kind_of(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return 'boolean'
    if isinstance(value, (int, np.integer)):
        return 'integer'
    if isinstance(value, (float, np.floating)):
        return 'real'
    return 'json' if isinstance(value, (dict, list, tuple)) else 'text'


def _text_of(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _json_of(name: str, value: Any) -> str:
    try:
        return json.dumps(value, ensure_ascii=False, allow_nan=False, default=str)
    except (TypeError, ValueError) as error:
        raise refuse('attributes', f'{name!r} has a value that JSON cannot say: {error}') from None
