"""What cells have to do with each other as sparse matrices of scipy's, which is imported here alone."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Tuple

import numpy as np

from . import _arguments, _tables, _vorpipe
from ._arguments import Floats
from ._scalars import flag_of, refuse

if TYPE_CHECKING:
    from ._diagram import Diagram


def adjacency(diagram: Diagram, lengths: bool) -> Any:
    if not flag_of('lengths', lengths):
        pairs = diagram.neighbor_pairs()
        both = np.concatenate((pairs, pairs[pairs[:, 0] != pairs[:, 1], ::-1]))
        return _square(diagram, np.ones(len(both), dtype=np.int64), both[:, 0], both[:, 1])
    own, other, chosen = _inner_edges(diagram)
    return _square(diagram, diagram.edge_lengths[chosen], own, other)


def area_jacobian(diagram: Diagram, by: str) -> Any:
    from scipy.sparse import csr_array

    if by not in ('weights', 'points'):
        raise refuse('by', f'{by!r} is neither "weights" nor "points"')
    if diagram._cells.input.free_surface:
        raise refuse('surface', 'where air is around the cells, arcs move with the weights too; cells that fill a '
                                'domain have these derivatives')
    own, other, chosen = _inner_edges(diagram)
    lengths, places = diagram.edge_lengths[chosen], diagram._cells.input.points_in_plane
    beyond = places[other]
    if len(diagram.neighbor_shifts):
        xmin, ymin, xmax, ymax = diagram.domain
        beyond = beyond + diagram.neighbor_shifts[chosen] * (xmax - xmin, ymax - ymin)
    apart = np.hypot(*(beyond - places[own]).T)
    if by == 'weights':
        moved = lengths / (2 * apart)
        return _square(diagram, np.concatenate((moved, -moved)), np.concatenate((own, own)),
                       np.concatenate((own, other)))
    middle, per_length = _middles(diagram)[chosen], (lengths / apart)[:, None]
    moved = np.concatenate((per_length * (middle - places[own]), per_length * (beyond - middle)))
    rows, sites, count = np.concatenate((own, own)), np.concatenate((own, other)), len(diagram)
    columns = np.column_stack((2 * sites, 2 * sites + 1))
    return csr_array((moved.ravel(), (np.repeat(rows, 2), columns.ravel())), shape=(count, 2 * count))


def natural_neighbors(diagram: Diagram, places: Any, threads: Optional[int]) -> Any:
    from scipy.sparse import csr_array

    wanted = np.ascontiguousarray(_tables.places_of(places, diagram._cells.input.system).reshape(-1, 2))
    offsets, sites, weights = _vorpipe.natural_neighbors(diagram._cells, wanted, _arguments.threads_of(threads))
    return csr_array((weights, sites, offsets), shape=(len(wanted), len(diagram)))


def interpolated(diagram: Diagram, values: Any, places: Any, threads: Optional[int]) -> Floats:
    if isinstance(values, str):
        # Pictures take "@name".
        name = values if values in diagram.attributes else values.removeprefix('@')
        if name not in diagram.attributes:
            raise refuse('values', f'there is no attribute {name!r}; there are '
                                   f'{", ".join(diagram.attributes) or "none"}')
        values = diagram.attributes[name]
    given = _arguments.numbers('values', values)
    if not given.ndim or len(given) != len(diagram):
        raise refuse('values', f'shape {given.shape}, must be ({len(diagram)},) or ({len(diagram)}, K): for each point')
    weights = natural_neighbors(diagram, places, threads)
    # At a point the others count nothing, whatever they are; where nothing counts, there is no value.
    found: Floats = np.asarray(weights @ given, dtype=np.float64)
    found[np.diff(weights.indptr) == 0] = np.nan
    return found


def _square(diagram: Diagram, values: Any, rows: Any, columns: Any) -> Any:
    from scipy.sparse import csr_array

    return csr_array((values, (rows, columns)), shape=(len(diagram), len(diagram)))


def _inner_edges(diagram: Diagram) -> Tuple[Any, Any, Any]:
    """Of edges between two cells: whose they are, the cell beyond, and their places among all."""
    chosen = np.flatnonzero(diagram.neighbors >= 0)
    own = np.repeat(np.arange(len(diagram)), np.diff(diagram.cell_offsets))
    return own[chosen], diagram.neighbors[chosen], chosen


def _middles(diagram: Diagram) -> Floats:
    """Of all edges, in the plane of the cells."""
    corners = diagram._cells.vertices_in_plane
    begins = diagram.ring_starts if len(diagram.ring_starts) else np.unique(diagram.cell_offsets[:-1])
    begins = begins[begins < len(corners)]
    following = np.arange(1, len(corners) + 1)
    following[np.append(begins[1:], len(corners)) - 1] = begins
    middles: Floats = (corners + corners[following]) / 2
    return middles
