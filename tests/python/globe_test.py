"""Cells of the whole Earth."""
import json
import os
import pickle
import subprocess
import time

import numpy as np
import pytest

import vorpipe
from vorpipe import compat

EARTH = 510065621.7240887  # km2


def on_sphere(random, count):
    """Unit vectors."""
    ways = random.standard_normal((count, 3))
    return ways / np.linalg.norm(ways, axis=1)[:, None]


def degrees_of(ways):
    x, y, z = np.asarray(ways).T
    return np.degrees(np.column_stack((np.arctan2(y, x), np.arctan2(z, np.hypot(x, y)))))


@pytest.fixture
def places(random):
    return degrees_of(on_sphere(random, 500))


def test_cells_cover_the_earth(places):
    diagram = vorpipe.cells(places, globe=True, check=True)
    assert diagram.globe and diagram.crs == 'EPSG:4326' and diagram.domain == (-180, -90, 180, 90)
    assert diagram.solid_angles.sum() == pytest.approx(4 * np.pi, rel=1e-12)
    assert diagram.area_sum() == pytest.approx(EARTH, rel=1e-12)
    assert diagram.check() == [] and diagram.adjacency().sum() == 2 * len(diagram.neighbor_pairs())
    assert np.array_equal(diagram.sites, places)
    with vorpipe.Session('cpu') as session:
        assert np.array_equal(session.cells(places, globe=True).cell_vertices, diagram.cell_vertices)
    # The numbers of triangles and of cells are Euler's.
    assert diagram.triangles.shape == (2 * len(places) - 4, 3)


def test_areas_are_those_of_scipy(random):
    spatial = pytest.importorskip('scipy.spatial')
    ways = on_sphere(random, 20000)
    diagram = vorpipe.cells(degrees_of(ways), globe=True)
    theirs = spatial.SphericalVoronoi(ways)
    assert np.abs(diagram.solid_angles - theirs.calculate_areas()).max() < 1e-12
    edges = np.concatenate([theirs._simplices[:, sides] for sides in ([0, 1], [1, 2], [2, 0])])
    assert np.array_equal(diagram.neighbor_pairs(), np.unique(np.sort(edges, axis=1), axis=0))


@pytest.mark.parametrize('points', [
    None, [(0, 90), (0, -90), (20, 10), (-150, 5), (100, -40)], [(10, 20)], [(10, 20), (200, -10)],
    [(x, y) for x in range(-180, 180, 30) for y in range(-90, 91, 30)]])
def test_polygons_are_valid_and_fill_the_map(places, points, tmp_path):
    """As GDAL and GEOS read them."""
    geopandas, shapely = pytest.importorskip('geopandas'), pytest.importorskip('shapely.ops')
    diagram = vorpipe.cells(places if points is None else points, globe=True)
    frame = diagram.to_geopandas()
    assert frame.crs == 'EPSG:4326'
    for kind in ('geojson', 'gpkg'):
        diagram.save(tmp_path / f'cells.{kind}')
        read = geopandas.read_file(tmp_path / f'cells.{kind}')
        cells = read.geometry[diagram.status == 0]
        assert cells.is_valid.all() and not cells.is_empty.any() and read.crs == 'EPSG:4326'
        areas = np.array([cell.area for cell in cells])
        assert areas.sum() == pytest.approx(360 * 180, rel=1e-9)
        assert shapely.unary_union(list(cells)).area == pytest.approx(360 * 180, rel=1e-9)
        assert all(a.equals(b) for a, b in zip(cells, frame.geometry[diagram.status == 0]))
    diagram.save_edges(tmp_path / 'edges.gpkg')
    if len(diagram.neighbors):
        lines = geopandas.read_file(tmp_path / 'edges.gpkg').geometry
        assert len(lines) == len(diagram.neighbors) // 2 and lines.is_valid.all()
        assert np.abs(lines.bounds.to_numpy()).max() <= 180


def test_areas_are_those_of_proj(places):
    """PROJ has geodesics of the ellipsoid between points, which great circles leave by centimeters."""
    pyproj = pytest.importorskip('pyproj')
    pytest.importorskip('geopandas')
    ellipsoid = pyproj.Geod(ellps='WGS84')
    frame = vorpipe.cells(places, globe=True).to_geopandas()
    areas = np.array([ellipsoid.geometry_area_perimeter(cell)[0] for cell in frame.geometry]) / 1e6
    assert np.abs(areas / frame['area'] - 1).max() < 1e-6
    assert areas.sum() == pytest.approx(EARTH, rel=1e-12)


