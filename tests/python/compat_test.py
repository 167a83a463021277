"""vorpipe.compat beside scipy.spatial, and on its own."""
import copy
import pickle
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

import vorpipe
from vorpipe import compat
from vorpipe.compat import Delaunay, QhullError, Voronoi

spatial = pytest.importorskip('scipy.spatial', reason='there is no scipy')


def random(rng):
    return rng.random((2000, 2))


def clusters(rng):
    return np.concatenate([rng.normal(rng.random(2), 10.0**-k, (300, 2)) for k in range(1, 5)])


def away(rng):
    return rng.random((1000, 2)) + [3, 50]


def disk(rng):
    return rng.normal(size=(1000, 2))


GENERAL = [random, clusters, away, disk]


def lattice(rng):
    return np.stack(np.meshgrid(np.arange(20.0), np.arange(15.0)), axis=-1).reshape(-1, 2)


def turned(rng):
    angle = rng.random()
    return lattice(rng) @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]


def hexagons(rng):
    return vorpipe.generate('hex', 400)


def circle(rng):
    angles = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    return np.column_stack((np.cos(angles), np.sin(angles)))


TIED = [lattice, turned, hexagons, circle]


@pytest.fixture
def rng(random):
    return random


def triangle_set(simplices):
    return {tuple(sorted(simplex)) for simplex in simplices.tolist()}


def ridges_of(voronoi):
    """Pairs of points to where their ridge ends; nothing for infinity."""
    return {tuple(sorted(pair)): sorted(tuple(voronoi.vertices[vertex]) for vertex in ends if vertex >= 0)
            for pair, ends in zip(voronoi.ridge_points.tolist(), voronoi.ridge_vertices)}


def in_circle(corners):
    """Exactly: above 0 where the last one lies inside the circle through the first three, counter-clockwise."""
    *three, last = [(Fraction(x), Fraction(y)) for x, y in corners.tolist()]
    (ax, ay), (bx, by), (cx, cy) = [(x - last[0], y - last[1]) for x, y in three]
    a, b, c = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    return a * (bx * cy - by * cx) - b * (ax * cy - ay * cx) + c * (ax * by - ay * bx)


def faults(triangulation, only):
    """Triangles among `only` in whose circle the far corner of a neighbor lies."""
    found = 0
    for triangle, adjacent in zip(triangulation.simplices.tolist(), triangulation.neighbors.tolist()):
        for other in adjacent if tuple(sorted(triangle)) in only else []:
            if other >= 0:
                far, = set(triangulation.simplices[other].tolist()) - set(triangle)
                found += in_circle(triangulation.points[[*triangle, far]]) > 0
    return found


def agreed(pattern, rng):
    """Points of a pattern of which scipy finds the Delaunay triangles, too: of a few in a hundred it does not."""
    for _ in range(100):
        points = pattern(rng)
        if triangle_set(Delaunay(points).simplices) == triangle_set(spatial.Delaunay(points).simplices):
            return points
    raise AssertionError('scipy never agrees')


@pytest.mark.parametrize('pattern', GENERAL)
def test_triangles_are_those_of_scipy_or_better(pattern, rng):
    points = pattern(rng)
    ours, theirs = Delaunay(points), spatial.Delaunay(points)
    our_triangles, their_triangles = triangle_set(ours.simplices), triangle_set(theirs.simplices)
    assert len(our_triangles - their_triangles) < 10
    assert faults(ours, our_triangles - their_triangles) == 0
    assert our_triangles == their_triangles or faults(theirs, their_triangles - our_triangles) > 0
    assert triangle_set(ours.convex_hull) == triangle_set(theirs.convex_hull)
    assert ours.simplices.dtype == theirs.simplices.dtype and ours.neighbors.dtype == theirs.neighbors.dtype


@pytest.mark.parametrize('pattern', GENERAL)
def test_ridges_are_those_of_scipy(pattern, rng):
    points = agreed(pattern, rng)
    ours, theirs = ridges_of(Voronoi(points)), ridges_of(spatial.Voronoi(points))
    assert ours.keys() == theirs.keys()
    size = np.ptp(points, axis=0).max()
    for pair, ends in ours.items():
        assert len(ends) == len(theirs[pair])
        for end, other in zip(ends, theirs[pair]):
            # Circles through points that are nearly on a line have their centers far away.
            assert np.allclose(end, other, rtol=1e-6, atol=1e-6 * size)


