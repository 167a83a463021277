"""Cells in space."""
from __future__ import annotations

import operator
import os
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _arguments, _attributes, _scalars, _space_shapes, _vorpipe
from ._arguments import Floats, PathLike
from ._diagram import Integers
from ._kept import Kept
from ._space_shapes import VtkArrays
from ._warnings import warn

#: What `cells` takes in a plane alone, and why there is none of it in space.
_OF_PLANE = {'density': 'it is of a plane', 'density_box': 'it is of a plane',
             'surface': 'cells in space fill their domain',
             'globe': 'cells are either on the globe or in space', 'project': 'points in space are not degrees',
             'crs': 'points in space have no reference system', 'attributes': 'in space they are those of a file',
             'margin': 'a domain in space is six numbers, or the box of the points',
             'domain_layer': 'the domain in space is a box', 'repair': 'the domain in space is a box'}


class SpaceSites(Kept):
    """Points in space with all that their file says of them; made by `read(path, dim=3)`, for `cells`."""

    __slots__ = ('_sites', '_attributes')
    _made_of = ('_sites',)

    def __init__(self, sites: _vorpipe.SpaceSites) -> None:
        self._sites = sites
        self._attributes: Optional[Dict[str, npt.NDArray[Any]]] = None

    def __len__(self) -> int:
        return len(self._sites)

    def __repr__(self) -> str:
        names = ', '.join(self._sites.attributes.names)
        return f'<vorpipe.SpaceSites: {len(self)} points of {self._sites.name}{": " if names else ""}{names}>'

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> npt.NDArray[Any]:
        """The points, for what knows arrays alone."""
        points = np.array(self.points)
        return points if dtype is None else points.astype(dtype)

    @property
    def points(self) -> Floats:
        """(N, 3): x, y and z."""
        return self._sites.points

    @property
    def weights(self) -> Optional[Floats]:
        """(N,); None where the file has none."""
        return self._sites.weights

    @property
    def box(self) -> Optional[Tuple[float, float, float, float, float, float]]:
        """(xmin, ymin, zmin, xmax, ymax, zmax): the upright cell that the file names, which is the domain where no
        other is given; None where it names none."""
        return self._sites.box

    @property
    def attributes(self) -> Mapping[str, npt.NDArray[Any]]:
        """By their names, (N,) each, as those of `Sites`."""
        if self._attributes is None:
            self._attributes = _attributes.arrays_of(self._sites.attributes)
        return self._attributes

    @property
    def notes(self) -> List[str]:
        """What was reinterpreted or ignored, a line each; `read` has warned of them."""
        return self._sites.notes


class Face(NamedTuple):
    """What a cell shares with one neighbor."""

    neighbor: int  #: a point, or a `Wall`
    area: float
    vertices: Floats  #: (K, 3), counter-clockwise seen from outside


class Polyhedron(NamedTuple):
    """A cell as a mesh of its own."""

    vertices: Floats  #: (V, 3)
    faces: List[Integers]  #: indices of vertices, counter-clockwise seen from outside; in the order of the neighbors


class NeighborList(NamedTuple):
    """Which cells share faces: each pair in both directions, in ascending order of the first."""

    points: Integers  #: (P,)
    neighbors: Integers  #: (P,)
    areas: Floats  #: (P,)


class Rows(Sequence[npt.NDArray[Any]]):
    """One array for each cell, all of them parts of `flat`: row i is `flat[offsets[i]:offsets[i + 1]]`."""

    __slots__ = ('flat', 'offsets')

    def __init__(self, flat: npt.NDArray[Any], offsets: Integers) -> None:
        self.flat, self.offsets = flat, offsets

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, cell: Any) -> Any:
        if isinstance(cell, slice):
            return [self[k] for k in range(*cell.indices(len(self)))]
        at = _index_of(cell, len(self))
        return self.flat[self.offsets[at]:self.offsets[at + 1]]

    def __iter__(self) -> Iterator[npt.NDArray[Any]]:
        return (self[cell] for cell in range(len(self)))

    def __repr__(self) -> str:
        return f'<vorpipe.Rows: {len(self)} of {len(self.flat)} values>'