def finely(begin, end, step):
    """Points of a great circle, from its begin, at most a step of radians apart."""
    axis = np.cross(begin, end)
    angle = np.arctan2(np.linalg.norm(axis), begin @ end)
    turns = np.linspace(0, angle, max(1, int(np.ceil(angle / step))), endpoint=False)[:, None]
    return np.cos(turns) * begin + np.sin(turns) * np.cross(axis / np.linalg.norm(axis), begin)


@pytest.mark.parametrize('kind', ['random', 'track', 'clusters', 'lattice', 'caps'])
def test_areas_of_all_cells_are_those_of_proj_between_near_points(kind, random):
    """Of thin cells too: on the way to an edge's next point, 0.02 degrees, a geodesic is within a millimeter."""
    pyproj = pytest.importorskip('pyproj')
    ellipsoid = pyproj.Geod(ellps='WGS84')
    sites, weights = degrees_of(on_sphere(random, 60)), None
    if kind == 'track':  # of a ship, across which cells are long
        sites = np.column_stack((np.linspace(-40, -30, 80), np.linspace(20, 45, 80) + random.normal(0, 1e-4, 80)))
    elif kind == 'clusters':
        near = [middle + random.normal(0, .01, (40, 2)) for middle in ((20, 50), (-100, -3))]
        sites = np.concatenate((*near, sites[:20]))
    elif kind == 'lattice':
        sites = np.array([(x, y) for x in range(-180, 180, 30) for y in range(-75, 76, 30)])
    elif kind == 'caps':
        weights = random.uniform(0, 1e6, len(sites))
    diagram = vorpipe.cells(sites, weights=weights, globe=True)
    longest = 0.02
    for cell in np.flatnonzero(diagram.status == 0):
        corners = np.column_stack(unit_of(diagram.cell_vertices[slice(*diagram.cell_offsets[cell:cell + 2])]))
        ways = zip(corners, np.roll(corners, -1, axis=0))
        border = degrees_of(np.concatenate([finely(*ends, np.radians(longest)) for ends in ways]))
        area = ellipsoid.polygon_area_perimeter(*border.T)[0] / 1e6
        assert area == pytest.approx(diagram.areas[cell], rel=1e-6), cell


def test_places_are_in_the_cell_that_holds_them(places, random):
    diagram = vorpipe.cells(places, globe=True)
    assert np.array_equal(diagram.locate(places), np.arange(len(places)))
    ways = on_sphere(random, 2000)
    nearest = (ways @ np.column_stack(unit_of(places)).T).argmax(axis=1)
    assert np.array_equal(diagram.locate(degrees_of(ways)), nearest)
    assert diagram.locate((0, 95)) == vorpipe.NO_SITE


# Two islands, one across 180 degrees, and a square with a hole.
ISLANDS = {'type': 'MultiPolygon', 'coordinates': [
    [[[170, -20], [190, -20], [190, -5], [170, -5], [170, -20]]],
    [[[10, 10], [40, 10], [40, 35], [10, 35], [10, 10]], [[20, 20], [20, 25], [25, 25], [25, 20], [20, 20]]]]}


@pytest.fixture
def islands():
    return pytest.importorskip('shapely.geometry').shape(ISLANDS)


def test_places_in_an_outline_are_in_the_polygon_that_holds_them(places, islands, random):
    """As GEOS says."""
    pytest.importorskip('geopandas')
    geometry = pytest.importorskip('shapely.geometry')
    diagram = vorpipe.cells(places, domain=islands, globe=True, check=True)
    frame = diagram.to_geopandas()
    asked = np.column_stack((random.uniform(-180, 180, 4000), random.uniform(-25, 40, 4000)))
    asked = np.concatenate((asked, [(lon, lat) for lon in (-179.5, 180, 539.5, 15, 22) for lat in (-10, 22)]))
    found, seen = diagram.locate(asked), 0
    for place, site in zip(asked, found):
        point = geometry.Point((place[0] + 180) % 360 - 180, place[1])
        if site == vorpipe.NO_SITE:
            assert not islands.buffer(-0.001).contains(point)
        else:
            seen += 1
            assert frame.geometry[site].distance(point) < 0.001
    assert seen > 100 and diagram.locate((22, 22)) == vorpipe.NO_SITE


