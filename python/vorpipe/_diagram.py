"""Cells as data."""
from __future__ import annotations

import enum
import operator
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _arguments, _attributes, _crs, _scalars, _tables, _vorpipe
from ._arguments import Floats, PathLike
from ._cell import Cell
from ._names import formerly
from ._shown import MOST_EDGES, Shown, pixels_of_cells, smaller
from ._warnings import warn

if TYPE_CHECKING:
    import geopandas
    import pandas
    from matplotlib.axes import Axes
    from scipy.sparse import csr_array

Integers = npt.NDArray[np.int64]


class TriangleMesh(NamedTuple):
    """Cells as indexed triangles, with the types that a GPU takes."""

    vertices: npt.NDArray[np.float32]  #: (M, 2): those of the diagram, rounded; each belongs to one cell
    points: npt.NDArray[np.uint32]  #: (M,): the point of each vertex
    triangles: npt.NDArray[np.uint32]  #: (T, 3): indices of vertices, counter-clockwise, cell after cell


class Status(enum.IntEnum):
    """What became of a point."""

    OK = 0  #: it has a cell
    EMPTY = 1  #: no place in the domain is nearest to it; it lies outside, or others hide it
    DUPLICATE = 2  #: another point has the same position and owns the cell: the heaviest, then the first


class Wall(enum.IntEnum):
    """What a cell has for a neighbor where it ends at the domain."""

    XMIN = -1
    XMAX = -2
    YMIN = -3
    YMAX = -4
    OUTLINE = -5
    ZMIN = -6  #: in space
    ZMAX = -7


