"""What cells have to do with each other, as scipy and networkx take it: neighbors, derivatives, natural neighbors."""
import numpy as np
import pytest

import vorpipe

pytest.importorskip('scipy.sparse', reason='there is no scipy')
UNIT = (0, 0, 1, 1)
FORK = [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)]
LENGTH = 1e-5


def spread(random, count, box):
    """Points that keep some distance, so that a small step changes no neighbor."""
    points = vorpipe.generate('random', count, int(random.integers(1 << 30)), box)
    return np.array(vorpipe.relax(points, domain=box, iterations=3).sites)


KINDS = {'box': {'domain': UNIT}, 'outline': {'domain': FORK}, 'x': {'domain': UNIT, 'periodic': 'x'},
         'xy': {'domain': (1, 2, 3, 3), 'periodic': 'xy'}}


@pytest.fixture(params=list(KINDS))
def case(request, random):
    """Points, weights and where they have cells; of periods some points are given outside of the domain."""
    options = KINDS[request.param]
    box = (0, 0, 3, 3) if request.param == 'outline' else options['domain']
    points = spread(random, 40, box)
    if 'periodic' in options:
        points[::3] += (2 * (box[2] - box[0]), 0)
        points[1::7] -= (box[2] - box[0], 0)
    return points, random.random(40) * 1e-3, options


def test_adjacency_has_the_pairs_of_neighbors(case):
    points, weights, options = case
    diagram = vorpipe.cells(points, weights, **options)
    found, lengths = diagram.adjacency(), diagram.adjacency(lengths=True)
    assert found.format == 'csr' and found.shape == (40, 40) and abs(found - found.T).nnz == 0
    pairs = {(int(a), int(b)) for a, b in diagram.neighbor_pairs()}
    assert {(a, b) for a, b in zip(*(part.tolist() for part in found.nonzero())) if a <= b} == pairs
    assert set(found.data) == {1}
    within = np.bincount(np.repeat(np.arange(40), np.diff(diagram.cell_offsets)),
                         np.where(diagram.neighbors < 0, 0, diagram.edge_lengths), 40)
    assert np.allclose(lengths.sum(axis=1), within) and np.allclose((lengths - lengths.T).toarray(), 0, atol=1e-12)


def test_networkx_takes_it():
    networkx = pytest.importorskip('networkx', reason='there is no networkx')
    diagram = vorpipe.cells(vorpipe.generate('square', 16), domain=UNIT)
    graph = networkx.from_scipy_sparse_array(diagram.adjacency(lengths=True))
    assert networkx.is_connected(graph) and graph.number_of_edges() == len(diagram.neighbor_pairs()) == 24
    assert {round(length, 12) for _, _, length in graph.edges(data='weight')} == {0.25}


def test_scipy_walks_over_neighbors():
    from scipy.sparse.csgraph import shortest_path
    diagram = vorpipe.cells(vorpipe.generate('square', 100), domain=UNIT)
    order = np.lexsort(diagram.sites.T)
    assert shortest_path(diagram.adjacency(), unweighted=True, indices=order[0])[order[-1]] == 18


def test_derivatives_by_weights_are_differences_of_areas(case):
    points, weights, options = case
    found = vorpipe.cells(points, weights, **options).area_jacobian().toarray()
    assert np.abs(found - found.T).max() < 1e-9 * found.max() and np.abs(found.sum(axis=1)).max() < 1e-9 * found.max()
    for site in range(40):
        step = np.zeros(40)
        step[site] = LENGTH
        up, down = (vorpipe.cells(points, weights + sign * step, **options).areas for sign in (1, -1))
        assert np.allclose((up - down) / (2 * LENGTH), found[:, site], atol=1e-6 * found.max() + 1e-6), site


def test_derivatives_by_points_are_differences_of_areas(case):
    points, weights, options = case
    found = vorpipe.cells(points, weights, **options).area_jacobian(by='points').toarray()
    assert found.shape == (40, 80) and np.abs(found.sum(axis=0)).max() < 1e-9 * np.abs(found).max()
    for column in range(80):
        step = np.zeros(80)
        step[column] = LENGTH
        up, down = (vorpipe.cells(points + sign * step.reshape(40, 2), weights, **options).areas for sign in (1, -1))
        assert np.allclose((up - down) / (2 * LENGTH), found[:, column], atol=1e-6 * np.abs(found).max()), column


def test_derivatives_are_of_the_plane_where_points_are_in_degrees():
    degrees = np.random.default_rng(1).uniform((8, 48), (12, 52), (50, 2))
    diagram = vorpipe.cells(degrees, domain=(7, 47, 13, 53), project=(10, 50))
    found = diagram.area_jacobian().toarray()
    step = np.zeros(50)
    step[7] = 1
    up, down = (vorpipe.cells(degrees, sign * step, (7, 47, 13, 53), project=(10, 50)).areas for sign in (1, -1))
    assert np.allclose((up - down) / 2, found[:, 7], atol=1e-6)
    assert np.abs(diagram.area_jacobian(by='points').sum(axis=0)).max() < 1e-8


def test_what_has_no_derivative_is_refused():
    drops = vorpipe.transport(vorpipe.generate('random', 20), domain=UNIT, fill=0.5).cells()
    with pytest.raises(vorpipe.InputError, match='^surface: '):
        drops.area_jacobian()
    with pytest.raises(vorpipe.InputError, match="^by: 'areas' is neither"):
        vorpipe.cells([(0, 0), (1, 1)]).area_jacobian(by='areas')


@pytest.fixture(params=['random', 'lattice', 'circle', 'far'])
def sites(request, random):
    if request.param == 'lattice':
        return np.array([(x, y) for x in range(8) for y in range(8)], dtype=float)
    if request.param == 'circle':
        return vorpipe.generate('circle', 60)
    points = random.random((200, 2))
    return points * 1000 + (5e5, 5.5e6) if request.param == 'far' else points


