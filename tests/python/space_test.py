"""Cells in space."""
import copy
import pickle

import numpy as np
import pytest

import vorpipe

SPATIAL = pytest.importorskip('scipy.spatial')
UNIT = (0, 0, 0, 1, 1, 1)


@pytest.fixture(scope='module')
def foam():
    points = np.random.default_rng(7).random((400, 3))
    return vorpipe.cells(points, domain=UNIT, check=True)


def inner(diagram):
    return [i for i in range(len(diagram)) if (diagram.neighbors[i] >= 0).all()]


def test_points_of_three_columns_are_in_space(foam):
    assert isinstance(foam, vorpipe.Diagram3) and len(foam) == 400
    assert foam.domain == UNIT and foam.detail == 'all' and foam.check() == []
    assert abs(foam.volume_sum() - 1) < 1e-12 and foam.volumes.sum() == pytest.approx(1, abs=1e-12)
    assert '400 cells of 400 points in space' in repr(foam)
    assert (foam.status == vorpipe.Status.OK).all() and (foam.owner == np.arange(400)).all()
    as_list = vorpipe.cells(foam.sites.tolist(), domain=UNIT)
    assert (as_list.volumes == foam.volumes).all()
    plane = vorpipe.cells([[0, 0], [1, 2], [3, 1]])
    assert isinstance(plane, vorpipe.Diagram) and isinstance(vorpipe.Session("cpu").cells([(0, 0)] * 3), vorpipe.Diagram)


def test_neighbors_are_scipys(foam):
    mesh = SPATIAL.Delaunay(foam.sites)
    ours = foam.neighbor_list()
    pairs = set(zip(ours.points.tolist(), ours.neighbors.tolist()))
    indptr, indices = mesh.vertex_neighbor_vertices
    for i in inner(foam):
        mine = {j for _, j in [(i, j) for j in foam.neighbors[i].tolist()]}
        assert mine <= set(indices[indptr[i]:indptr[i + 1]].tolist())
        assert {(i, j) for j in mine} <= pairs and {(j, i) for j in mine} <= pairs
    own = np.repeat(np.arange(400), np.diff(foam.neighbor_offsets))
    assert len(ours.areas) == (foam.neighbors.flat >= 0).sum() and (np.diff(ours.points) >= 0).all()
    assert (np.bincount(own, foam.face_areas.flat) == pytest.approx(foam.areas))


def test_polyhedra_are_scipys_hulls(foam):
    for i in inner(foam)[:20]:
        vertices, faces = foam.polyhedron(i)
        hull = SPATIAL.ConvexHull(vertices)
        assert hull.volume == pytest.approx(foam.volumes[i], rel=1e-9)
        assert hull.area == pytest.approx(foam.areas[i], rel=1e-9)
        assert len(vertices) == len(hull.vertices)
        shown = foam.faces(i)
        assert [face.neighbor for face in shown] == foam.neighbors[i].tolist()
        for face, ring in zip(shown, faces):
            assert (face.vertices == vertices[ring]).all()
            middle = (foam.sites[i] + foam.sites[face.neighbor]) / 2
            normal = foam.sites[face.neighbor] - foam.sites[i]
            assert np.abs((face.vertices - middle) @ normal).max() < 1e-12
            turned = sum(np.cross(a, b) for a, b in zip(face.vertices, np.roll(face.vertices, -1, 0)))
            assert turned @ normal > 0 and np.linalg.norm(turned) / 2 == pytest.approx(face.area, rel=1e-6)
    with pytest.raises(IndexError, match='there is no cell 400'):
        foam.faces(400)
    assert (foam.neighbors[-1] == foam.neighbors[399]).all()


def test_vertices_are_equally_far_from_their_points(foam):
    for vertex, meeting in zip(foam.vertices, foam.vertex_sites):
        distances = np.linalg.norm(foam.sites[meeting[meeting >= 0]] - vertex, axis=1)
        assert np.ptp(distances) < 1e-9 and len(meeting) == 4


@pytest.mark.parametrize('pattern, faces', [('cubic', {6}), ('fcc', {12}), ('hcp', {12}), ('a15', {12, 14})])
def test_crystals(pattern, faces):
    points = vorpipe.generate(pattern, 600)
    assert points.shape[1] == 3
    crystal = vorpipe.cells(points, domain=UNIT, check=True)
    assert {len(crystal.neighbors[i]) for i in inner(crystal)} == faces


