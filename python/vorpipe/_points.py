"""Points that come with what is said of them."""
from __future__ import annotations

import math
import os
from typing import Any, Dict, Iterable, List, Literal, Mapping, NamedTuple, Optional, Sequence, Union, overload

import numpy.typing as npt

from . import _attributes, _crs, _tables, _vorpipe
from ._arguments import Floats, PathLike, box_of, points_of
from ._kept import Kept
from ._scalars import path_of, refuse, seed_of, text_of, text_or_none, whole_of
from ._space import SpaceSites, read_in_space
from ._warnings import warn


class Sites(Kept):
    """Points with all that their file says of them; made by `read`.

    `cells`, `render` and the other functions take it in place of points. Its weights, attributes and coordinate
    reference system go along.
    """

    __slots__ = ('_table', '_attributes')
    _made_of = ('_table',)

    def __init__(self, table: _vorpipe.Table) -> None:
        self._table = table
        self._attributes: Optional[Dict[str, npt.NDArray[Any]]] = None

    def __len__(self) -> int:
        return len(self._table)

    def __repr__(self) -> str:
        names = ', '.join(self._table.attributes.names)
        return f'<vorpipe.Sites: {len(self)} points of {self._table.name}{": " if names else ""}{names}>'

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> npt.NDArray[Any]:
        """The points, for what knows arrays alone."""
        return self.points if dtype is None else self.points.astype(dtype)

    @property
    def points(self) -> Floats:
        """(N, 2). A copy with each call."""
        return self._table.points

    @property
    def weights(self) -> Optional[Floats]:
        """(N,); None where there are none."""
        return self._table.weights

    @property
    def attributes(self) -> Mapping[str, npt.NDArray[Any]]:
        """By their names, (N,) each.

        Of int64, bool, or float64 with NaN where a value is missing. Texts, lists, and integers and booleans some of
        which are missing are arrays of objects, with None for what is missing.
        """
        if self._attributes is None:
            self._attributes = _attributes.arrays_of(self._table.attributes)
        return self._attributes

    @property
    def crs(self) -> Optional[str]:
        """The coordinate reference system, as "EPSG:4326"; None where the file does not say which."""
        return _crs.name_of(self._table.system)

    @property
    def skipped(self) -> int:
        """How many rows `missing="skip"` left out."""
        return self._table.skipped

    @property
    def notes(self) -> List[str]:
        """What was reinterpreted or ignored, a line each; `read` has warned of them."""
        return self._table.notes


@overload
def read(path: PathLike, *, columns: Union[None, str, Sequence[Union[str, int]]] = None, format: Optional[str] = None,
         missing: Optional[str] = None, layer: Optional[str] = None, seed: int = 1, dim: Literal[None, 2] = None
         ) -> Sites: ...


@overload
def read(path: PathLike, *, columns: Union[None, str, Sequence[Union[str, int]]] = None, format: Optional[str] = None,
         missing: Optional[str] = None, layer: None = None, seed: int = 1, dim: Literal[3]) -> SpaceSites: ...


def read(path: PathLike, *, columns: Union[None, str, Sequence[Union[str, int]]] = None, format: Optional[str] = None,
         missing: Optional[str] = None, layer: Optional[str] = None, seed: int = 1,
         dim: Optional[int] = None) -> Union[Sites, SpaceSites]:
    """The points of a file, with their weights, attributes and coordinate reference system.

    Args:
        path: .csv, .tsv, .geojson, .geojsonl, .gpkg, .wkt, .xyz, .txt or .npy, most of them with .gz as well; in space
            .extxyz, .dump, .lammpstrj, .data, .lmp or .voro; "-" for standard input; or a generator, as "random:1000".
        columns: names, in any case, or numbers from 1, of the columns of x and y, or x, y and weight; or the name of
            a column of WKT. None for what the header says.
        format: the kind of file, as "csv", where the path's extension does not say it.
        missing: "skip" leaves out rows without a place, or with an empty weight; else they are an error.
        layer: of a GeoPackage with several.
        seed: of a generator.
        dim: 3 for points in space, `SpaceSites`: x, y and z of .csv, .tsv, .npy, .xyz or .txt. Extended xyz, files of
            LAMMPS and of Voro++ have those alone.

    Raises:
        InputError: with the file, line and column of what is wrong.

    Warns:
        InputWarning: what was reinterpreted or ignored.
    """
    if dimension_of(dim, 3 if _vorpipe.is_of_space(path_of(path)) else 2) == 3:
        if layer is not None:
            raise refuse('layer', 'points in space are read from tables')
        names, kind = _names_of(columns, missing), (text_or_none('format', format) or '').lstrip('.')
        in_space = read_in_space(path, names, kind, missing == 'skip', seed)
        warn(in_space.notes)
        return in_space
    return Sites(_table_of(path, columns, format, missing, layer, seed, True))