def _index_of(cell: Any, count: int) -> int:
    index = operator.index(cell)
    if not -count <= index < count:
        raise IndexError(f'there is no cell {index}: the diagram has {count}')
    return index % count


class Diagram3(Kept):
    """The cells of N points in space, in their order and units; made by `cells`.

    Arrays are read-only, and show the memory of the diagram without a copy; each keeps it alive. Cell i has the
    faces `neighbor_offsets[i]` to `neighbor_offsets[i + 1] - 1`, in ascending order of their neighbors; face f has the
    vertices `face_vertices[face_vertex_offsets[f]:face_vertex_offsets[f + 1]]`, counter-clockwise seen from outside.
    Both cells of a face have the same vertices in it. It can be pickled.
    """

    __slots__ = ('_cells', '_attributes')
    _made_of = ('_cells',)

    def __init__(self, cells: _vorpipe.SpaceCells) -> None:
        self._cells = cells
        self._attributes: Optional[Dict[str, npt.NDArray[Any]]] = None

    def __len__(self) -> int:
        return len(self._cells)

    def __repr__(self) -> str:
        report = self.report
        return f'<vorpipe.Diagram3: {report.ok} cells of {len(self)} points in space>'

    def _needs(self, name: str) -> None:
        if self._cells.measures:
            raise _scalars.refuse('detail', f"{name} takes detail='all', the cells were computed with 'measures'")

    @property
    def sites(self) -> Floats:
        """(N, 3): the points that were given."""
        return self._cells.sites.points

    @property
    def weights(self) -> Optional[Floats]:
        """(N,): their weights; None where there are none."""
        return self._cells.weights

    @property
    def domain(self) -> Tuple[float, float, float, float, float, float]:
        """(xmin, ymin, zmin, xmax, ymax, zmax)."""
        return self._cells.domain

    @property
    def attributes(self) -> Mapping[str, npt.NDArray[Any]]:
        """What came with the points of a file, by name, (N,) each."""
        if self._attributes is None:
            self._attributes = _attributes.arrays_of(self._cells.sites.attributes)
        return self._attributes

    @property
    def detail(self) -> str:
        """ "measures" or "all": which arrays there are."""
        return 'measures' if self._cells.measures else 'all'

    @property
    def report(self) -> _vorpipe.Report:
        """Times, and what became of how many points."""
        return self._cells.report

    # By cell

    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """(N,): a `Status` each."""
        return self._cells.status

    @property
    def owner(self) -> npt.NDArray[np.int32]:
        """(N,): the point that owns the cell: itself unless it is a duplicate."""
        return self._cells.owner

    @property
    def volumes(self) -> Floats:
        """(N,): 0 where there is no cell."""
        return self._cells.volumes

    @property
    def areas(self) -> Floats:
        """(N,): of the cells' surfaces."""
        return self._cells.areas

    @property
    def centroids(self) -> Floats:
        """(N, 3): the point itself where there is no cell."""
        return self._cells.centroids

    @property
    def second_moments(self) -> Floats:
        """(N, 6): about the centroid: the integrals of xx, yy, zz, yz, xz and xy."""
        self._needs('second_moments')
        return self._cells.second_moments

    @property
    def periodic(self) -> Optional[str]:
        """The axes along which the domain repeats, as "xyz"; None of neither."""
        return self._cells.periodic or None

    @property
    def lattice(self) -> Optional[Floats]:
        """(3, 3): the vectors by which the points repeat; None where there are none."""
        numbers = self._cells.lattice
        return np.array(numbers).reshape(3, 3) if numbers else None

    @property
    def neighbor_shifts(self) -> Optional[Rows]:
        """Of points that repeat, for each cell by how many sides of the domain, or vectors of the lattice, the images
        that are its neighbors are moved from their points; (3,) integers a face, in the order of its neighbors."""
        if not self._cells.periodic and not self._cells.lattice:
            return None
        return Rows(self._cells.neighbor_shifts, self._cells.neighbor_offsets)

    @property
    def neighbors(self) -> Rows:
        """For each cell its neighbors, ascending: points, or a `Wall`."""
        return Rows(self._cells.neighbors, self._cells.neighbor_offsets)

    @property
    def face_areas(self) -> Rows:
        """For each cell the areas of its faces, in the order of its neighbors."""
        return Rows(self._cells.face_areas, self._cells.neighbor_offsets)

    @property
    def neighbor_offsets(self) -> Integers:
        """(N + 1,): where the faces of each cell begin."""
        return self._cells.neighbor_offsets

    # Polyhedra

    @property
    def face_vertex_offsets(self) -> Integers:
        """(F + 1,): where the vertices of each face begin."""
        self._needs('face_vertex_offsets')
        return self._cells.face_vertex_offsets

    @property
    def face_vertices(self) -> npt.NDArray[np.int32]:
        """Indices of `vertices`."""
        self._needs('face_vertices')
        return self._cells.face_vertices

    @property
    def vertices(self) -> Floats:
        """(V, 3): each once, whatever the number of its cells."""
        self._needs('vertices')
        return self._cells.vertices

    @property
    def vertex_sites(self) -> Rows:
        """For each vertex the points and walls whose cells meet in it."""
        self._needs('vertex_sites')
        return Rows(self._cells.vertex_sites, self._cells.vertex_site_offsets)

    def _rings(self, cell: int) -> List[npt.NDArray[np.int32]]:
        at, offsets = _index_of(cell, len(self)), self._cells.face_vertex_offsets
        first, last = self._cells.neighbor_offsets[at:at + 2]
        return [self._cells.face_vertices[offsets[face]:offsets[face + 1]] for face in range(first, last)]

    def faces(self, cell: int) -> List[Face]:
        """The faces of a cell."""
        self._needs('faces')
        rings = self._rings(cell)
        return [Face(int(neighbor), float(area), self._cells.vertices[ring])
                for neighbor, area, ring in zip(self.neighbors[cell], self.face_areas[cell], rings)]

    def polyhedron(self, cell: int) -> Polyhedron:
        """A cell as vertices and faces; without any where there is no cell."""
        self._needs('polyhedron')
        rings = self._rings(cell)
        if not rings:
            return Polyhedron(np.empty((0, 3)), [])
        used, where = np.unique(np.concatenate(rings), return_inverse=True)
        parts = np.split(where.reshape(-1).astype(np.int64), np.cumsum([len(ring) for ring in rings])[:-1])
        return Polyhedron(self._cells.vertices[used], parts)

    def neighbor_list(self) -> NeighborList:
        """Which cells share faces, without walls."""
        own = np.repeat(np.arange(len(self)), np.diff(self.neighbor_offsets))
        other = self._cells.neighbors
        chosen = other >= 0
        return NeighborList(own[chosen], other[chosen], self._cells.face_areas[chosen])

    # Shapes

    @property
    def sphericities(self) -> Floats:
        """(N,): the surface of a ball of the cell's volume over its own; 1 at most, NaN where there is no cell."""
        return _space_shapes.sphericities(self.volumes, self.areas)

    @property
    def face_orders(self) -> Rows:
        """For each cell the numbers of edges of its faces, in the order of its neighbors."""
        return Rows(np.diff(self.face_vertex_offsets), self.neighbor_offsets)

    def orders(self, first: int = 3, last: int = 6, threshold: float = 0.0) -> Integers:
        """(N, last - first + 1): how many faces of each cell have 3, 4, 5 and 6 edges, its Voronoi index
        <n3,n4,n5,n6>. Faces of `threshold` of the cell's surface or less do not count."""
        if not 0 <= first <= last:
            raise _scalars.refuse('last', f'{last} is less than {first}')
        counted = self.face_shares('area').flat > _share_of(threshold)
        return _space_shapes.orders(self.face_orders.flat, self.neighbor_offsets, counted, first, last)

    @property
    def face_perimeters(self) -> Rows:
        """For each cell the perimeters of its faces."""
        return Rows(_space_shapes.perimeters(self.vertices, self.face_vertices, self.face_vertex_offsets),
                    self.neighbor_offsets)

    @property
    def edge_lengths(self) -> Floats:
        """(N,): the total length of the edges of each cell."""
        return _space_shapes.sums_of(self.face_perimeters.flat, self.neighbor_offsets) / 2

    @property
    def solid_angles(self) -> Rows:
        """For each cell the solid angles of its faces, seen from its point: 4 pi in all. Those that show the point
        their back, as they may where weights leave it outside its cell, are negative."""
        return Rows(_space_shapes.solid_angles(self.sites, self.vertices, self.face_vertices, self.face_vertex_offsets,
                                               self.neighbor_offsets), self.neighbor_offsets)

    def face_shares(self, by: str = 'area') -> Rows:
        """For each cell the shares of its faces in its surface, or by="solid_angle" in 4 pi."""
        if by == 'area':
            own = np.repeat(self.areas, np.diff(self.neighbor_offsets))
            return Rows(self._cells.face_areas / np.where(own > 0, own, 1), self.neighbor_offsets)
        if by != 'solid_angle':
            raise _scalars.refuse('by', f'{by!r} is neither "area" nor "solid_angle"')
        return Rows(self.solid_angles.flat / (4 * np.pi), self.neighbor_offsets)

    def coordination(self, threshold: float = 0.0, by: str = 'area') -> Integers:
        """(N,): how many points are neighbors of each by a face whose share, as `face_shares` has it, is larger than
        `threshold`; walls do not count."""
        counted = (self.face_shares(by).flat > _share_of(threshold)) & (self._cells.neighbors >= 0)
        return _space_shapes.sums_of(counted.astype(np.int64), self.neighbor_offsets)

    def tetrahedra(self) -> Integers:
        """(T, 4): the tetrahedra of the Delaunay, or regular, triangulation whose vertex is inside the domain, as four
        points each, of positive volume; more points than four that meet in one vertex are several."""
        self._needs('tetrahedra')
        own = np.repeat(np.arange(len(self)), np.diff(self.neighbor_offsets))
        return _space_shapes.tetrahedra(self.sites, self.face_vertices, self.face_vertex_offsets,
                                        np.column_stack((own, self._cells.neighbors)), self._cells.vertex_sites,
                                        self._cells.vertex_site_offsets)

    def vtk_arrays(self) -> VtkArrays:
        """The polyhedra as VTK's arrays: points, cells in its order of numbers, their types, data by cell."""
        self._needs('vtk_arrays')
        chosen = np.flatnonzero(np.diff(self.neighbor_offsets) >= 4)
        data: Dict[str, npt.NDArray[Any]] = {
            'site': chosen, 'volume': self.volumes[chosen], 'area': self.areas[chosen],
            'neighbors': np.diff(self.neighbor_offsets)[chosen], 'centroid': self.centroids[chosen]}
        if self.weights is not None:
            data['weight'] = self.weights[chosen]
        cells = _space_shapes.vtk_cells(self.face_vertices, self.face_vertex_offsets, self.neighbor_offsets, chosen)
        return VtkArrays(np.array(self.vertices), cells, np.full(len(chosen), 42, np.uint8), data)

    def to_pyvista(self) -> Any:
        """The polyhedra as a `pyvista.UnstructuredGrid`, with their data; takes pyvista."""
        import pyvista
        arrays = self.vtk_arrays()
        grid = pyvista.UnstructuredGrid(arrays.cells, arrays.types, arrays.points)
        for name, values in arrays.data.items():
            grid.cell_data[name] = values
        return grid

    def volume_sum(self) -> float:
        """The sum of the volumes, without what adding up would round off: the domain's volume, if all is well."""
        return self._cells.volume_sum()

    def check(self, threads: Optional[int] = None) -> List[str]:
        """What is wrong with the cells, a line for each broken promise; verified without what computes them."""
        return self._cells.check(_arguments.threads_of(threads))

    def save(self, path: PathLike, voro_format: Optional[str] = None) -> None:
        """Writes them as .npz, .csv, .vtu, .obj, .ply, .stl or .vol, as the command line does.

        Args:
            path: of the file.
            voro_format: of a .vol: the lines of text, as option -c of Voro++ has them, as "%i %q %v %n".
        """
        self._cells.save(_scalars.path_of(path), _scalars.text_or_none('voro_format', voro_format) or '')