def test_moments_of_a_box():
    box = vorpipe.cells([[1, 1, 1]], domain=(0, 0, 0, 2, 3, 4))
    assert box.volumes.tolist() == [24] and box.areas.tolist() == [52]
    assert box.centroids.tolist() == [[1, 1.5, 2]]
    assert box.second_moments[0] == pytest.approx([24 * 4 / 12, 24 * 9 / 12, 24 * 16 / 12, 0, 0, 0])
    walls = vorpipe.Wall
    assert box.neighbors[0].tolist() == sorted([walls.XMIN, walls.XMAX, walls.YMIN, walls.YMAX, walls.ZMIN, walls.ZMAX])
    assert sorted(box.face_areas[0].tolist()) == [6, 6, 8, 8, 12, 12]


def test_duplicates_and_points_outside():
    found = vorpipe.cells([[0, 0, 0], [0, 0, 0], [9, 9, 9]], domain=(-1, -1, -1, 1, 1, 1), check=True)
    assert found.status.tolist() == [0, 1 + 1, 1] and found.owner.tolist() == [0, 0, 2]
    assert found.polyhedron(2).faces == [] and found.faces(1) == []
    assert len(vorpipe.cells([[0, 0, 0], [1, 2, 3]])) == 2


def test_measures_alone(foam):
    less = vorpipe.cells(foam.sites, domain=UNIT, detail='measures')
    assert (less.volumes == foam.volumes).all() and (less.neighbors.flat == foam.neighbors.flat).all()
    assert vorpipe.compare(less, foam).agree and less.detail == 'measures'
    for name in ('vertices', 'second_moments', 'face_vertices', 'vertex_sites'):
        with pytest.raises(vorpipe.InputError, match=f"^detail: {name} takes detail='all'"):
            getattr(less, name)
    with pytest.raises(vorpipe.InputError, match='detail'):
        less.save('cells.vtu')


def test_arrays_show_memory_and_outlive_the_diagram(foam):
    other = vorpipe.cells(foam.sites, domain=UNIT)
    volumes, first = other.volumes, other.neighbors[0]
    with pytest.raises(ValueError):
        volumes[0] = 1
    del other
    assert (volumes == foam.volumes).all() and (first == foam.neighbors[0]).all()


def test_pickles_and_copies(foam):
    again = pickle.loads(pickle.dumps(foam))
    assert vorpipe.compare(again, foam).equal == 400 and again.check() == []
    assert (again.vertices == foam.vertices).all() and copy.deepcopy(foam) is foam


def test_comparison(foam):
    other = vorpipe.cells(foam.sites, domain=(0, 0, 0, 1, 1, 1.1))
    diff = vorpipe.compare(foam, other)
    assert not diff.agree and diff.equal + len(set(diff.first)) <= 400 and diff.volumes > 0
    with pytest.raises(vorpipe.InputError, match='^b: its points are not'):
        vorpipe.compare(foam, vorpipe.cells(foam.sites + 0.001, domain=UNIT))


def test_files(foam, tmp_path):
    for kind in ('npz', 'csv', 'vtu', 'obj', 'ply'):
        foam.save(tmp_path / f'cells.{kind}')
        assert (tmp_path / f'cells.{kind}').stat().st_size > 10_000
    arrays = np.load(tmp_path / 'cells.npz')
    assert (arrays['volumes'] == foam.volumes).all() and (arrays['vertices'] == foam.vertices).all()
    with pytest.raises(vorpipe.InputError, match='known are .npz'):
        foam.save(tmp_path / 'cells.svg')