def dimension_of(dim: Optional[int], usual: int) -> int:
    if dim not in (None, 2, 3):
        raise refuse('dim', f'{dim!r} is neither 2 nor 3')
    if dim == 2 and usual == 3:
        raise refuse('dim', 'is 3 for a pattern or a domain in space')
    return dim or usual


def _names_of(columns: Union[None, str, Sequence[Union[str, int]]], missing: Optional[str]) -> List[str]:
    if missing not in (None, 'skip'):
        raise refuse('missing', f'{missing!r} is neither None nor "skip"')
    given = [columns] if isinstance(columns, (str, int)) else columns or ()
    if not isinstance(given, Iterable):
        raise refuse('columns', f'{columns!r} is neither a name nor a list of them')
    return [text_of('columns', str(column)) for column in given]


def _table_of(path: PathLike, columns: Union[None, str, Sequence[Union[str, int]]], format: Optional[str],
              missing: Optional[str], layer: Optional[str], seed: int, attributes: bool) -> _vorpipe.Table:
    names = _names_of(columns, missing)
    kind = (text_or_none('format', format) or '').lstrip('.')
    table = _vorpipe.read_table(path_of(path), seed_of(seed), kind, names, text_or_none('layer', layer) or '',
                                missing == 'skip', attributes)
    warn(table.notes)
    return table


def read_points(path: PathLike) -> _vorpipe.Table:
    """Without attributes."""
    return _table_of(path, None, None, None, None, 1, False)


def generated(pattern: str, count: int, seed: int, box: Optional[Sequence[float]]) -> Floats:
    named = path_of(f'{pattern}:{whole_of("n", count)}', 'pattern')
    table = _vorpipe.read_table(named, seed_of(seed), '', [], '', False, False)
    if not table.generated:
        raise refuse('pattern', f'{pattern!r} is no generator')
    into = box_of(box)
    if into is None:
        return table.points
    width, height = into[2] - into[0], into[3] - into[1]
    if not (0 < width < math.inf and 0 < height < math.inf):
        raise refuse('domain', f'{into} is not a rectangle: xmin, ymin, xmax, ymax')
    return table.points_in(into)


class Given(NamedTuple):
    """What any function takes for points."""

    taken: Union[Floats, _vorpipe.Table]  #: an array, or all that is said of them
    index: Any = None  #: of pandas', by point; None where there is none
    rows: Any = None  #: of each point in what was given, where rows have several

    @property
    def places(self) -> Floats:
        return self.taken.points if isinstance(self.taken, _vorpipe.Table) else self.taken


def given(points: Any) -> Given:
    if isinstance(points, Given):
        return points
    if isinstance(points, Sites):
        return Given(points._table)
    if isinstance(points, (str, os.PathLike)):
        return Given(read(points)._table)
    found = _tables.table_of(points)
    if found is None:
        return Given(points_of(points))
    warn(found.table.notes)
    index: Any = getattr(points, 'index', None)
    if not hasattr(index, 'take'):
        return Given(found.table)
    return Given(found.table, index if found.rows is None else index.take(found.rows), found.rows)