@pytest.mark.parametrize('pattern', TIED)
def test_points_on_one_circle_share_a_vertex(pattern, rng):
    points = pattern(rng)
    ours = Voronoi(points)
    apart = spatial.cKDTree(ours.vertices).query(ours.vertices, k=min(2, len(ours.vertices)))[0]
    assert len(ours.vertices) == 1 or apart[:, 1].min() > 1e-9
    inside = np.abs(ours.vertices - points.mean(axis=0)).max(axis=1) < 1e3
    distances = np.sort(spatial.cKDTree(points).query(ours.vertices[inside], k=3)[0], axis=1)
    assert np.allclose(distances[:, 0], distances[:, 2])


def test_a_lattice_has_the_ridges_of_scipy():
    points = lattice(None)
    ours, theirs = Voronoi(points), spatial.Voronoi(points)
    assert ridges_of(ours).keys() == ridges_of(theirs).keys()
    assert sorted(map(tuple, ours.vertices.tolist())) == sorted(map(tuple, theirs.vertices.tolist()))
    assert sorted(map(len, ours.regions)) == sorted(map(len, theirs.regions))


@pytest.mark.parametrize('pattern', GENERAL + [lattice, hexagons])
def test_regions_go_around_their_points(pattern, rng):
    points = agreed(pattern, rng) if pattern in GENERAL else pattern(rng)
    voronoi = Voronoi(points)
    theirs = spatial.Voronoi(points)
    for point in range(len(points)):
        region = voronoi.regions[voronoi.point_region[point]]
        if pattern in GENERAL:
            assert (-1 in region) == (-1 in theirs.regions[theirs.point_region[point]])
        if -1 in region:
            assert region[0] == -1 and region.count(-1) == 1
            continue
        x, y = (voronoi.vertices[region] - points[point]).T
        turns = x * np.roll(y, -1) - y * np.roll(x, -1)
        assert (turns > -1e-12 * (x**2 + y**2)).all()  # counter-clockwise, the point inside
    assert voronoi.regions[0] == [] and voronoi.point_region.min() == 1