def test_points_of_files(tmp_path):
    (tmp_path / 'atoms.csv').write_text('name,z,x,y\na,0,1,2\nb,3,4,5\n')
    sites = vorpipe.read(tmp_path / 'atoms.csv', dim=3)
    assert isinstance(sites, vorpipe.SpaceSites) and len(sites) == 2
    assert sites.points.tolist() == [[1, 2, 0], [4, 5, 3]] and sites.attributes['name'].tolist() == ['a', 'b']
    assert np.asarray(sites).shape == (2, 3)
    cells = vorpipe.cells(sites)
    assert cells.attributes['name'].tolist() == ['a', 'b']
    cells.save(tmp_path / 'cells.csv')
    assert (tmp_path / 'cells.csv').read_text().splitlines()[1].endswith(',a')
    with pytest.raises(vorpipe.InputError, match='would be replaced'):
        cells.save(tmp_path / 'atoms.csv')
    again = pickle.loads(pickle.dumps(sites))
    assert again.points.tolist() == sites.points.tolist()
    np.save(tmp_path / 'a.npy', np.arange(12.0).reshape(4, 3) ** 2)
    assert len(vorpipe.read(tmp_path / 'a.npy', dim=3)) == 4
    with pytest.warns(vorpipe.InputWarning, match='taken as weights'):
        plane = vorpipe.cells(tmp_path / 'a.npy')
    assert isinstance(plane, vorpipe.Diagram) and plane.weights is not None


def test_weights_make_power_cells():
    random = np.random.default_rng(3)
    points, weights = random.random((300, 3)), 0.02 * random.random(300)
    cells = vorpipe.cells(points, weights, domain=UNIT, check=True)
    assert (cells.weights == weights).all() and cells.volume_sum() == pytest.approx(1, abs=1e-12)
    hidden = np.flatnonzero(cells.status == vorpipe.Status.EMPTY)
    assert cells.report.hidden == len(hidden) > 10 and (cells.volumes[hidden] == 0).all()
    # The lower hull of lifted points has an edge for each two cells with a common face.
    hull = SPATIAL.ConvexHull(np.column_stack([points, (points ** 2).sum(axis=1) - weights]))
    lower = hull.simplices[hull.equations[:, 3] < 0]
    pairs = {(a, b) for simplex in lower.tolist() for a in simplex for b in simplex if a != b}
    assert not set(lower.ravel().tolist()) & set(hidden.tolist())
    for i in inner(cells):
        assert {j for a, j in pairs if a == i} == set(cells.neighbors[i].tolist())
    for vertex, meeting in zip(cells.vertices, cells.vertex_sites):
        around = meeting[meeting >= 0]
        assert np.ptp(((points[around] - vertex) ** 2).sum(axis=1) - weights[around]) < 1e-9
    more = vorpipe.cells(points, weights + 0.25, domain=UNIT)
    assert np.abs(more.volumes - cells.volumes).max() < 1e-12
    equal = vorpipe.cells(points, np.full(300, 7.0), domain=UNIT)
    assert (equal.volumes == vorpipe.cells(points, domain=UNIT).volumes).all()
    again = pickle.loads(pickle.dumps(cells))
    assert (again.weights == weights).all() and again.check() == []
    assert vorpipe.cells(points, domain=UNIT).weights is None


def test_weights_of_files(tmp_path):
    (tmp_path / 'balls.csv').write_text('x,y,z,radius,name\n0,0,0,2,a\n4,0,0,0,b\n')
    balls = vorpipe.read(tmp_path / 'balls.csv', dim=3)
    assert balls.weights.tolist() == [4, 0] and list(balls.attributes) == ['name']
    cells = vorpipe.cells(balls, domain=(-1, -1, -1, 5, 1, 1))
    assert cells.volumes.tolist() == [14, 10] and cells.weights.tolist() == [4, 0]
    cells.save(tmp_path / 'cells.npz')
    assert np.load(tmp_path / 'cells.npz')['weights'].tolist() == [4, 0]
    with pytest.raises(vorpipe.InputError, match='^weights: .*balls.csv has weights of its own'):
        vorpipe.cells(balls, weights=[1, 2])
    for weights, text in (([1], r'shape \(1,\)'), ([0, np.inf], 'not finite'), ([0, 1e300], 'too large')):
        with pytest.raises(vorpipe.InputError, match='^weights: .*' + text):
            vorpipe.cells([[0, 0, 0], [1, 1, 1]], weights=weights)


@pytest.mark.parametrize('name, value', [('periodic', 'zx'), ('periodic', 'xy'), ('lattice', [1, 2]), ('globe', True),
                                         ('project', 'auto'), ('search', 'flann'), ('surface', 'free'),
                                         ('domain', (0, 0, 1, 1)), ('domain', 'hull'), ('backend', 'vulkan'),
                                         ('margin', '5%'), ('attributes', {'a': [1, 2, 3, 4]})])
