"""What vorpipe.compat computes, beside scipy.spatial and on its own."""
import numpy as np
import pytest

import vorpipe
from vorpipe.compat import Delaunay, Voronoi

spatial = pytest.importorskip('scipy.spatial', reason='there is no scipy')

from compat_patterns import (GENERAL, TIED, agreed, faults, hexagons, lattice, ridges_of,  # noqa: E402
                             triangle_set)


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
    assert ours.good.dtype == theirs.good.dtype and len(ours.good) == ours.nsimplex and theirs.good.all() and ours.good.all()


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