class Diagram(Shown):
    """The cells of N points, in their order and units; made by `cells`.

    Arrays are read-only, and show the memory of the diagram without a copy; each keeps it alive. `array.copy()` can
    be written to. They have the names of those in an .npz file. Cell i has the vertices `cell_offsets[i]` to
    `cell_offsets[i + 1] - 1`, counter-clockwise. Its edge k runs from its vertex k to the next and belongs to its
    neighbor k, so that `cell_offsets` serves `cell_vertices`, `neighbors` and `edge_lengths`. `diagram[i]` is one cell.
    It can be pickled, with all that it was made from.
    """

    __slots__ = ('_cells', '_index', '_locator', '_attributes')
    _made_of = ('_cells', '_index')

    def __init__(self, cells: _vorpipe.Cells, index: Any = None) -> None:
        self._cells = cells
        self._index = index
        self._locator: Optional[_vorpipe.Locator] = None
        self._attributes: Optional[Dict[str, npt.NDArray[Any]]] = None

    def __len__(self) -> int:
        return len(self._cells)

    def __getitem__(self, site: int) -> Cell:
        count = len(self)
        index = operator.index(site)
        if not -count <= index < count:
            raise IndexError(f'there is no cell {index}: the diagram has {count}')
        return Cell(self, index % count)

    def __iter__(self) -> Iterator[Cell]:
        return (Cell(self, site) for site in range(len(self)))

    def __repr__(self) -> str:
        report = self.report
        return f'<vorpipe.Diagram: {report.ok} cells of {len(self)} points, {report.backend}>'

    def _pixels(self) -> Optional[npt.NDArray[np.uint8]]:
        return None if self.globe else pixels_of_cells(self._cells.input)

    def _repr_svg_(self) -> Optional[str]:
        if len(self) > MOST_EDGES or self.detail == 'measures':
            return None
        return smaller(_vorpipe.bytes_of(self._cells, '.svg', False).decode())

    def _status_of(self, site: int) -> Status:
        return Status(int(self.status[site]))

    def _needs(self, detail: str, name: str) -> None:
        details = ('measures', 'polygons', 'all')
        if details.index(self.detail) < details.index(detail):
            raise _scalars.refuse('detail', f'{name} takes detail={detail!r}, the cells were computed with '
                                              f'{self.detail!r}')

    def _needs_plane(self, name: str) -> None:
        if self.globe:
            raise _scalars.refuse('globe', f'{name} is of cells in a plane')

    # What it is about

    @property
    def sites(self) -> Floats:
        """(N, 2): the points that were given. A copy with each call."""
        return self._cells.input.points

    @property
    def weights(self) -> Optional[Floats]:
        """(N,): their weights; None where there are none."""
        return self._cells.input.weights

    @property
    def domain(self) -> Tuple[float, float, float, float]:
        """(xmin, ymin, xmax, ymax); of a projection in kilometers of its plane."""
        xmin, ymin, xmax, ymax = self._cells.input.domain
        return xmin, ymin, xmax, ymax

    @property
    def attributes(self) -> Mapping[str, npt.NDArray[Any]]:
        """What came with the points, by name, (N,) each; as `Sites.attributes` has it."""
        if self._attributes is None:
            self._attributes = _attributes.arrays_of(self._cells.input.attributes)
        return self._attributes

    @property
    def index(self) -> Optional[pandas.Index]:
        """(N,): the labels of the points, where they came in a DataFrame, a GeoDataFrame or a GeoSeries; else None."""
        return self._index

    @property
    def crs(self) -> Optional[str]:
        """The coordinate reference system of all positions, as "EPSG:4326"; None where it is not known."""
        return _crs.name_of(self._cells.input.system)

    @property
    def center(self) -> Optional[Tuple[float, float]]:
        """(longitude, latitude) that the plane of `project` is around; None without one."""
        center = self._cells.input.center
        return None if center is None else (center[0], center[1])

    @property
    def periodic(self) -> str:
        """ "none", "x", "y" or "xy"."""
        return self._cells.input.periodic

    @property
    def globe(self) -> bool:
        """Whether cells are those on the globe."""
        return self._cells.input.globe

    @property
    def detail(self) -> str:
        """ "measures", "polygons" or "all": which arrays there are."""
        return self._cells.detail

    @property
    def report(self) -> _vorpipe.Report:
        """Backend, device, times, and what became of how many points."""
        return self._cells.report

    # By cell

    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """(N,): a `Status` each."""
        return self._cells.status

    @property
    def owners(self) -> npt.NDArray[np.int32]:
        """(N,): the point that owns the cell: itself unless it is a duplicate."""
        return self._cells.owner

    owner = formerly('owner', 'owners')

    @property
    def areas(self) -> Floats:
        """(N,): 0 where there is no cell."""
        return self._cells.areas

    @property
    def solid_angles(self) -> Floats:
        """(N,): of cells on the globe, steradians: 4 pi in all; (0,) in a plane."""
        return self._cells.solid_angles

    @property
    def perimeters(self) -> Floats:
        """(N,)."""
        self._needs('polygons', 'perimeters')
        return self._cells.perimeters

    @property
    def centroids(self) -> Floats:
        """(N, 2): the point itself where there is no cell."""
        return self._cells.centroids

    @property
    def second_moments(self) -> Floats:
        """(N, 3): about the centroid: the integrals of xx, xy and yy."""
        self._needs('polygons', 'second_moments')
        self._needs_plane('second_moments')
        return self._cells.second_moments

    @property
    def mass(self) -> Floats:
        """(N,): the integral of the density over the cell; (0,) without a density."""
        return self._cells.mass

    @property
    def mass_centroids(self) -> Floats:
        """(N, 2): the center of that mass; (0, 2) without a density."""
        return self._cells.mass_centroids

    # By edge

    @property
    def cell_offsets(self) -> Integers:
        """(N + 1,): where the vertices, neighbors and edges of each cell begin."""
        return self._cells.offsets

    @property
    def neighbor_offsets(self) -> Integers:
        """(N + 1,): the same."""
        return self._cells.offsets

    @property
    def cell_vertices(self) -> Floats:
        """(M, 2): counter-clockwise; holes of cells in an outline clockwise."""
        self._needs('polygons', 'cell_vertices')
        return self._cells.vertices

    @property
    def neighbors(self) -> Integers:
        """(M,): indices of points, or a `Wall`."""
        return self._cells.neighbors

    @property
    def edge_lengths(self) -> Floats:
        """(M,)."""
        self._needs('polygons', 'edge_lengths')
        return self._cells.edge_lengths

    @property
    def neighbor_shifts(self) -> npt.NDArray[np.int32]:
        """(M, 2): of a periodic domain, how many widths and heights of it the neighbor's image is off the neighbor.

        A point that was given outside of the domain stands in it for this, whole periods away, and so do its vertices
        and its centroid. (0, 2) of other domains.
        """
        return self._cells.neighbor_shifts

    @property
    def ring_starts(self) -> Integers:
        """Of a domain with an outline: where in `cell_vertices` each ring begins; else of length 0."""
        return self._cells.ring_starts

    @property
    def triangles(self) -> npt.NDArray[np.int32]:
        """(T, 3): the Delaunay triangles of all points, counter-clockwise; with weights the regular triangulation.

        None where all points lie on a line, or the domain is periodic.
        """
        self._needs('all', 'triangles')
        return self._cells.triangles

    def triangle_mesh(self) -> TriangleMesh:
        """The cells as a vertex buffer and an index buffer."""
        self._needs('polygons', 'triangle_mesh')
        self._needs_plane('triangle_mesh')
        return TriangleMesh(*self._cells.triangle_mesh())

    def area_sum(self) -> float:
        """The sum of the areas, without what adding up would round off: the domain's area, if all is well."""
        return self._cells.area_sum()

    def neighbor_pairs(self) -> Integers:
        """(P, 2): pairs of points whose cells share an edge, each once, the lower index first; in ascending order."""
        counts = np.diff(self.cell_offsets)
        own = np.repeat(np.arange(len(self)), counts)
        other = self.neighbors
        chosen = other >= own if self.periodic != 'none' else other > own
        pairs = np.column_stack((own[chosen], other[chosen]))
        return np.unique(pairs, axis=0) if self.periodic != 'none' or len(self.ring_starts) else _ascending(pairs)

    def rings(self) -> List[List[Floats]]:
        """The rings of each cell, (K, 2) each: an outer one, its holes, and so on; no rings where there is no cell."""
        return [cell.rings() for cell in self]

    def polygons(self) -> List[Floats]:
        """The vertices of each cell, (K, 2); (0, 2) where there is none.

        In a domain with an outline a cell may be more than one ring, which is an error: `rings` has them.
        """
        rings, offsets = self.ring_starts, self.cell_offsets
        if len(rings) > np.count_nonzero(np.diff(offsets)):
            raise _scalars.refuse('outline', 'some cells have several rings, no polygon has them: call rings()')
        return np.split(self.cell_vertices, offsets[1:-1])

    def topology(self, threads: Optional[int] = None) -> _vorpipe.Topology:
        """The vertices and edges that cells share, each once; boundary edges have a `Wall` for their second cell."""
        self._needs('polygons', 'topology')
        return _vorpipe.topology_of(self._cells, _arguments.threads_of(threads))

    def locate(self, places: Any, threads: Optional[int] = None) -> npt.NDArray[np.int64]:
        """(P,): the point whose cell holds each of the places (P, 2); `NO_SITE` beyond the domain.

        On the globe places are in degrees.

        Of one place, (x, y), it is one number. The first call prepares a search tree, which the diagram keeps.
        """
        wanted = _tables.places_of(places, self._cells.input.system)
        if self._locator is None:
            self._locator = _vorpipe.locator_of(self._cells, _arguments.threads_of(threads))
        found = self._locator.find(wanted.reshape(-1, 2))
        return found if wanted.ndim == 2 else found[0]

    # As matrices

    def adjacency(self, lengths: bool = False) -> csr_array:
        """(N, N): scipy's sparse matrix with a 1 where two cells share an edge, as in `neighbor_pairs`.

        With `lengths` the length of what they share: rows then add up to perimeters less what is at walls. In a
        periodic domain a cell may share edges with itself.
        """
        from ._matrices import adjacency
        return adjacency(self, lengths)

    def area_jacobian(self, by: str = 'weights') -> csr_array:
        """The derivatives of the areas, sparse: by the weights (N, N), or by="points" (N, 2 N), x and y in turn.

        By weights it is symmetric, -length / (2 distance) for two cells that share an edge, and each row adds up to 0.
        With `project`, points are those of the plane, in kilometers. Walls stay where they are.
        """
        self._needs_plane('area_jacobian')
        from ._matrices import area_jacobian
        return area_jacobian(self, by)

    def natural_neighbors(self, places: Any, threads: Optional[int] = None) -> csr_array:
        """(P, N): Sibson's weights, sparse: what part of the cell that a place would have is each point's now.

        Places are as in `locate`. Cells are those of the whole plane, whatever the domain, so that rows add up to 1,
        and weights times points are the place itself. A row beyond the hull of the points is empty. For points without
        weights, and detail="all".
        """
        self._needs_plane('natural_neighbors')
        from ._matrices import natural_neighbors
        return natural_neighbors(self, places, threads)

    def interpolate(self, values: Any, places: Any, threads: Optional[int] = None) -> Floats:
        """(P,) or (P, K): what values (N,) or (N, K) at the points, or those of an attribute, are at places (P, 2).

        By natural neighbors: smooth but at the points, exact for linear functions, NaN beyond the hull of the points.
        """
        self._needs_plane('interpolate')
        from ._matrices import interpolated
        return interpolated(self, values, places, threads)

    points = formerly('points', 'sites')
    offsets = formerly('offsets', 'cell_offsets')
    vertices = formerly('vertices', 'cell_vertices')

    # To other programs

    def check(self, threads: Optional[int] = None) -> List[str]:
        """As `vorpipe.check`."""
        return _vorpipe.check_cells(self._cells, _arguments.threads_of(threads))

    def save(self, path: PathLike, *, only_cells: bool = False) -> None:
        """Writes the cells, by the extension.

        .csv, .npz, .geojson, .geojsonl, .gpkg, .svg, .obj, .ply, .vtk, .vtp, .vtu or .wkt. Attributes come out in .csv,
        .geojson, .geojsonl and .gpkg. `only_cells` leaves out points without a cell, in formats of features.
        """
        to = _scalars.path_of(path)
        self._cells.save(to, _scalars.flag_of('only_cells', only_cells))
        self._warn_of_names(to)

    def save_edges(self, path: PathLike, threads: Optional[int] = None) -> None:
        """Writes the edges of all cells as lines, each once, with its two points and its length, by the extension.

        .csv, .geojson, .geojsonl, .gpkg, .vtp or .wkt.
        """
        self._cells.save_edges(_scalars.path_of(path), _arguments.threads_of(threads))

    def to_bytes(self, extension: str, *, only_cells: bool = False) -> bytes:
        """What `save` would write into a file with that extension, as ".geojson"."""
        _scalars.text_of('extension', extension)
        written = _vorpipe.bytes_of(self._cells, extension, _scalars.flag_of('only_cells', only_cells))
        self._warn_of_names(b'cells' + extension.encode())
        return written

    def _warn_of_names(self, path: bytes) -> None:
        given = self._cells.input.attributes
        if given is not None and _vorpipe.carries_attributes(path):
            warn([given.renaming_note])

    def to_shapely(self) -> List[Any]:
        """A polygon of shapely's for each point: empty where there is no cell, a MultiPolygon where it takes one."""
        from ._shapes import shapely_polygons
        return shapely_polygons(self)

    def to_dataframe(self) -> pandas.DataFrame:
        """A DataFrame of pandas: a row for each point, under its label, with place, status, measures and attributes.

        Columns have the names that files have them by; attributes of such names begin with input_.
        """
        from ._shapes import data_frame
        return data_frame(self)

    def to_geopandas(self, crs: Any = None) -> geopandas.GeoDataFrame:
        """A GeoDataFrame: `to_dataframe` with the cells, in the diagram's coordinate reference system.

        `crs` says what that is where the points did not, in any form that GeoPandas takes.
        """
        from ._shapes import geo_data_frame
        return geo_data_frame(self, crs)

    def plot(self, ax: Optional[Axes] = None, *, color: Any = 'areas', show_sites: bool = False,
             **properties: Any) -> Axes:
        """Draws the cells with matplotlib, and returns the axes.

        Args:
            ax: where; None for the current axes.
            color: an array of N values, the name of one of the diagram's ("areas", "mass" ...), or None for edges
                alone.
            show_sites: a dot at each point.
            properties: of matplotlib's PathCollection, as cmap, edgecolor, linewidth, alpha.
        """
        from ._plot import plot_cells
        return plot_cells(self, ax, color, show_sites, properties)


def _ascending(pairs: Integers) -> Integers:
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