def test_what_is_of_planes_is_refused(name, value):
    points = np.arange(12.0).reshape(4, 3) ** 2
    with pytest.raises(vorpipe.InputError, match=f'^{name}: '):
        vorpipe.cells(points, **{name: value})


def test_wrong_points():
    for points, text in (([[0, 0, np.nan]], 'points: .*not finite'), (np.empty((0, 3)), 'there are no'),
                         (np.zeros((2, 4)), r'shape \(2, 4\)')):
        with pytest.raises(vorpipe.InputError, match=text):
            vorpipe.cells(points)
    with pytest.raises(vorpipe.InputError, match=r'^points: shape \(4, 3\)'):
        vorpipe.render(np.arange(12.0).reshape(4, 3))
    with pytest.raises(vorpipe.InputError, match='^dim: 4'):
        vorpipe.read('random:10', dim=4)
    assert vorpipe.generate('random', 10, dim=3).shape == (10, 3)
    assert vorpipe.generate('random', 10, domain=(0, 0, 0, 1, 1, 2)).max() > 1


def test_progress_stops_it():
    with pytest.raises(vorpipe.Cancelled):
        vorpipe.cells(np.random.default_rng(1).random((20_000, 3)), progress=lambda stage, part: False)


def test_sessions_have_it_too():
    with vorpipe.Session('cpu') as session:
        assert len(session.cells(np.random.default_rng(1).random((10, 3)))) == 10


def test_shapes_of_crystals():
    cubic = vorpipe.cells(vorpipe.generate('cubic', 512), domain=UNIT)
    assert (cubic.orders() == [0, 6, 0, 0]).all() and (cubic.edge_lengths == pytest.approx(np.full(512, 12 / 8)))
    assert cubic.sphericities == pytest.approx(np.full(512, (np.pi / 6) ** (1 / 3)))
    assert cubic.solid_angles.flat == pytest.approx(np.full(6 * 512, 4 * np.pi / 6))
    bcc = vorpipe.cells(vorpipe.generate('bcc', 432), domain=UNIT)
    inside = np.flatnonzero((np.abs(bcc.sites - 0.5) < 0.3).all(axis=1))  # those before a wall's are cut as well
    assert len(inside) > 50 and (bcc.orders()[inside] == [0, 6, 0, 8]).all() and (bcc.orders(4, 4)[inside] == 6).all()
    assert (bcc.coordination()[inside] == 14).all() and bcc.coordination().max() <= 14
    # Squares have a share of 0.0373, hexagons of 0.0970.
    assert (bcc.coordination(0.05)[inside] == 8).all() and (bcc.orders(threshold=0.05)[inside] == [0, 0, 0, 8]).all()
    assert (bcc.coordination(0.05, by='solid_angle')[inside] == 8).all()
    for call, text in ((lambda: bcc.coordination(-1), '^threshold: -1'), (lambda: bcc.orders(5, 3), '^last: 3'),
                       (lambda: bcc.coordination(by='volume'), '^by: ')):
        with pytest.raises(vorpipe.InputError, match=text):
            call()


def test_shapes_of_noise(foam):
    for i in list(range(20)):
        vertices, faces = foam.polyhedron(i)
        edges = {frozenset((a, b)) for ring in faces for a, b in zip(ring.tolist(), np.roll(ring, 1).tolist())}
        lengths = [np.linalg.norm(np.subtract(*vertices[list(edge)])) for edge in edges]
        assert foam.edge_lengths[i] == pytest.approx(sum(lengths))
        assert foam.face_orders[i].tolist() == [len(ring) for ring in faces]
        assert foam.orders(0, 30)[i].tolist() == np.bincount([len(ring) for ring in faces], minlength=31).tolist()
        assert foam.solid_angles[i].sum() == pytest.approx(4 * np.pi) and foam.face_shares()[i].sum() == pytest.approx(1)
        assert (foam.solid_angles[i] > 0).all()
        assert foam.coordination(0.02)[i] == (
            (foam.face_areas[i] > 0.02 * foam.areas[i]) & (foam.neighbors[i] >= 0)).sum()
    assert foam.sphericities.max() < 1 and foam.sphericities.min() > 0.1
    none = vorpipe.cells([[0, 0, 0], [0, 0, 0], [9, 9, 9]], domain=(-1, -1, -1, 1, 1, 1))
    assert np.isnan(none.sphericities[1:]).all() and none.edge_lengths.tolist() == [24, 0, 0]
    assert none.coordination().tolist() == [0, 0, 0] and none.orders().tolist() == [[0, 6, 0, 0], [0] * 4, [0] * 4]
    # A point that its weight leaves outside its cell sees as much of it from behind.
    outside = vorpipe.cells([[0.5, 0.5, 0.5], [0.6, 0.5, 0.5]], [0.5, 0.0], domain=(0, 0, 0, 4, 1, 1))
    assert outside.solid_angles[1].sum() == pytest.approx(0, abs=1e-9) and outside.solid_angles[1].min() < 0