@pytest.mark.parametrize('count', [1, 5, 500])
def test_meshes_in_an_outline_have_its_cells(islands, random, count, tmp_path):
    diagram = vorpipe.cells(degrees_of(on_sphere(random, count)), domain=islands, globe=True)
    diagram.save(tmp_path / 'cells.obj')
    points, faces = faces_of(tmp_path / 'cells.obj')
    assert np.linalg.norm(points, axis=1) == pytest.approx(1, abs=1e-12)
    sides = [(face[k - 1], face[k]) for face in faces for k in range(len(face))]
    assert len(set(sides)) == len(sides), 'faces overlap'
    assert max(np.degrees(np.arccos(points[a] @ points[b])) for a, b in sides) < 10.2
    triangles = np.array([(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)])
    a, b, c = (points[triangles[:, k]] for k in range(3))
    dots = np.einsum('ij,ij->i', a, np.cross(b, c)), 1 + sum(np.einsum('ij,ij->i', *two) for two in ((a, b), (b, c), (c, a)))
    assert 2 * np.arctan2(*dots).sum() == pytest.approx(diagram.solid_angles.sum(), rel=1e-9)
    # The borders of two islands, one with a hole, are what is left open: rings without branches.
    open_sides = [side for side in sides if side[::-1] not in set(sides)]
    assert len({side[0] for side in open_sides}) == len(open_sides)
    for kind in ('vtp', 'vtu', 'vtk', 'ply'):
        diagram.save(tmp_path / f'cells.{kind}')


def test_pictures_are_those_of_the_program(places, islands, tmp_path):
    """Pixels and shapes."""
    np.save(tmp_path / 'places.npy', places)
    (tmp_path / 'islands.geojson').write_text(json.dumps(ISLANDS))
    for options, words in (({}, []), ({'map': 'equal-earth', 'domain': islands}, ['--map', 'equal-earth', '--domain',
                                                                                tmp_path / 'islands.geojson']),
                           ({'view_from': (20, 30), 'edges': True, 'antialias': 2, 'graticule': 15, 'color': 'area', 'legend': 'beside'},
                            ['--view-from', '20,30', '--edges', '--antialias', '2', '--graticule', '15', '--color', 'area', '--legend', 'beside'])):
        picture = vorpipe.render(places, globe=True, size=200, check=True, backend='cpu', **options)
        subprocess.run([os.environ['VORPIPE_PROGRAM'], 'render', '--globe', '--sites', tmp_path / 'places.npy', '--quiet', '--size', '200',
                        '--backend', 'cpu', *words, '-o', tmp_path / 'p.png', '-o', tmp_path / 'p.svg', '--ids', tmp_path / 'p.npy'], check=True)
        assert np.array_equal(picture.ids, np.load(tmp_path / 'p.npy'))
        picture.save(tmp_path / 'q.png')
        assert (tmp_path / 'q.png').read_bytes() == (tmp_path / 'p.png').read_bytes()
        vorpipe.draw(places, tmp_path / 'q.svg', globe=True, size=200, backend='cpu', **options)
        assert (tmp_path / 'q.svg').read_bytes() == (tmp_path / 'p.svg').read_bytes()
        again = pickle.loads(pickle.dumps(picture))
        assert again.check() == [] and np.array_equal(again.rgba, picture.rgba) and again.extent == picture.extent
    assert 'km\u00b2' in (tmp_path / 'q.svg').read_text()


@pytest.mark.parametrize('arguments, message', [
    ({'globe': True, 'fit': 'stretch'}, '^fit: is for a plane'), ({'map': 'equal-earth'}, '^map: is for the globe'),
    ({'view_from': (1, 2)}, '^view_from: is for the globe'), ({'globe': True, 'map': 'mercator'}, "^map: 'mercator' is none of"),
    ({'globe': True, 'map': 'equal-earth', 'view_from': (1, 2)}, '^map: view_from is'), ({'graticule': 30}, '^graticule: '),
    ({'globe': True, 'graticule': 91}, '^graticule.* 90'), ({'globe': True, 'view_from': (1, 92)}, 'no place')])
def test_pictures_refuse_what_contradicts(places, arguments, message):
    with pytest.raises(vorpipe.InputError, match=message):
        vorpipe.render(places, **arguments)


