"""Cells for pandas, shapely and GeoPandas, which are imported here alone."""
from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, Callable, Dict, List

import numpy as np

from . import _vorpipe
from ._points import Given, given
from ._scalars import flag_of, refuse
from ._warnings import InputWarning, warn

if TYPE_CHECKING:
    import geopandas
    import pandas

    from ._diagram import Diagram


def shapely_polygons(diagram: Diagram) -> List[Any]:
    from shapely.geometry import Polygon

    cells = diagram._cells
    if cells.input.center is not None or diagram.globe:
        # On the globe edges are great circles, and 180 degrees cuts cells. A cell around a pole is a polygon of longitude and latitude by way of the pole.
        return [_shape([Polygon(outer, holes) for outer, *holes in _vorpipe.polygons_of(cells, i)])
                for i in range(len(cells))]
    if not len(diagram.ring_starts):
        return [Polygon(ring) if len(ring) else Polygon() for ring in diagram.polygons()]
    shapes = []
    for cell in diagram:
        shapes.append(_shape([Polygon(outer, holes) for outer, holes in cell.polygons()]))
    return shapes


def _shape(parts: List[Any]) -> Any:
    from shapely.geometry import MultiPolygon, Polygon

    return MultiPolygon(parts) if len(parts) > 1 else parts[0] if parts else Polygon()


def columns_of(diagram: Diagram) -> Dict[str, Any]:
    """By the names that files have them by."""
    x, y = diagram.sites.T
    columns: Dict[str, Any] = {'x': x, 'y': y}
    if diagram.weights is not None:
        columns['weight'] = diagram.weights.copy()
    columns['status'] = np.array(['ok', 'empty', 'duplicate'])[diagram.status]
    columns['owner'] = diagram.owners.astype(np.int64)
    columns['area'] = diagram.areas.copy()
    if diagram.detail != 'measures':
        columns['perimeter'] = diagram.perimeters.copy()
    columns['centroid_x'], columns['centroid_y'] = diagram.centroids.T.copy()
    columns['vertices'] = np.diff(diagram.cell_offsets)
    if len(diagram.mass):
        columns['mass'] = diagram.mass.copy()
        columns['mass_centroid_x'], columns['mass_centroid_y'] = diagram.mass_centroids.T.copy()
    known = diagram._cells.input.attributes
    if known is not None:
        columns.update(zip(known.names_in_files, (values.copy() for values in diagram.attributes.values())))
    return columns


def data_frame(diagram: Diagram) -> pandas.DataFrame:
    from pandas import DataFrame

    return DataFrame(columns_of(diagram), index=diagram.index)


def geo_data_frame(diagram: Diagram, crs: Any) -> geopandas.GeoDataFrame:
    from geopandas import GeoDataFrame

    return GeoDataFrame(columns_of(diagram), geometry=diagram.to_shapely(), index=diagram.index,
                        crs=diagram.crs if crs is None else crs)


def lines_of(diagram: Diagram) -> List[Any]:
    """Each edge once."""
    from shapely.geometry import LineString

    shared = diagram.topology()
    return [LineString(ends) for ends in shared.vertices[shared.edge_vertices]]


def extended_box(points: Given, extend_to: Any) -> Any:
    """The box of the points, grown as without a domain, and of what has `total_bounds` or `bounds`."""
    bounds = getattr(extend_to, 'total_bounds', getattr(extend_to, 'bounds', extend_to))
    try:
        xmin, ymin, xmax, ymax = (float(side) for side in bounds)
    except (TypeError, ValueError):
        raise refuse('extend_to', f'a {type(extend_to).__name__} is neither a geometry nor a box') from None
    places = points.places
    low, high = places.min(axis=0), places.max(axis=0)
    grown = 0.05 * max(high - low)
    low, high = low - grown, high + grown
    return min(xmin, low[0]), min(ymin, low[1]), max(xmax, high[0]), max(ymax, high[1])


