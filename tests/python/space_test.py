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


@pytest.mark.parametrize('name, value', [('weights', [1, 2, 3, 4]), ('periodic', 'xy'), ('globe', True),
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