def test_relaxed_places_are_those_of_the_program(places, tmp_path):
    np.save(tmp_path / 'places.npy', places)
    relaxed = vorpipe.relax(places, globe=True, iterations=10, backend='cpu')
    subprocess.run([os.environ['VORPIPE_PROGRAM'], 'relax', '--globe', '--sites', tmp_path / 'places.npy', '--iterations', '10', '--quiet',
                    '--backend', 'cpu', '-o', tmp_path / 'moved.npy'], check=True)
    assert np.array_equal(relaxed.sites, np.load(tmp_path / 'moved.npy'))
    assert relaxed.hexagonal[-1] < 1.1 < relaxed.hexagonal[0] and np.abs(relaxed.sites[:, 0]).max() <= 180
    assert relaxed.cells().area_sum() == pytest.approx(EARTH, rel=1e-12)
    for options, message in (({'domain': (0, 0, 1, 1)}, '^domain: '), ({'equal_masses': True, 'density': np.ones((2, 2))}, '^equal_masses: ')):
        with pytest.raises(vorpipe.InputError, match=message):
            vorpipe.relax(places, globe=True, **options)


def unit_of(places):
    longitude, latitude = np.radians(places).T
    return np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)


def test_weights_are_squared_radii_in_kilometers():
    diagram = vorpipe.cells([(0, 0), (90, 0), (180, 0), (-90, 0), (0, 90), (0, -90)], globe=True,
                            weights=[4e6, 0, 0, 0, 0, 0], check=True)
    assert diagram.areas[0] > 1.05 * diagram.areas[2]
    with pytest.raises(vorpipe.InputError, match='^weights: site 0: weight 200000000'):
        vorpipe.cells([(0, 0), (1, 1)], weights=[2e8, 0], globe=True)


@pytest.mark.parametrize('arguments, message', [
    ({'project': 'auto'}, '^globe: is '), ({'margin': 1}, '^(globe|margin): '), ({'search': 'flann'}, 'not on the globe'),
    ({'density': np.ones((2, 2))}, 'not for the globe'), ({'surface': 'free', 'weights': [1, 1]}, '^surface: ')])
def test_what_is_of_a_plane_is_refused(arguments, message):
    with pytest.raises(vorpipe.InputError, match=message):
        vorpipe.cells([(0, 0), (10, 10)], globe=True, **arguments)


def test_what_cells_of_a_plane_have_is_refused(places):
    diagram = vorpipe.cells(places, globe=True)
    for read in (lambda: diagram.second_moments, diagram.triangle_mesh, diagram.area_jacobian,
                 lambda: diagram.natural_neighbors(places), lambda: diagram.interpolate(np.ones(len(places)), places)):
        with pytest.raises(vorpipe.InputError, match='^globe: .* of cells in a plane'):
            read()
    with pytest.raises(vorpipe.InputError, match='latitude'):
        vorpipe.cells([(0, 100)], globe=True)
    assert len(vorpipe.cells(places[:5]).solid_angles) == 0


def test_files_pickles_and_plots_have_the_globe(places, tmp_path):
    diagram = vorpipe.cells(places, globe=True, attributes={'name': [f'n{k}' for k in range(len(places))]})
    again = pickle.loads(pickle.dumps(diagram))
    assert again.globe and np.array_equal(again.solid_angles, diagram.solid_angles)
    assert again.to_bytes('.geojson') == diagram.to_bytes('.geojson')
    diagram.save(tmp_path / 'cells.npz')
    with np.load(tmp_path / 'cells.npz') as saved:
        assert np.array_equal(saved['solid_angles'], diagram.solid_angles) and 'second_moments' not in saved
    for kind in ('csv', 'gpkg', 'vtp', 'vtu', 'vtk', 'obj', 'ply', 'svg', 'wkt', 'geojsonl'):
        diagram.save(tmp_path / f'cells.{kind}')
    diagram.save_edges(tmp_path / 'edges.gpkg')
    assert '<svg' in diagram._repr_svg_() and diagram._repr_png_() is None
    pytest.importorskip('matplotlib')
    assert diagram.plot(show_sites=True).get_xlim() == (-180, 180)


def faces_of(path):
    """The points and faces of an .obj file."""
    points, faces = [], []
    for line in path.read_text().splitlines():
        kind, *rest = line.split()
        if kind == 'v':
            points.append([float(number) for number in rest])
        elif kind == 'f':
            faces.append([int(number) - 1 for number in rest])
    return np.array(points), faces


