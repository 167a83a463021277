"""The classes of vorpipe.compat in the place of scipy.spatial's: what they take and refuse, and what takes them."""
import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import vorpipe
from vorpipe import compat
from vorpipe.compat import Delaunay, QhullError, Voronoi

spatial = pytest.importorskip('scipy.spatial', reason='there is no scipy')

from compat_patterns import GENERAL, agreed, away, disk, hexagons, lattice, random  # noqa: E402


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