def _share_of(threshold: Any) -> float:
    share = float(threshold)
    if not 0 <= share < 1:
        raise _scalars.refuse('threshold', f'{share:g} is no share from 0 to 1')
    return share


def box_in_space(value: Any) -> Optional[Tuple[float, float, float, float, float, float]]:
    """(xmin, ymin, zmin, xmax, ymax, zmax)."""
    if value is None:
        return None
    if isinstance(value, str) or hasattr(value, '__geo_interface__'):
        raise _scalars.refuse('domain', 'in space it is 6 numbers: xmin, ymin, zmin, xmax, ymax, zmax')
    array = _arguments.numbers('domain', value)
    if array.shape != (6,):
        raise _scalars.refuse('domain', f'shape {array.shape}, must be 6 numbers in space: xmin, ymin, zmin, xmax, '
                                        'ymax, zmax')
    xmin, ymin, zmin, xmax, ymax, zmax = _arguments.listed(array)
    return xmin, ymin, zmin, xmax, ymax, zmax


def axes_in_space(value: Any) -> str:
    """Of "xyz", "x,z", True for all, or three truth values."""
    if value is None or value is False or value == 'none':
        return ''
    if value is True:
        return 'xyz'
    if isinstance(value, str):
        letters = value.replace(',', '')
        if letters and letters == ''.join(axis for axis in 'xyz' if axis in letters):
            return letters
    elif np.shape(value) == (3,):
        return ''.join(axis for axis, repeats in zip('xyz', value) if repeats)
    raise _scalars.refuse('periodic', f'{value!r} is not some of "xyz", in this order, nor three truth values')