def test_tetrahedra_are_scipys(foam):
    mesh = SPATIAL.Delaunay(foam.sites)
    ours = foam.tetrahedra()
    theirs = {tuple(sorted(corners)) for corners in mesh.simplices.tolist()}
    mine = [tuple(sorted(corners)) for corners in ours.tolist()]
    assert len(set(mine)) == len(mine) == sum((meeting >= 0).all() for meeting in foam.vertex_sites) > 1000
    assert set(mine) <= theirs
    assert (np.linalg.det(foam.sites[ours[:, 1:]] - foam.sites[ours[:, :1]]) > 0).all()


@pytest.mark.parametrize('pattern', ['cubic', 'fcc', 'bcc', 'hcp', 'diamond'])
def test_tetrahedra_of_crystals_fill_the_middle(pattern):
    crystal = vorpipe.cells(vorpipe.generate(pattern, 500), domain=UNIT)
    corners = crystal.sites[crystal.tetrahedra()]
    sizes = np.linalg.det(corners[:, 1:] - corners[:, :1])
    assert (sizes > 1e-9).all()
    # Each place in the middle is in one of them.
    random = np.random.default_rng(11)
    for place in 0.35 + 0.3 * random.random((50, 3)):
        parts = np.array([np.linalg.det(np.where((np.arange(4) == k)[:, None], place, corners)[:, 1:] -
                                        np.where((np.arange(4) == k)[:, None], place, corners)[:, :1])
                          for k in range(4)])
        assert ((parts > 0).all(axis=0)).sum() == 1


def test_vtk_reads_the_arrays(foam):
    core = pytest.importorskip('vtkmodules.vtkCommonDataModel', reason='there is no VTK')
    from vtkmodules.util import numpy_support
    from vtkmodules.vtkCommonCore import vtkPoints
    arrays = foam.vtk_arrays()
    points, cells, grid = vtkPoints(), core.vtkCellArray(), core.vtkUnstructuredGrid()
    points.SetData(numpy_support.numpy_to_vtk(arrays.points))
    cells.ImportLegacyFormat(numpy_support.numpy_to_vtkIdTypeArray(arrays.cells))
    grid.SetPoints(points)
    # As pyvista.UnstructuredGrid(cells, types, points) does.
    grid.SetCells(numpy_support.numpy_to_vtk(arrays.types), cells)
    assert grid.GetNumberOfCells() == 400 and arrays.data['site'].tolist() == list(range(400))
    for i in range(0, 400, 7):
        cell = grid.GetCell(i)
        assert cell.GetCellType() == 42 and cell.GetNumberOfFaces() == len(foam.neighbors[i])
        for k, face in enumerate(foam.faces(i)):
            ids = cell.GetFace(k).GetPointIds()
            assert (arrays.points[[ids.GetId(j) for j in range(ids.GetNumberOfIds())]] == face.vertices).all()
    assert (arrays.data['volume'] == foam.volumes).all()


def test_pyvista_has_a_grid(foam, monkeypatch):
    import sys
    import types

    class UnstructuredGrid:
        def __init__(self, cells, types, points):
            self.given, self.cell_data = (cells, types, points), {}

    assert 'pyvista' not in sys.modules
    monkeypatch.setitem(sys.modules, 'pyvista', types.SimpleNamespace(UnstructuredGrid=UnstructuredGrid))
    grid = foam.to_pyvista()
    assert (grid.given[0] == foam.vtk_arrays().cells).all() and (grid.cell_data['volume'] == foam.volumes).all()
    with pytest.raises(vorpipe.InputError, match='^detail: vtk_arrays'):
        vorpipe.cells(foam.sites, detail='measures').to_pyvista()