@pytest.mark.parametrize('count', [1, 2, 3, 5, 60, 3000])
def test_meshes_close_around_the_sphere(random, count, tmp_path):
    diagram = vorpipe.cells(degrees_of(on_sphere(random, count)), globe=True)
    diagram.save(tmp_path / 'cells.obj')
    points, faces = faces_of(tmp_path / 'cells.obj')
    assert np.linalg.norm(points, axis=1) == pytest.approx(1, abs=1e-12)
    sides = [(face[k - 1], face[k]) for face in faces for k in range(len(face))]
    # Each side once in either direction: nothing is open. Euler's formula: it is a sphere.
    assert len(set(sides)) == len(sides) and {(b, a) for a, b in sides} == set(sides)
    assert len(points) - len(sides) // 2 + len(faces) == 2
    volume = sum(np.dot(points[face[0]], np.cross(points[face[k]], points[face[k + 1]]))
                 for face in faces for k in range(1, len(face) - 1)) / 6
    assert volume == pytest.approx(4 / 3 * np.pi, rel=0.02)


def test_a_session_of_any_backend_has_the_same(places):
    expected = vorpipe.cells(places, globe=True, backend='cpu')
    for backend in os.environ.get('VORPIPE_EXPECTED_BACKENDS', 'cpu').split(','):
        assert np.array_equal(vorpipe.cells(places, globe=True, backend=backend).cell_vertices, expected.cell_vertices)


def test_the_program_has_the_same(places, tmp_path):
    np.save(tmp_path / 'places.npy', places)
    subprocess.run([os.environ['VORPIPE_PROGRAM'], 'cells', '--globe', '--sites', tmp_path / 'places.npy', '--quiet',
                    '-o', tmp_path / 'cells.npz'], check=True)
    with np.load(tmp_path / 'cells.npz') as saved:
        assert np.array_equal(saved['areas'], vorpipe.cells(places, globe=True).areas)


# vorpipe.compat

def test_the_compatible_class_has_scipys_attributes(random):
    spatial = pytest.importorskip('scipy.spatial')
    center = np.array([1.0, 2, 3])
    ways = 2 * on_sphere(random, 200) + center
    ours, theirs = compat.SphericalVoronoi(ways, 2, center), spatial.SphericalVoronoi(ways, 2, center)
    assert isinstance(ours, spatial.SphericalVoronoi)
    assert ours.radius == 2 and np.array_equal(ours.center, center) and np.array_equal(ours.points, ways)
    assert ours.vertices.shape == theirs.vertices.shape
    ours.sort_vertices_of_regions()
    theirs.sort_vertices_of_regions()
    assert np.abs(ours.calculate_areas() - theirs.calculate_areas()).max() < 1e-11
    for mine, other in zip(ours.regions, theirs.regions):
        assert np.allclose(np.sort(ours.vertices[mine], axis=0), np.sort(theirs.vertices[other], axis=0))
        # Counter-clockwise seen from outside.
        a, b, c = ours.vertices[mine[:3]] - center
        assert np.dot(np.cross(b - a, c - b), a) > 0


@pytest.mark.parametrize('points, arguments, message', [
    (np.eye(3), {}, 'Rank of input points must be at least 3'),
    ([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 1]], {}, 'Duplicate generators present'),
    (2 * np.concatenate((np.eye(3), -np.eye(3))), {}, 'Radius inconsistent with generators'),
    (np.concatenate((np.eye(3), -np.eye(3))), {'radius': None}, '`radius` is `None`'),
    (np.eye(4), {}, r'shape \(4, 4\)'), ([[np.nan, 0, 0]] * 5, {}, '')])
def test_the_compatible_class_refuses_what_scipy_does(points, arguments, message):
    with pytest.raises((ValueError, np.linalg.LinAlgError), match=message):
        compat.SphericalVoronoi(points, **arguments)


def test_it_is_many_times_as_fast_as_scipy(random):
    """15 times and more with areas where nothing else runs; half of that is asked of a busy machine."""
    spatial = pytest.importorskip('scipy.spatial')
    ways = on_sphere(random, 50000)

    def seconds(run):
        begin = time.process_time()
        run()
        return time.process_time() - begin

    theirs = seconds(lambda: spatial.SphericalVoronoi(ways).calculate_areas())
    ours = min(seconds(lambda: compat.SphericalVoronoi(ways).calculate_areas()) for _ in range(3))
    assert theirs > 4 * ours, (theirs, ours)