def lattice_of(value: Any) -> List[float]:
    """Nine numbers of three vectors: an array, ASE's cell, or a lattice of pymatgen, whose vectors are its matrix."""
    if value is None:
        return []
    array = _arguments.numbers('lattice', getattr(value, 'matrix', value))
    if array.shape != (3, 3):
        raise _scalars.refuse('lattice', f'shape {array.shape}, must be three vectors of three numbers')
    return [float(number) for number in array.ravel()]


def sites_in_space(points: Any) -> Optional[_vorpipe.SpaceSites]:
    """Of an array of shape (N, 3), or what `read(path, dim=3)` made; None of anything else."""
    if isinstance(points, SpaceSites):
        return points._sites
    if isinstance(points, (str, os.PathLike)) and _vorpipe.is_of_space(_scalars.path_of(points)):
        found = read_in_space(points, [], '', False, 1)
        warn(found.notes)
        return found._sites
    atoms = _sites_of_atoms(points)
    if atoms is not None:
        return atoms
    if isinstance(points, (str, os.PathLike, Mapping, Kept)) or hasattr(points, 'columns') or hasattr(
            points, '__geo_interface__'):
        return None
    # What is said of points is a tuple, too, of a type of its own.
    if type(points) in (list, tuple):
        if not all(isinstance(point, (list, tuple, np.ndarray)) and len(point) == 3 for point in points):
            return None
    elif not hasattr(points, '__array__'):
        return None
    shape = np.shape(points)
    if len(shape) != 2 or shape[1] != 3:
        return None
    return _sites_of(points, None, None)