def with_cells(points: Any, diagram: Diagram, only_edges: bool) -> Any:
    """The frame or series of points with cells in their place, or a series of edges."""
    from geopandas import GeoSeries

    if flag_of('only_edges', only_edges):
        return GeoSeries(lines_of(diagram), crs=diagram.crs)
    rows = given(points).rows
    frame = points if rows is None else points.take(rows)
    cells = GeoSeries(diagram.to_shapely(), index=frame.index, crs=diagram.crs, name=frame.geometry.name)
    if not hasattr(frame, 'columns'):
        return cells
    frame = frame.copy()
    frame[cells.name] = cells.values
    return frame


def with_pieces(points: Any, domain: Any, by: str, options: Dict[str, Any]) -> geopandas.GeoDataFrame:
    """A row for each feature of the domain and each point whose cell meets it, as piecesOf in C++ finds them."""
    from geopandas import GeoDataFrame, read_file
    from pandas import concat

    from ._functions import cells
    layer, weights = options.pop('domain_layer', None), options.pop('weights', None)
    if isinstance(domain, (str, os.PathLike)):
        domain = read_file(domain, layer=layer)
    if by not in getattr(domain, 'columns', ()):
        known = f', which has {", ".join(map(repr, domain.columns))}' if hasattr(domain, 'columns') else ''
        raise refuse('by', f'{by!r} is no column of the domain{known}')
    frame = points if given(points).rows is None else points.explode(index_parts=False)
    frame = frame if hasattr(frame, 'columns') else GeoDataFrame(geometry=frame)
    frame = frame.rename(columns={name: f'site_{name}' for name in (by, 'share') if name in frame.columns})
    weights = None if weights is None else np.asarray(weights)
    # The plane of a projection is around the middle of all.
    every = domain.geometry if options.get('project') else domain.total_bounds
    with warnings.catch_warnings():
        # Of a feature they say what it is: without a point of its own, or of several polygons.
        warnings.filterwarnings('ignore', 'domain: (no site lies|.* dissolved)', InputWarning)
        whole = cells(frame, weights, every, detail='polygons', **options)
        if whole.center is not None:
            options = {**options, 'project': whole.center}
        has = np.flatnonzero(np.diff(whole.cell_offsets))
        starts = whole.cell_offsets[has]
        low, high = np.minimum.reduceat(whole.cell_vertices, starts), np.maximum.reduceat(whole.cell_vertices, starts)
        pieces = []
        for name, part in domain.groupby(by, sort=False, dropna=False):
            box = part.total_bounds
            # Edges that are straight in the plane of a projection may reach beyond their ends.
            near = has[((low <= box[2:]) & (high >= box[:2])).all(axis=1) | (whole.center is not None)]
            some = frame.iloc[near]
            own = None if weights is None else weights[near]
            diagram = cells(some, own, part.geometry, detail='polygons', **options)
            rows = with_cells(some, diagram, False)
            rows.insert(0, by, name)
            rows.insert(1, 'share', diagram.areas / diagram.area_sum())
            pieces.append(rows[diagram.areas > 0])
    return concat(pieces)


def each_row(points: Any, made: Callable[[Any, Dict[str, Any]], Any], options: Dict[str, Any], only_edges: bool) -> Any:
    """What is made of the rows that have a geometry, amid the others, which stay without one."""
    from geopandas import GeoSeries
    from pandas import concat

    lacks = np.asarray(points.geometry.isna() | points.geometry.is_empty, dtype=bool)
    if not lacks.any() and len(points):
        return made(points, options)
    warn([f'points: {lacks.sum()} of {len(points)} rows have no geometry, and get none'] if len(points) else [])
    bare = points[lacks].copy()
    if hasattr(bare, 'columns'):
        bare[bare.geometry.name] = GeoSeries([None] * len(bare), index=bare.index, crs=points.crs)
    else:
        bare[:] = None
    if lacks.all():
        return GeoSeries([], crs=points.crs) if flag_of('only_edges', only_edges) else bare
    if options.get('weights') is not None:
        options = {**options, 'weights': np.asarray(options['weights'])[~lacks]}
    kept = points[~lacks]
    found = made(kept, options)
    if only_edges:
        return found
    rows = given(kept).rows
    own = np.flatnonzero(~lacks) if rows is None else np.flatnonzero(~lacks)[rows]
    order = np.argsort(np.concatenate((own, np.flatnonzero(lacks))), kind='stable')
    return concat((found, bare)).iloc[order]