def test_a_region_is_the_cell_of_a_large_domain(rng):
    points = rng.random((500, 2))
    voronoi, diagram = Voronoi(points), vorpipe.cells(points, domain=(-1e4, -1e4, 1e4, 1e4))
    for point, polygon in enumerate(diagram.polygons()):
        region = voronoi.regions[voronoi.point_region[point]]
        if -1 not in region and np.abs(polygon).max() < 1e3:
            x, y = (voronoi.vertices[region] - points[point]).T
            assert (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2 == pytest.approx(diagram.areas[point], rel=1e-6)


def test_ridge_dict_is_by_points(rng):
    voronoi = Voronoi(rng.random((50, 2)))
    for (p, q), ends in voronoi.ridge_dict.items():
        for vertex in ends:
            if vertex >= 0:
                to = np.linalg.norm(voronoi.points[[p, q]] - voronoi.vertices[vertex], axis=1)
                assert to[0] == pytest.approx(to[1], rel=1e-6)


@pytest.mark.parametrize('pattern', GENERAL + TIED)
def test_neighbors_are_opposite_to_corners(pattern, rng):
    triangulation = Delaunay(pattern(rng))
    triangles = triangulation.simplices
    for k in range(3):
        other = triangulation.neighbors[:, k]
        for t, o in zip(np.flatnonzero(other >= 0), other[other >= 0]):
            shared = set(triangles[t]) & set(triangles[o])
            assert len(shared) == 2 and triangles[t, k] not in shared
    corners = triangulation.points[triangles]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    assert (ax * by - ay * bx >= 0).all()  # counter-clockwise


@pytest.mark.parametrize('pattern', GENERAL)
def test_find_simplex_finds_what_scipy_finds(pattern, rng):
    points = agreed(pattern, rng)
    ours, theirs = Delaunay(points), spatial.Delaunay(points)
    low, high = points.min(axis=0), points.max(axis=0)
    places = low + rng.random((2000, 2)) * (high - low) * 1.2 - 0.1 * (high - low)
    found, expected = ours.find_simplex(places), theirs.find_simplex(places)
    assert np.array_equal(found < 0, expected < 0)
    inside = found >= 0
    assert np.array_equal(np.sort(ours.simplices[found[inside]]), np.sort(theirs.simplices[expected[inside]]))
    assert (ours.find_simplex(points) >= 0).all()


def test_find_simplex_keeps_the_shape_of_its_argument():
    triangulation = Delaunay([(0, 0), (1, 0), (0, 1)])
    assert triangulation.find_simplex((0.2, 0.2)) == 0 and triangulation.find_simplex((1, 1)) == -1
    assert triangulation.find_simplex(np.zeros((4, 5, 2))).shape == (4, 5)
    assert triangulation.find_simplex((np.nan, 0)) == -1
    assert triangulation.find_simplex((-1e-3, 0.5)) == -1 and triangulation.find_simplex((-1e-3, 0.5), tol=0.1) == 0
    with pytest.raises(ValueError):
        triangulation.find_simplex((1, 2, 3))


def test_transform_and_equations_are_those_of_scipy(rng):
    points = rng.random((100, 2))
    ours, theirs = Delaunay(points), spatial.Delaunay(points)
    order = {tuple(sorted(simplex)): k for k, simplex in enumerate(theirs.simplices.tolist())}
    for t, simplex in enumerate(ours.simplices.tolist()):
        place = points[simplex].mean(axis=0)
        inverse, last = ours.transform[t, :2], ours.transform[t, 2]
        assert np.allclose(inverse @ (place - last), 1 / 3)
        assert tuple(sorted(simplex)) in order
    assert (ours.equations[:, 2] < 0).all()
    assert np.allclose(np.linalg.norm(ours.equations[:, :3], axis=1), 1)
    # A point lies above the plane of the triangle that it is in, and of each other one's circle that holds it.
    assert (ours.plane_distance(points.mean(axis=0)) > -1e-12).sum() >= 1


def test_duplicates_are_coplanar(rng):
    points = rng.random((20, 2))
    triangulation = Delaunay(np.r_[points, points])
    assert triangulation.coplanar[:, 0].tolist() == list(range(20, 40))
    assert triangulation.coplanar[:, 2].tolist() == list(range(20))
    for point, simplex, corner in triangulation.coplanar:
        assert corner in triangulation.simplices[simplex]
    voronoi = Voronoi(np.r_[points, points])
    assert np.array_equal(voronoi.point_region[:20], voronoi.point_region[20:])


# Of these, a diagram has a tie that is triangulated the other way.
@pytest.mark.parametrize('seed', [1471, 3267, 3300, 3733])
def test_ties_of_cells_are_no_ties_of_triangles(seed):
    points = np.random.default_rng(seed).normal(size=(1000, 2))
    assert triangle_set(Delaunay(points).simplices) == triangle_set(spatial.Delaunay(points).simplices)


def test_a_square_has_two_triangles_and_one_vertex():
    square = [(0, 0), (0, 1), (1, 1), (1, 0)]
    triangulation, voronoi = Delaunay(square), Voronoi(square)
    assert triangle_set(triangulation.convex_hull) == {(0, 1), (1, 2), (2, 3), (0, 3)}
    assert sorted(triangulation.neighbors.ravel().tolist()) == [-1, -1, -1, -1, 0, 1]
    assert voronoi.vertices.tolist() == [[0.5, 0.5]]
    assert sorted(voronoi.ridge_vertices) == [[-1, 0]] * 4
    assert voronoi.regions == [[]] + [[-1, 0]] * 4


def test_nearly_flat_triangles_have_exact_centers():
    voronoi = Voronoi([(0, 0), (1, 1e-14), (2, 0), (1, 1)])
    far = voronoi.vertices[np.abs(voronoi.vertices[:, 1]).argmax()]
    assert far[0] == 1 and far[1] == pytest.approx(-5e13, rel=1e-14)


def test_points_nearly_on_a_circle_are_triangulated_as_they_lie():
    for away, expected in ((1e-8, {(0, 1, 3), (1, 2, 3)}), (-1e-8, {(0, 1, 2), (0, 2, 3)})):
        points = [(0, 0), (1, 0), (1 + away, 1 + away), (0, 1)]
        assert triangle_set(Delaunay(points).simplices) == expected
        assert len(Voronoi(points).vertices) == 2


def test_points_on_the_hull_but_for_a_last_digit_have_no_vertex_far_out():
    # The corner below is a hair lower than the two points beside it.
    points = [(-1, -1), (0, -1), (1, np.nextafter(-1, -2)), (0, 1)]
    voronoi = Voronoi(points)
    assert len(Delaunay(points).simplices) == 2 and len(vorpipe.cells(points).triangles) == 3
    assert np.abs(voronoi.vertices).max() < 10
    assert all(-1 in voronoi.regions[voronoi.point_region[point]] for point in range(4))
    assert {tuple(sorted(pair)) for pair in voronoi.ridge_points.tolist()} == {(0, 1), (1, 2), (0, 3), (1, 3), (2, 3)}
    # Nothing else holds these together.
    assert len(Delaunay([(0, 0), (1, 1e-17), (2, 0)]).simplices) == 1


@pytest.mark.parametrize('offset', [(2**20, -2**22), (3 * 2**25, 2**30)])
def test_far_from_the_origin_it_is_as_near_it(offset, rng):
    # Multiples of 2^-20, so that moved points are the same figure to the last digit.
    points = np.floor(rng.random((1000, 2)) * 2**20) / 2**20
    near, far = Delaunay(points), Delaunay(points + offset)
    assert triangle_set(near.simplices) == triangle_set(far.simplices)
    assert (far.find_simplex(points + offset) >= 0).all()


@pytest.mark.parametrize('kind', [Delaunay, Voronoi])
def test_what_is_not_for_the_plane_is_refused(kind):
    with pytest.raises(vorpipe.InputError, match='points: 3 dimensions: vorpipe.compat is for points in the plane'):
        kind(np.zeros((9, 3)))
    with pytest.raises(vorpipe.InputError, match='furthest_site: '):
        kind(np.zeros((9, 2)), furthest_site=True)
    for option in ('Qu', 'QV3', 'QG-2', 'Qb0:0', 'QB1:5', 'Pd0', 'Qfx'):
        with pytest.raises(vorpipe.InputError, match=f'qhull_options: {option} asks for another diagram'):
            kind(np.zeros((9, 2)), qhull_options=f'Qbb {option}')
    with pytest.raises(vorpipe.InputError, match='qhull_options: Qz is not for incremental'):
        kind(np.zeros((9, 2)), incremental=True, qhull_options='Qc Qz')
    with pytest.raises(QhullError, match='on a line'):
        kind([(0, 0), (1, 1), (2, 2), (3, 3)])
    with pytest.raises(RuntimeError, match='it takes three'):
        kind([(0, 0), (1, 1)])


@pytest.mark.parametrize('kind', [Delaunay, Voronoi])
def test_points_are_added_where_that_was_said(kind, rng):
    points = rng.random((30, 2))
    grown = kind(points[:10], incremental=True)
    grown.add_points(points[10:])
    assert np.array_equal(grown.points, points)
    whole = kind(points)
    if kind is Voronoi:
        theirs = spatial.Voronoi(points[:10], incremental=True)
        theirs.add_points(points[10:])
        # Without a region for the point at infinity before the others, as scipy has it.
        assert len(grown.regions) == len(theirs.regions) == 30 and whole.regions == [[], *grown.regions]
        assert np.array_equal(grown.point_region, np.arange(30)) and grown.ridge_dict == whole.ridge_dict
    else:
        assert np.array_equal(grown.simplices, whole.simplices)
    grown.close()
    with pytest.raises(RuntimeError):
        grown.add_points(points)


@pytest.mark.parametrize('kind', [Delaunay, Voronoi])
def test_points_that_make_no_triangle_are_refused_as_scipy_refuses_them(kind):
    theirs = getattr(spatial, kind.__name__)
    for points, error in ((np.empty((0, 2)), ValueError), ([(0, 0)], spatial.QhullError),
                          ([(0, 0), (1, 1), (2, 2)], spatial.QhullError), ([(0, 0), (1,)], ValueError),
                          ([(np.nan, 0), (1, 2), (3, 1)], ValueError), (np.zeros((5, 2)), spatial.QhullError)):
        for make in (kind, theirs):
            with pytest.raises(error):
                make(points)
    for points in ([], [1, 2, 3]):
        with pytest.raises(vorpipe.InputError, match='^points: '):
            kind(points)
    assert issubclass(QhullError, spatial.QhullError) and issubclass(QhullError, vorpipe.InputError)


@pytest.mark.parametrize('options', ['QJ', 'QJ Pp', 'QJ1e-8 Qbb', 'Qbb Qc Qz Q12 Qs', 'Qt Qx Q14', 'QbB C-0 A0.999 Tv'])
def test_options_that_are_about_rounding_change_nothing(options, rng):
    points = rng.random((50, 2))
    assert np.array_equal(Delaunay(points, qhull_options=options).simplices, Delaunay(points).simplices)
    assert np.array_equal(Voronoi(points, qhull_options=options).vertices, Voronoi(points).vertices)


def test_options_that_would_move_duplicates_are_told(rng):
    points = rng.random((10, 2))
    with pytest.warns(vorpipe.InputWarning, match='^qhull_options: QJ moves no points here: 10 that repeat others'):
        assert len(Delaunay(np.r_[points, points], qhull_options='QJ Qbb').coplanar) == 10


def test_they_are_instances_of_scipys(rng):
    points = rng.random((30, 2))
    assert isinstance(Delaunay(points), spatial.Delaunay) and isinstance(Voronoi(points), spatial.Voronoi)


@pytest.mark.parametrize('pattern', [random, away, disk, lattice, hexagons])
@pytest.mark.parametrize('name', ['LinearNDInterpolator', 'CloughTocher2DInterpolator'])
def test_scipys_interpolators_take_a_triangulation(name, pattern, rng):
    interpolator = getattr(pytest.importorskip('scipy.interpolate'), name)
    points = agreed(pattern, rng) if pattern in GENERAL else pattern(rng)
    low, high = points.min(axis=0), points.max(axis=0)
    places = low + rng.random((500, 2)) * (high - low) * 1.1
    # What is linear comes out whatever the triangles are.
    of_plane = interpolator(Delaunay(points), points @ [2, -3] + 1)(places)
    inside = Delaunay(points).find_simplex(places) >= 0
    assert np.array_equal(np.isfinite(of_plane), inside)
    assert np.allclose(of_plane[inside], places[inside] @ [2, -3] + 1, atol=1e-4 * (high - low).max())
    if pattern in GENERAL:
        values = np.sin(3 * points[:, 0]) * points[:, 1]
        ours, theirs = (interpolator(make(points), values)(places) for make in (Delaunay, spatial.Delaunay))
        assert np.allclose(ours, theirs, rtol=1e-6, atol=1e-6 * np.ptp(values), equal_nan=True)


def finite_polygons(voronoi, radius):
    """As scripts close regions at infinity: by ridges, midpoints and normals, with what scipy's classes have."""
    center = voronoi.points.mean(axis=0)
    ends_at = {}
    for (p, q), (v, w) in zip(voronoi.ridge_points, voronoi.ridge_vertices):
        ends_at.setdefault(p, []).append((q, v, w))
        ends_at.setdefault(q, []).append((p, v, w))
    vertices, polygons = voronoi.vertices.tolist(), []
    for p, region in enumerate(voronoi.point_region):
        ring = voronoi.regions[region]
        if all(vertex >= 0 for vertex in ring):
            polygons.append(np.asarray(vertices)[ring])
            continue
        new = [vertex for vertex in ring if vertex >= 0]
        for q, v, w in ends_at[p]:
            if w < 0:
                v, w = w, v
            if v >= 0:
                continue
            along = voronoi.points[q] - voronoi.points[p]
            normal = np.array([-along[1], along[0]]) / np.linalg.norm(along)
            outward = np.sign(np.dot(voronoi.points[[p, q]].mean(axis=0) - center, normal)) * normal
            new.append(len(vertices))
            vertices.append((voronoi.vertices[w] + outward * radius).tolist())
        corners = np.asarray([vertices[vertex] for vertex in new])
        x, y = (corners - corners.mean(axis=0)).T
        polygons.append(corners[np.argsort(np.arctan2(y, x))])
    return polygons


def test_scripts_that_close_regions_find_the_cells_of_a_box(rng):
    geometry = pytest.importorskip('shapely.geometry')
    points = rng.random((60, 2))
    areas = vorpipe.cells(points, domain=(0, 0, 1, 1)).areas
    box = geometry.box(0, 0, 1, 1)
    found = [geometry.Polygon(ring).intersection(box).area for ring in finite_polygons(Voronoi(points), 100)]
    theirs = [geometry.Polygon(ring).intersection(box).area for ring in finite_polygons(spatial.Voronoi(points), 100)]
    assert np.allclose(found, theirs) and np.allclose(found, areas, atol=1e-3)


def test_scripts_that_measure_regions_by_their_hull_find_their_areas(rng):
    from vorpipe.compat import ConvexHull, Voronoi

    points = rng.random((200, 2))
    voronoi, areas = Voronoi(points), vorpipe.cells(points, domain=(-1e3, -1e3, 1e3, 1e3)).areas
    for point, region in enumerate(voronoi.point_region):
        if -1 not in voronoi.regions[region]:
            corners = voronoi.vertices[voronoi.regions[region]]
            if np.abs(corners).max() < 1e3:
                assert ConvexHull(corners).volume == pytest.approx(areas[point], rel=1e-6)


def test_all_else_of_scipy_spatial_is_there_under_its_name():
    assert compat.ConvexHull is spatial.ConvexHull and compat.KDTree is spatial.KDTree
    assert compat.voronoi_plot_2d is spatial.voronoi_plot_2d and compat.Voronoi is not spatial.Voronoi
    with pytest.raises(AttributeError, match='neither vorpipe.compat nor scipy.spatial has Verone'):
        compat.Verone
    with pytest.raises(ImportError):
        from vorpipe.compat import delauney_plot_2d  # noqa: F401


def test_without_scipy_the_classes_are_there_and_its_plots_are_not():
    program = """
import sys
sys.modules['scipy'] = sys.modules['scipy.spatial'] = None
from vorpipe.compat import Delaunay, QhullError, Voronoi
assert len(Delaunay([(0, 0), (1, 0), (0, 1)]).simplices) == len(Voronoi([(0, 0), (1, 0), (0, 1)]).vertices) == 1
try:
    Delaunay([(0, 0)])
except RuntimeError as error:
    assert isinstance(error, QhullError)
from vorpipe import compat
try:
    compat.voronoi_plot_2d
except AttributeError as error:
    print(error)
"""
    told = subprocess.run([sys.executable, '-B', '-c', program], capture_output=True, text=True)
    assert told.stdout.startswith('vorpipe.compat has no voronoi_plot_2d; what it takes'), told.stderr


@pytest.mark.parametrize('kind', [Delaunay, Voronoi])
def test_they_come_out_of_pickles_as_they_were(kind, rng):
    made = kind(rng.random((50, 2)))
    for again in (pickle.loads(pickle.dumps(made)), copy.deepcopy(made), copy.copy(made)):
        assert np.array_equal(again.points, made.points)
        if kind is Voronoi:
            assert again.regions == made.regions and np.array_equal(again.vertices, made.vertices)
        else:
            assert np.array_equal(again.find_simplex(made.points), made.find_simplex(made.points))


def test_scipys_own_plots_draw_them(rng):
    pyplot = pytest.importorskip('matplotlib.pyplot')
    points = rng.random((30, 2))
    from vorpipe.compat import convex_hull_plot_2d, delaunay_plot_2d, voronoi_plot_2d

    assert len(voronoi_plot_2d(Voronoi(points), show_vertices=False).axes) == 1
    assert len(delaunay_plot_2d(Delaunay(points)).axes) == 1
    assert len(convex_hull_plot_2d(spatial.ConvexHull(points)).axes) == 1
    pyplot.close('all')
