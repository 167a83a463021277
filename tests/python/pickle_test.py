"""Results that are copied, pickled, and sent from process to process."""
import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import vorpipe

UNIT = (0, 0, 1, 1)
FORK = [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)]
OF_DIAGRAMS = ['sites', 'weights', 'domain', 'crs', 'center', 'periodic', 'detail', 'status', 'owners', 'areas',
               'centroids', 'mass', 'mass_centroids', 'cell_offsets', 'neighbors', 'neighbor_shifts', 'ring_starts']
OF_REPORTS = ['backend', 'device', 'driver', 'ok', 'empty', 'duplicate', 'hidden', 'retried', 'in_double', 'exact',
              'pixels', 'time_ms', 'notes', 'validation_messages']
OF_TOPOLOGIES = ['vertices', 'vertex_of', 'edge_of', 'edge_vertices', 'edge_cells']
OF_KEYS = ['color', 'scale', 'range', 'ticks']
OF_POLYGONS = ['perimeters', 'second_moments', 'cell_vertices', 'edge_lengths']
OF_PICTURES = ['rgba', 'ids', 'status', 'owners', 'sites', 'domain', 'extent']
OF_RELAXED = ['sites', 'weights', 'energy', 'hexagonal', 'farthest', 'seconds', 'taken', 'end']
OF_TRANSPORTED = ['weights', 'masses', 'areas', 'centroids', 'cost', 'trace', 'end', 'surface']
PROTOCOLS = range(2, pickle.HIGHEST_PROTOCOL + 1)


def again(value, protocol=pickle.HIGHEST_PROTOCOL):
    return pickle.loads(pickle.dumps(value, protocol))


def out_of_band(value):
    """As libraries send large arrays: by buffers beside the pickle."""
    buffers = []
    stream = pickle.dumps(value, 5, buffer_callback=buffers.append)
    assert sum(buffer.raw().nbytes for buffer in buffers) > len(stream) or len(stream) < 10_000
    return pickle.loads(stream, buffers=[bytes(buffer.raw()) for buffer in buffers])


WAYS = [*(lambda value, protocol=protocol: again(value, protocol) for protocol in PROTOCOLS), out_of_band, copy.copy,
        copy.deepcopy]
NAMES = [*(f'protocol {protocol}' for protocol in PROTOCOLS), 'buffers', 'copy', 'deepcopy']


@pytest.fixture(params=WAYS, ids=NAMES)
def way(request):
    return request.param


def same(a, b, names):
    for name in names:
        first, second = getattr(a, name), getattr(b, name)
        assert type(first) is type(second), name
        if isinstance(first, np.ndarray) and first.dtype.names:
            assert first.dtype == second.dtype
            assert all(np.array_equal(first[field], second[field], equal_nan=True) for field in first.dtype.names)
        elif isinstance(first, np.ndarray):
            assert first.dtype == second.dtype and first.tobytes() == second.tobytes(), name
            assert not second.flags.writeable or first.flags.writeable, name
        else:
            assert first == second, name


KINDS = {
    'random': {}, 'measures': {'detail': 'measures'}, 'polygons': {'detail': 'polygons'},
    'periodic': {'domain': UNIT, 'periodic': 'xy'}, 'density': {'density': [[1, 2], [3, 4]]},
    'outline': {'domain': FORK}, 'weights': {'weights': np.linspace(0, 0.01, 200)},
    'degrees': {'project': 'auto', 'domain': (-1, -1, 2, 2)}, 'crs': {'crs': 'EPSG:25832'},
    'free': {'weights': np.full(200, 0.002), 'surface': 'free', 'domain': UNIT},
    'attributes': {'attributes': {'n': range(200), 'name': ['ü', None] * 100, 'part': [0.5, np.nan] * 100}}}