class Atoms:
    """As of ASE."""

    def __init__(self, positions, cell, pbc):
        self.positions, self.cell, self.pbc = np.array(positions, float), np.array(cell, float), np.array(pbc)

    def get_positions(self):
        return self.positions

    def get_chemical_symbols(self):
        return ['Na', 'Cl'][:len(self.positions)]


def test_atoms_in_a_cell(tmp_path):
    salt = Atoms([[1, 1, 1], [3, 1, 1]], np.diag([4, 2, 2]), [False] * 3)
    cells = vorpipe.cells(salt, check=True)
    assert cells.domain == (0, 0, 0, 4, 2, 2) and cells.volumes.tolist() == [8, 8]
    assert cells.attributes['element'].tolist() == ['Na', 'Cl']
    assert pickle.loads(pickle.dumps(cells)).attributes['element'].tolist() == ['Na', 'Cl']
    assert vorpipe.cells(salt, domain=UNIT).domain == UNIT
    with pytest.warns(vorpipe.InputWarning, match='repeat themselves along x, z; their cells do so with domain and periodic'):
        assert vorpipe.cells(Atoms(salt.positions, salt.cell, [1, 0, 1])).domain == (0, 0, 0, 4, 2, 2)
    with pytest.warns(vorpipe.InputWarning, match='is tilted, and is not used'):
        tilted = vorpipe.cells(Atoms(salt.positions, [[4, 0, 0], [1, 2, 0], [0, 0, 2]], False))
    assert tilted.domain == pytest.approx((0.9, 0.9, 0.9, 3.1, 1.1, 1.1))
    assert vorpipe.cells(Atoms(salt.positions, np.zeros((3, 3)), False)).domain == tilted.domain


def test_atoms_of_ase():
    ase = pytest.importorskip('ase', reason='there is no ASE')
    from ase.build import bulk
    assert ase
    copper = bulk('Cu', 'fcc', a=4.0, cubic=True) * (3, 3, 3)
    copper.pbc = False
    cells = vorpipe.cells(copper, check=True)
    assert cells.domain == (0, 0, 0, 12, 12, 12) and {len(cells.neighbors[i]) for i in inner(cells)} == {12}


def test_files_of_simulations(tmp_path):
    (tmp_path / 'two.extxyz').write_text(
        '2\nLattice="4 0 0 0 2 0 0 0 2" pbc="F F F" Properties=species:S:1:pos:R:3\nNa 1 1 1\nCl 3 1 1\n')
    sites = vorpipe.read(tmp_path / 'two.extxyz')
    assert isinstance(sites, vorpipe.SpaceSites) and sites.box == (0, 0, 0, 4, 2, 2)
    assert sites.attributes['species'].tolist() == ['Na', 'Cl']
    assert pickle.loads(pickle.dumps(sites)).box == sites.box
    for given in (sites, tmp_path / 'two.extxyz', str(tmp_path / 'two.extxyz')):
        assert vorpipe.cells(given).volumes.tolist() == [8, 8]
    (tmp_path / 'two.xyz').write_text((tmp_path / 'two.extxyz').read_text().replace('F F F', 'T F F'))
    with pytest.warns(vorpipe.InputWarning, match='repeats itself along x; its cells do so with'):
        assert vorpipe.cells(tmp_path / 'two.xyz').domain == (0, 0, 0, 4, 2, 2)
    with pytest.raises(vorpipe.InputError, match='^dim: is 3'):
        vorpipe.read(tmp_path / 'two.extxyz', dim=2)
    assert vorpipe.cells([[0, 0, 0], [1, 1, 1]]).sites.shape == (2, 3)


def test_lines_of_voro(foam, tmp_path):
    foam.save(tmp_path / 'cells.vol', voro_format='%i %v %s')
    rows = np.loadtxt(tmp_path / 'cells.vol')
    assert (rows[:, 1] == foam.volumes).all() and (rows[:, 2] == np.diff(foam.neighbor_offsets)).all()
    foam.save(tmp_path / 'cells.vol')
    assert np.loadtxt(tmp_path / 'cells.vol').shape == (400, 5)
    foam.save(tmp_path / 'cells.stl')
    assert (tmp_path / 'cells.stl').stat().st_size == 84 + 50 * (foam.face_orders.flat - 2).sum()
    for path, text, format in (('cells.csv', '^voro_format: .csv has no such lines', '%i'),
                               ('cells.vol', '^voro_format: "%k" is no code', '%k')):
        with pytest.raises(vorpipe.InputError, match=text):
            foam.save(tmp_path / path, voro_format=format)


