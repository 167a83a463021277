"""Cells for shapely and GeoPandas, which are imported here alone."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List

import numpy as np

from . import _vorpipe

if TYPE_CHECKING:
    import geopandas

    from ._diagram import Diagram


def shapely_polygons(diagram: Diagram) -> List[Any]:
    from shapely.geometry import Polygon

    cells = diagram._cells
    if cells.input.center is not None:
        # A cell around a pole is a polygon of longitude and latitude by way of the pole.
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


def geo_data_frame(diagram: Diagram, crs: Any) -> geopandas.GeoDataFrame:
    from geopandas import GeoDataFrame

    x, y = diagram.points.T
    columns: Dict[str, Any] = {'x': x, 'y': y}
    if diagram.weights is not None:
        columns['weight'] = diagram.weights.copy()
    columns['status'] = np.array(['ok', 'empty', 'duplicate'])[diagram.status]
    columns['owner'] = diagram.owner.astype(np.int64)
    columns['area'] = diagram.areas.copy()
    if len(diagram.mass):
        columns['mass'] = diagram.mass.copy()
    given = diagram._cells.input.attributes
    if given is not None:
        columns.update(zip(given.names_in_files, (values.copy() for values in diagram.attributes.values())))
    return GeoDataFrame(columns, geometry=diagram.to_shapely(), crs=diagram.crs if crs is None else crs)