def inside(points, random, count=500):
    """Places within the hull: means of some points."""
    shares = random.dirichlet(np.ones(5), count)
    return np.einsum('pk,pkc->pc', shares, points[random.integers(len(points), size=(count, 5))])


def test_natural_neighbors_reproduce_linear_functions(sites, random):
    places = inside(sites, random)
    weights = vorpipe.cells(sites).natural_neighbors(places)
    assert weights.format == 'csr' and weights.shape == (500, len(sites)) and weights.has_sorted_indices
    size = np.abs(places).max()
    assert np.abs(weights.sum(axis=1) - 1).max() < 1e-12 and weights.data.min() > 0
    assert np.abs(weights @ sites - places).max() < 1e-9 * max(size, 1)


def test_natural_neighbors_lose_what_the_cell_of_a_place_takes(sites, random):
    """Of the areas of the cells with and without it, where none of them reaches the domain's border."""
    low, high = sites.min(axis=0), sites.max(axis=0)
    size = max(high - low)
    domain = (*(low - 2 * size), *(high + 2 * size))
    places = inside(sites, random, 40)
    weights = vorpipe.cells(sites).natural_neighbors(places).toarray()
    before, compared = vorpipe.cells(sites, domain=domain), 0
    for place, found in zip(places, weights):
        after = vorpipe.cells(np.vstack((sites, place)), domain=domain)
        if (after[len(sites)].neighbors < 0).any():
            continue
        compared += 1
        assert np.allclose((before.areas - after.areas[:-1]) / after.areas[-1], found, atol=2e-6)
    assert compared > 20


def test_natural_neighbors_at_points_on_the_hull_and_beyond():
    sites = np.array([(x, y) for x in range(4) for y in range(4)], dtype=float)
    places = [(1, 2), (0, 0.25), (3, 3), (1.5, 0), (-0.1, 1), (np.nan, 0), (1e-14, 1.5)]
    weights = vorpipe.cells(sites).natural_neighbors(places).toarray()
    assert weights[0].tolist() == (np.arange(16) == 6).tolist()
    assert weights[1][:2].tolist() == [0.75, 0.25] and weights[2][15] == 1
    assert weights[3][[4, 8]].tolist() == [0.5, 0.5] and not weights[4:6].any()
    assert np.allclose(weights[6][[1, 2]], 0.5)
    turned = sites @ [[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]]
    along = (turned[0] * [[0.3], [0.7]] + turned[12] * [[0.7], [0.3]])
    found = vorpipe.cells(turned).natural_neighbors(along)
    assert np.allclose(found @ turned, along, atol=1e-12)


def test_interpolation_is_smooth_and_exact_for_linear_functions(random):
    sites = random.random((300, 2))
    diagram = vorpipe.cells(sites, attributes={'height': 2 * sites[:, 0] - sites[:, 1] + 3})
    places = inside(sites, random)
    expected = 2 * places[:, 0] - places[:, 1] + 3
    assert np.allclose(diagram.interpolate('height', places), expected, atol=1e-12)
    both = diagram.interpolate(np.column_stack((sites, diagram.attributes['height'])), [*places, (9, 9)])
    assert np.allclose(both[:-1], np.column_stack((places, expected)), atol=1e-12) and np.isnan(both[-1]).all()
    assert diagram.interpolate('@height', sites[:5]).tolist() == diagram.interpolate('height', sites[:5]).tolist()
    assert diagram.interpolate('height', sites[:5]).tolist() == diagram.attributes['height'][:5].tolist()
    with pytest.raises(vorpipe.InputError, match="^values: there is no attribute 'rain'; there are height"):
        diagram.interpolate('rain', places)
    with pytest.raises(vorpipe.InputError, match=r'^values: shape \(2,\)'):
        diagram.interpolate([1, 2], places)


def test_natural_neighbors_are_the_same_for_any_number_of_threads(random):
    sites, places = random.random((500, 2)), random.random((5000, 2))
    diagram = vorpipe.cells(sites)
    one, two = (diagram.natural_neighbors(places, threads) for threads in (1, 2))
    for part in ('data', 'indices', 'indptr'):
        assert getattr(one, part).tobytes() == getattr(two, part).tobytes()


def test_natural_neighbors_of_degrees_are_those_of_the_plane():
    degrees = np.random.default_rng(3).uniform((8, 48), (12, 52), (80, 2))
    diagram = vorpipe.cells(degrees, project=(10, 50))
    at_points = diagram.natural_neighbors(degrees).toarray()
    assert np.array_equal(at_points > 1e-9, np.eye(80, dtype=bool))
    weights = diagram.natural_neighbors([(10, 50)])
    plane = diagram._cells.input.points_in_plane
    assert np.abs(weights @ plane).max() < 1e-9


@pytest.mark.parametrize('options, message', [
    ({'weights': np.linspace(0, 0.1, 50)}, '^weights: natural neighbors are of points without'),
    ({'periodic': 'xy', 'domain': UNIT}, '^periodic: '), ({'detail': 'polygons'}, "^detail: .*detail='all'")])
def test_diagrams_without_natural_neighbors_are_refused(options, message):
    with pytest.raises(vorpipe.InputError, match=message):
        vorpipe.cells(vorpipe.generate('random', 50), **options).natural_neighbors([(0.5, 0.5)])


def test_points_on_a_line_have_no_natural_neighbors():
    weights = vorpipe.cells([(0, 0), (1, 1), (2, 2)]).natural_neighbors([(1, 1), (0.5, 0.5)])
    assert weights.shape == (2, 3) and weights.nnz == 0