@pytest.mark.parametrize('kind', KINDS)
def test_a_diagram_comes_back_as_it_was(kind, way, random):
    points = random.random((200, 2))
    points[7] = points[3]
    diagram = vorpipe.cells(points, **KINDS[kind])
    copied = way(diagram)
    same(diagram, copied, OF_DIAGRAMS + (OF_POLYGONS if diagram.detail != 'measures' else []))
    same(diagram.report, copied.report, OF_REPORTS)
    assert repr(copied) == repr(diagram) and copied.area_sum() == diagram.area_sum()
    assert list(copied.attributes) == list(diagram.attributes)
    for name, values in diagram.attributes.items():
        assert np.array_equal(copied.attributes[name], values, equal_nan=values.dtype.kind == 'f')
    if kind != 'free':
        assert copied.check() == [] and vorpipe.compare(copied, diagram).agree
    if diagram.detail == 'all':
        assert np.array_equal(copied.triangles, diagram.triangles)
    if diagram.detail != 'measures':
        assert copied.to_bytes('.geojson') == diagram.to_bytes('.geojson')
    assert np.array_equal(copied.locate(points), diagram.locate(points))


def test_a_cell_brings_its_diagram(way):
    cell = vorpipe.cells([(0.2, 0.3), (0.7, 0.6)], domain=UNIT)[1]
    copied = way(cell)
    assert copied.site == 1 and copied.area == cell.area and np.array_equal(copied.vertices, cell.vertices)


@pytest.mark.parametrize('options', [
    {}, {'color': 'area', 'legend': True, 'edges': True, 'antialias': 2, 'size': (120, 80)}, {'domain': FORK, 'fit': 'letterbox'},
    {'weights': [0.1] * 50, 'color': 'weight', 'color_range': (0, 1), 'view': (0, 0, 0.5, 0.5)}])
def test_a_picture_comes_back_as_it_was(options, way, tmp_path):
    picture = vorpipe.render(vorpipe.generate('random', 50), **{'size': (60, 40), **options})
    copied = way(picture)
    same(picture, copied, OF_PICTURES)
    same(picture.report, copied.report, OF_REPORTS)
    assert copied.check() == [] and vorpipe.compare(picture, copied).equal == picture.ids.size
    assert (copied.key is None) == (picture.key is None)
    if picture.key is not None:
        same(picture.key, copied.key, OF_KEYS)
    for path in (tmp_path / 'a.tif', tmp_path / 'b.tif'):
        (picture if path.stem == 'a' else copied).save(path)
    assert (tmp_path / 'a.tif').read_bytes() == (tmp_path / 'b.tif').read_bytes()


def test_sites_come_back_as_they_were(way, tmp_path):
    (tmp_path / 'towns.csv').write_text('x,y,weight,name\n10,48.4,1,Ulm\n7.1,50.7,2,\n')
    for spec in (tmp_path / 'towns.csv', 'random:20'):
        sites = vorpipe.read(spec)
        copied = way(sites)
        same(sites, copied, ['points', 'weights', 'crs', 'skipped', 'notes'])
        assert repr(copied) == repr(sites) and vorpipe.cells(copied).domain == vorpipe.cells(sites).domain
        assert {name: values.tolist() for name, values in copied.attributes.items()} == {
            name: values.tolist() for name, values in sites.attributes.items()}


def test_what_has_moved_comes_back_as_it_was(way, tmp_path):
    points = vorpipe.generate('random', 50)
    relaxed = vorpipe.relax(points, iterations=3, domain=UNIT)
    copied = way(relaxed)
    same(relaxed, copied, OF_RELAXED)
    same(relaxed.report, copied.report, OF_REPORTS)
    copied.save(tmp_path / 'points.csv')
    assert np.array_equal(vorpipe.read(tmp_path / 'points.csv').points, relaxed.sites)