def _sites_of(points: Any, box: Optional[Tuple[float, float, float, float, float, float]],
              attributes: Optional[_vorpipe.Attributes]) -> _vorpipe.SpaceSites:
    array = np.ascontiguousarray(_arguments.numbers('points', points))
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(wrong):
        numbers = ', '.join(f'{x:g}' for x in array[wrong[0]])
        raise _scalars.refuse('points', f'point {wrong[0]} is not finite: {numbers}')
    return _vorpipe.space_sites(array, box, attributes)


def _sites_of_atoms(atoms: Any) -> Optional[_vorpipe.SpaceSites]:
    """Of what has positions in a cell, as ASE's Atoms or a Structure of pymatgen; None of anything else."""
    if hasattr(atoms, 'get_positions') and hasattr(atoms, 'cell'):
        positions, vectors = atoms.get_positions(), np.asarray(atoms.cell, dtype=float)
        periods = np.asarray(getattr(atoms, 'pbc', False))
        symbols = atoms.get_chemical_symbols() if hasattr(atoms, 'get_chemical_symbols') else None
    elif hasattr(atoms, 'cart_coords') and hasattr(atoms, 'lattice'):
        positions, vectors = atoms.cart_coords, np.asarray(atoms.lattice.matrix, dtype=float)
        periods = np.asarray(getattr(atoms.lattice, 'pbc', True))
        symbols = [str(site.specie) for site in atoms] if getattr(atoms, 'is_ordered', False) else None
    else:
        return None
    attributes = None if symbols is None else _attributes.attributes_of({'element': symbols}, len(positions))
    return _sites_of(positions, _box_of_vectors(vectors, periods), attributes)