def test_periods():
    random = np.random.default_rng(5)
    points = random.random((60, 3)) * [2, 1, 1]
    cells = vorpipe.cells(points, domain=(0, 0, 0, 2, 1, 1), periodic='xyz', check=True)
    assert cells.periodic == 'xyz' and cells.lattice is None
    assert cells.volume_sum() == pytest.approx(2, abs=1e-12) and (cells.neighbors.flat >= 0).all()
    # A box of all images has the same cells in its middle.
    shifts = np.array([(i, j, k) for i in (0, -1, 1) for j in (0, -1, 1) for k in (0, -1, 1)])
    images = (points + (shifts * [2, 1, 1])[:, None, :]).reshape(-1, 3)
    around = vorpipe.cells(images, domain=(-2, -1, -1, 4, 2, 2), detail='measures')
    assert around.volumes[:60] == pytest.approx(cells.volumes)
    for i in range(60):
        found = {(int(n) % 60, *shifts[n // 60]) for n in around.neighbors[i]}
        assert found == {(int(n), *shift) for n, shift in zip(cells.neighbors[i], cells.neighbor_shifts[i])}
    for periodic, walls in (('z', {-1, -2, -3, -4}), ('x,y', {-6, -7}), ((True, False, True), {-3, -4})):
        part = vorpipe.cells(points, domain=(0, 0, 0, 2, 1, 1), periodic=periodic, check=True)
        assert set(part.neighbors.flat[part.neighbors.flat < 0]) == walls
    again = pickle.loads(pickle.dumps(cells))
    assert again.periodic == 'xyz' and (again.neighbor_shifts.flat == cells.neighbor_shifts.flat).all()
    assert again.check() == []
    assert vorpipe.cells(points).neighbor_shifts is None
    with pytest.raises(vorpipe.InputError, match='^periodic: name the period by domain'):
        vorpipe.cells(points, periodic='xyz')


def test_lattices(tmp_path):
    fcc = [[0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]]

    class Lattice:
        matrix = np.array(fcc)

    for lattice in (fcc, np.array(fcc), Lattice()):
        cells = vorpipe.cells([[7, 0.25, 0]], lattice=lattice, check=True)
        assert len(cells.neighbors[0]) == 12 and cells.volumes[0] == pytest.approx(0.25)
        # The image of each neighbor is as far away as all others.
        assert np.linalg.norm(cells.neighbor_shifts[0] @ cells.lattice, axis=1) == pytest.approx(np.sqrt(0.5))
    cells.save(tmp_path / 'fcc.npz')
    with np.load(tmp_path / 'fcc.npz') as file:
        assert (file['neighbor_shifts'] == cells.neighbor_shifts.flat).all()
    assert pickle.loads(pickle.dumps(cells)).check() == []
    tilted = vorpipe.cells(np.random.default_rng(1).random((20, 3)), lattice=[[1, 0, 0], [100, 1, 0], [0, 100, 1]],
                           weights=np.linspace(0, 0.05, 20), check=True)
    assert tilted.volume_sum() == pytest.approx(1, abs=1e-12)
    for wrong, text in (({'lattice': [[1, 0, 0], [0, 1, 0]]}, 'lattice: shape'),
                        ({'lattice': [[1, 0, 0], [0, 1, 0], [1, 1, 0]]}, 'vectors that lie in a plane'),
                        ({'lattice': fcc, 'periodic': 'x'}, 'lattice: points that repeat by it'),
                        ({'lattice': fcc, 'domain': (0, 0, 0, 1, 1, 1)}, 'lattice: points that repeat by it')):
        with pytest.raises(vorpipe.InputError, match=text):
            vorpipe.cells([[0.5, 0.5, 0.5]], **wrong)
    with pytest.raises(vorpipe.InputError, match='^lattice: is of points in space'):
        vorpipe.cells([[0.5, 0.5]], lattice=fcc)