@pytest.mark.parametrize('options', [{}, {'fill': 0.5}])
def test_weights_for_masses_come_back_as_they_were(way, options):
    found = vorpipe.transport(vorpipe.generate('random', 50), domain=UNIT, **options)
    copied = way(found)
    same(found, copied, OF_TRANSPORTED)
    assert copied.converged and np.array_equal(copied.cells().areas, found.cells().areas)


def test_parts_of_results_come_back_as_they_were():
    diagram, steps = vorpipe.cells(vorpipe.generate('random', 50), domain=UNIT), []
    vorpipe.transport(diagram.sites, domain=UNIT, callback=steps.append)
    for take in (again, out_of_band, copy.deepcopy):
        same(diagram.topology(), take(diagram.topology()), OF_TOPOLOGIES)
        same(diagram.report, take(diagram.report), OF_REPORTS)
        assert take(steps[0]).worst == steps[0].worst and take(diagram.areas).tolist() == diagram.areas.tolist()


def test_results_that_share_an_input_still_do():
    found = vorpipe.transport(vorpipe.generate('random', 50), domain=UNIT)
    first, second = again([found.cells(), found.cells()])
    assert np.array_equal(first.areas, second.areas)
    one, other = again([found, found])
    assert one is other


def areas_of(seed):
    return vorpipe.cells(vorpipe.generate('random', 100, seed), domain=UNIT)


@pytest.mark.parametrize('start', ['fork', 'spawn'])
def test_diagrams_come_out_of_a_pool(start):
    if start not in multiprocessing.get_all_start_methods():
        pytest.skip(f'this system has no {start}')
    vorpipe.cells([(0, 0), (1, 1)])  # the parent has a session
    with multiprocessing.get_context(start).Pool(2) as pool:
        found = pool.map(areas_of, range(4))
        sums = pool.map(vorpipe.Diagram.area_sum, found)
    assert [len(diagram) for diagram in found] == [100] * 4 and sums == [diagram.area_sum() for diagram in found]
    assert all(np.array_equal(diagram.areas, areas_of(seed).areas) for seed, diagram in enumerate(found))


def test_a_pickle_of_another_version_names_it():
    cells = vorpipe.cells([(0.2, 0.3), (0.7, 0.6)])._cells
    version, state = cells.__getstate__()
    assert version == vorpipe.__version__
    input_version, given = state[0].__getstate__()
    for kind, other in ((type(cells), state[:2]), (type(state[0]), {**given, 'more': 1}),
                        (type(state[0]), {**given, 'sites': b'none'}),
                        (type(state[0]), {name: given[name] for name in given if name != 'notes'})):
        made = kind.__new__(kind)
        with pytest.raises(vorpipe.InputError, match='^pickle: vorpipe 0.0.7 made it, .*this, ' + vorpipe.__version__):
            made.__setstate__(('0.0.7', other))


def test_what_belongs_to_a_process_says_why_it_stays_there():
    with vorpipe.Session('cpu') as session, pytest.raises(TypeError, match='let each process open its own'):
        pickle.dumps(session)
    for take in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match=r'save\(path\) writes it'):
            take(vorpipe.Fluid('shear', particles=20))


def test_labels_go_along(way):
    pandas = pytest.importorskip('pandas', reason='there is no pandas')
    points = pandas.DataFrame({'x': [1, 2, 4], 'y': [1, 3, 2]}, index=['a', 'b', 'c'])
    for result in (vorpipe.cells(points), vorpipe.relax(points, iterations=1), vorpipe.transport(points)):
        found = way(result)
        assert (found if isinstance(found, vorpipe.Diagram) else found.cells()).index.tolist() == ['a', 'b', 'c']


def test_matrices_are_scipys_own(way):
    pytest.importorskip('scipy.sparse', reason='there is no scipy')
    diagram = vorpipe.cells(vorpipe.generate('random', 200))
    for matrix in (diagram.adjacency(), diagram.area_jacobian(), diagram.natural_neighbors([(0.5, 0.5)])):
        assert abs(way(matrix) - matrix).nnz == 0