def _box_of_vectors(vectors: Floats, periods: npt.NDArray[Any]
                    ) -> Optional[Tuple[float, float, float, float, float, float]]:
    """The box of an upright cell; warns of what is not used."""
    if not vectors.any():
        return None
    sides = vectors.diagonal()
    if vectors.shape != (3, 3) or (vectors != np.diag(sides)).any() or (sides == 0).any():
        warn(['the cell of the atoms is tilted, and is not used: lattice names it'])
        return None
    if periods.any():
        axes = ', '.join(np.array(['x', 'y', 'z'])[np.broadcast_to(periods, 3).astype(bool)])
        warn([f'the atoms repeat themselves along {axes}; their cells do so with domain and periodic'])
    low, high = np.minimum(sides, 0).tolist(), np.maximum(sides, 0).tolist()
    return low[0], low[1], low[2], high[0], high[1], high[2]


def cells_in_space(session: _vorpipe.Session, sites: _vorpipe.SpaceSites, weights: Any, domain: Any,
                   options: Mapping[str, Any]) -> Diagram3:
    """As `cells` has it of points in space."""
    for name, why in _OF_PLANE.items():
        if options[name] not in (None, False, 'none'):
            raise _scalars.refuse(name, why)
    if options['search'] != 'grid':
        raise _scalars.refuse('search', 'cells in space are found on the grid alone')
    periodic, lattice = axes_in_space(options['periodic']), lattice_of(options['lattice'])
    if lattice and (periodic or domain is not None):
        raise _scalars.refuse('lattice', 'points that repeat by it have no domain and no other period')
    detail = _arguments.detail_of(options['detail'])
    given = _arguments.weights_of(weights, len(sites))
    return Diagram3(_vorpipe.cells_in_space(session, sites, given, box_in_space(domain), periodic, lattice,
                                            detail == 'measures',
                                            _scalars.call_of('progress', options['progress'])))


def read_in_space(path: PathLike, columns: List[str], format: str, skip_missing: bool, seed: int,
                  box: Any = None) -> SpaceSites:
    return SpaceSites(_vorpipe.read_space(_scalars.path_of(path), _scalars.seed_of(seed), format, columns, skip_missing,
                                          box_in_space(box)))
