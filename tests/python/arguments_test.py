"""What is taken, and what is refused with the argument's name."""
import inspect
import json
import pickle
import types

import numpy as np
import pytest

import vorpipe

POINTS = np.array([[0.2, 0.3], [0.7, 0.6], [0.4, 0.9]])


@pytest.mark.parametrize('points', [
    POINTS.tolist(), [tuple(point) for point in POINTS], np.asfortranarray(POINTS), np.repeat(POINTS, 2, axis=0)[::2],
    np.column_stack((POINTS, POINTS))[:, :2], POINTS[::-1].copy()[::-1], POINTS.astype('>f8')])
def test_any_array_like_gives_the_same_cells(points):
    assert np.array_equal(vorpipe.cells(points).cell_vertices, vorpipe.cells(POINTS).cell_vertices)


def test_other_types_are_taken_as_the_numbers_that_they_are():
    single = POINTS.astype(np.float32)
    assert np.array_equal(vorpipe.cells(single).sites, single.astype(np.float64))
    assert vorpipe.cells(np.array([[0, 0], [2, 1]], dtype=np.uint8)).sites.tolist() == [[0, 0], [2, 1]]


@pytest.mark.parametrize('kind', [np.int64, np.int32, np.uint8, bool, np.float32, object])
def test_every_array_may_be_of_integers_and_booleans(kind):
    points, ones = np.array([[0, 0], [1, 0], [0, 1]], dtype=kind), np.array([1, 1, 1], dtype=kind)
    box, even = np.array([0, 0, 1, 1], dtype=kind), np.ones((2, 2), dtype=kind)
    diagram = vorpipe.cells(points, ones, np.array([(0, 0), (1, 0), (1, 1)], dtype=kind), density=even)
    assert diagram.mass.sum() == pytest.approx(0.5) and diagram.weights.tolist() == [1, 1, 1]
    assert vorpipe.cells(points, domain=box).locate(np.array([[1, 0]], dtype=kind)).tolist() == [1]
    assert vorpipe.transport(points, masses=ones, domain=box, normalize=True).areas == pytest.approx(1 / 3)
    assert len(vorpipe.relax(points, density=even, domain=box, iterations=1).sites) == 3
    still = vorpipe.Fluid(points, np.zeros((3, 2), dtype=kind), densities=ones, domain=box, gravity=(0, 0))
    assert len(still) == 3 and len(vorpipe.drawn_points(even, 5)) == 5


def test_a_masked_array_of_which_nothing_is_masked_is_an_array():
    masked = np.ma.masked_invalid(POINTS)
    diagram = vorpipe.cells(masked, np.ma.array([0, 0, 0]))
    assert np.array_equal(diagram.cell_vertices, vorpipe.cells(POINTS).cell_vertices)


def test_points_are_not_changed():
    points = POINTS.copy()
    vorpipe.cells(points, domain=(0, 0, 1, 1), periodic='xy')
    assert np.array_equal(points, POINTS)


WRONG = [
    ('points', 'there are none', {'points': []}),
    ('points', 'there are none', {'points': np.empty((0, 2))}),
    ('points', r'shape \(3, 4\), must be \(N, 2\)', {'points': np.zeros((3, 4))}),
    ('points', r'shape \(2,\), must be \(N, 2\)', {'points': [1, 2]}),
    ('points', 'point 1 is not finite: nan, 1', {'points': [[0, 0], [np.nan, 1]]}),
    ('points', 'point 1 is not finite: 2, nan, 1', {'points': [[0, 0, 0], [2, np.nan, 1]]}),
    ('points', 'point 0 is not finite: 0, inf', {'points': [[0, np.inf], [1, 1]]}),
    ('points', 'expected numbers', {'points': [['a', 'b']]}),
    ('points', 'expected numbers', {'points': [[1j, 0]]}),
    ('points', 'some elements are masked', {'points': np.ma.masked_all((3, 2))}),
    ('points', 'expected numbers in rows of one length', {'points': [[0, 0], [1]]}),
    ('points', 'point 0 is not finite: 0, nan', {'points': [[0, None], [1, 1]]}),
    ('weights', "'a.png' is a path: read_weights reads them.*save", {'weights': 'a.png'}),
    ('weights', 'expected numbers in rows of one length', {'weights': [1, [2, 3], 4]}),
    ('points', 'reach too far|domain', {'points': [[-1e308, 0], [1e308, 1]]}),
    ('weights', r'shape \(2,\), must be \(3,\)', {'weights': [1, 2]}),
    ('weights', 'not finite', {'weights': [1, 2, np.nan]}),
    ('domain', 'must be 4 numbers', {'domain': (0, 1)}),
    ('domain', 'no polygon', {'domain': types.SimpleNamespace(__geo_interface__={})}),
    ('domain', '', {'domain': (1, 0, 0, 1)}),
    ('domain', 'a domain that repeats must be named', {'periodic': 'x'}),
    ('periodic', "'z' is none of none, x, y, xy", {'periodic': 'z', 'domain': (0, 0, 1, 1)}),
    ('periodic', '3 is none of', {'periodic': 3}),
    ('density', r'shape \(4,\), must be \(H, W\)', {'density': [1, 2, 3, 4]}),
    ('density', '', {'density': [[1, -2]]}),
    ('domain', r'shape \(3,\), must be 4 numbers', {'domain': [1, 2, 3]}),
    ('domain', 'a Point is no polygon', {'domain': {'type': 'Point', 'coordinates': [0, 0]}}),
    ('domain', '', {'domain': [(0, 0), (1, 1), (1, 0), (0, 1)]}),
    ('detail', "'most' is none of measures, polygons, all", {'detail': 'most'}),
    ('search', "'tree' is none of grid, flann", {'search': 'tree'}),
    ('search', 'is none of', {'search': 'flann:many'}),
    ('search', '2 neighbors: must be 3 to 1024', {'search': 'flann:2'}),
    ('search', 'weights', {'search': 'flann', 'weights': [1, 2, 3]}),
    ('backend', "'metal' is none of auto", {'backend': 'metal'}),
    ('threads', '0 is no number of threads', {'threads': 0}),
]


@pytest.mark.parametrize('argument, message, arguments', WRONG)
def test_what_is_wrong_is_named(argument, message, arguments):
    with pytest.raises(vorpipe.InputError, match=message) as caught:
        vorpipe.cells(**{'points': POINTS, **arguments})
    error = caught.value
    if 'reach' not in message:
        assert str(error).startswith(f'{argument}: ') and error.subject == argument
    assert error.code == 'input' and isinstance(error, ValueError) and isinstance(error, vorpipe.Error)
    assert '\n' not in str(error)


@pytest.mark.parametrize('argument, arguments', [
    ('size', {'size': (100,) * 3}), ('size', {'size': 0}), ('size', {'size': (10, 0)}), ('size', {'size': (10, 40000)}),
    ('color', {'color': 'red'}),
    ('colormap', {'colormap': 'jet', 'color': 'area'})])
def test_what_is_wrong_about_a_picture_is_named(argument, arguments):
    with pytest.raises(vorpipe.InputError, match=f'^{argument}: ') as caught:
        vorpipe.render(POINTS, **arguments)
    assert caught.value.subject == argument


@pytest.mark.parametrize('function, options', [
    ('render', 'MARKS'), ('draw', 'MARKS'), ('relax', 'RELAX'), ('transport', 'TRANSPORT')])
def test_options_have_the_defaults_of_the_library(function, options):
    expected = getattr(vorpipe._vorpipe, options)
    for call in (getattr(vorpipe, function), getattr(vorpipe.Session, function)):
        arguments = inspect.signature(call).parameters
        assert {name: arguments[name].default or usual for name, usual in expected.items()} == expected


def fluid(**arguments):
    return vorpipe.Fluid('shear', **{'particles': 20, **arguments})


def running(**arguments):
    return fluid().run(**{'steps': 0, **arguments})


WITHIN_ITSELF = []
WITHIN_ITSELF.append(WITHIN_ITSELF)

OF_ANOTHER_TYPE = [
    (vorpipe.cells, ['domain', WITHIN_ITSELF, 'detail', 5, 'progress', 5, 'repair', 'x']),
    (vorpipe.render, ['size', (np.inf, 3), 'size', (1.9, 2), 'color', None, 'edges', 'x', 'color_scale', 5,
                      'edge_width', None, 'dot_size', 'x', 'fit', 5, 'antialias', 2.5, 'antialias', 10**20,
                      'label_size', 'x', 'progress', 5]),
    (vorpipe.relax, ['method', 5, 'iterations', 'x', 'iterations', np.nan, 'iterations', 10**20, 'iterations', None,
                     'tolerance', 'x', 'equal_masses', 'x', 'progress', 5]),
    (vorpipe.transport, ['tolerance', None, 'diagrams', 'x', 'normalize', 'x', 'fill', 'x', 'callback', 5]),
    (fluid, ['particles', 'x', 'particles', 10**20, 'scheme', 5, 'step', 'x', 'until', 'x', 'diagrams', 'x', 'session',
             5, 'search', 'flann:99999999999', 'progress', 5]),
    (running, ['until', 'x', 'steps', np.nan, 'steps', 'x', 'callback', 5]),
]


@pytest.mark.parametrize('call, argument, value', [
    (call, given[k], given[k + 1]) for call, given in OF_ANOTHER_TYPE for k in range(0, len(given), 2)])
def test_what_is_of_another_type_is_named(call, argument, value):
    with pytest.raises(vorpipe.InputError, match=f'^{argument}: ') as caught:
        call(**({} if call in (fluid, running) else {'points': POINTS}), **{argument: value})
    assert caught.value.subject == argument and '\n' not in str(caught.value)


@pytest.mark.parametrize('argument, call', [
    ('seed', lambda: vorpipe.generate('random', 5, -1)), ('n', lambda: vorpipe.generate('random', 1.5)),
    ('seed', lambda: vorpipe.read('random:5', seed=2**64)), ('format', lambda: vorpipe.read('random:5', format=5)),
    ('columns', lambda: vorpipe.read('random:5', columns=1.5)), ('path', lambda: vorpipe.read(None)),
    ('low', lambda: vorpipe.random_weights(1, 0, 5)), ('low', lambda: vorpipe.random_weights(np.nan, 1, 5)),
    ('low', lambda: vorpipe.random_weights(-1e308, 1e308, 5)), ('n', lambda: vorpipe.random_weights(0, 1, -5)),
    ('n', lambda: vorpipe.random_weights(0, 1, 10**14)), ('n', lambda: vorpipe.drawn_points([[1]], 10**14)),
    ('domain', lambda: vorpipe.drawn_points([[1]], 5, domain=(1, 1, 0, 0))),
    ('density', lambda: vorpipe.drawn_points([[1, -1]], 5)), ('result', lambda: vorpipe.check(5)),
    ('disable', lambda: vorpipe.devices(disable=5)), ('limit', lambda: vorpipe.devices(limit=5)),
    ('validate', lambda: vorpipe.Session('cpu', validate='x')),
    ('only_cells', lambda: vorpipe.cells(POINTS).to_bytes('.csv', only_cells='x')),
    ('extension', lambda: vorpipe.cells(POINTS).to_bytes(5))])
def test_what_other_functions_do_not_take_is_named(argument, call):
    with pytest.raises(vorpipe.InputError, match=f'^{argument}: ') as caught:
        call()
    assert caught.value.subject == argument


def test_an_index_is_a_whole_number_of_a_cell():
    diagram = vorpipe.cells(POINTS, weights=[0.01] * 3, surface='free', domain=(0, 0, 1, 1))
    assert diagram[np.int64(-1)].site == 2
    for wrong in (1.5, '1'):
        with pytest.raises(TypeError):
            diagram[wrong]
    cell = diagram[0]
    cell.site = 10**6
    with pytest.raises(IndexError):
        cell.border()


def test_a_device_that_is_not_there_is_a_device_error():
    with pytest.raises(vorpipe.DeviceError) as caught:
        vorpipe.Session('cpu', device='none such')
    assert caught.value.code == 'device' and isinstance(caught.value, RuntimeError)


def test_features_and_limits_have_names():
    with pytest.raises(vorpipe.InputError, match="disable: 'wings' is none of"):
        vorpipe.Session('cpu', disable=['wings'])
    with pytest.raises(vorpipe.InputError, match="limit: 'wings' is none of"):
        vorpipe.devices(limit={'wings': 2})


def test_an_error_survives_pickling():
    with pytest.raises(vorpipe.InputError) as caught:
        vorpipe.cells(POINTS, weights=[1])
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.code, again.subject) == (str(caught.value), 'input', 'weights')


def test_a_missing_file_is_an_input_error(tmp_path):
    with pytest.raises(vorpipe.InputError, match='missing.csv'):
        vorpipe.read_sites(tmp_path / 'missing.csv')
    with pytest.raises(vorpipe.InputError, match='missing.wkt'):
        vorpipe.cells(POINTS, domain=tmp_path / 'missing.wkt')


def test_old_names_serve_with_a_warning():
    half = [(0, 0), (0.5, 0), (0.5, 1), (0, 1)]
    with pytest.warns(DeprecationWarning, match='^outline= is domain= now$') as told:
        assert vorpipe.cells(POINTS, outline=half).area_sum() == 0.5
    assert told[0].filename == __file__
    with pytest.warns(DeprecationWarning, match='^outline= is domain= now$'):
        picture = vorpipe.render(POINTS, None, (0, 0, 1, 1), outline=half, size=40)
    assert picture.extent == (0, 1, 0, 1) and (picture.ids[:, 20:] == vorpipe.NO_SITE).all()
    with vorpipe.Session('cpu') as session, pytest.warns(DeprecationWarning):
        assert session.cells(POINTS, domain=(0, 0, 1, 1), outline=half).area_sum() == 0.5
    with pytest.warns(DeprecationWarning, match='^detail="everything" is "all" now$'):
        assert vorpipe.cells(POINTS, detail='everything').detail == 'all'
    with pytest.warns(DeprecationWarning), pytest.raises(vorpipe.InputError, match='^outline: is domain now, and both'):
        vorpipe.cells(POINTS, domain='hull', outline=half)
    with pytest.warns(DeprecationWarning, match='^parcels= is particles= now$'):
        assert len(vorpipe.Fluid('shear', parcels=16)) == 16
    with pytest.warns(DeprecationWarning, match='^periodic is a keyword now: periodic=$') as told:
        assert vorpipe.cells(POINTS, None, (0, 0, 1, 1), 'x').periodic == 'x'
    assert told[0].filename == __file__
    diagram = vorpipe.cells(POINTS)
    for old, new in (('points', 'sites'), ('offsets', 'cell_offsets'), ('vertices', 'cell_vertices')):
        with pytest.warns(DeprecationWarning, match=f'^Diagram.{old} is {new} now$'):
            assert np.array_equal(getattr(diagram, old), getattr(diagram, new))


def test_options_are_those_that_there_are():
    for wrong in (lambda: vorpipe.render(POINTS, colour='area'), lambda: vorpipe.cells(POINTS, colour='area')):
        with pytest.raises(TypeError, match=r"^(render|cells)\(\) got an unexpected keyword argument 'colour'$"):
            wrong()
    with pytest.warns(DeprecationWarning), pytest.raises(TypeError, match=r'^cells\(\) takes from 1 to 3 positional'):
        vorpipe.cells(POINTS, None, (0, 0, 1, 1), 'x', None, 'cpu')
    with pytest.warns(DeprecationWarning), pytest.raises(TypeError, match="^render.. got multiple values"):
        vorpipe.render(POINTS, None, (0, 0, 1, 1), 400, size=300)


def test_a_size_may_be_that_of_the_longer_side():
    for domain, shape in (((0, 0, 2, 1), (200, 400)), ((0, 0, 1, 4), (400, 100))):
        assert vorpipe.render(POINTS, domain=domain, size=400).ids.shape == shape
    assert vorpipe.render(POINTS, domain=(0, 0, 1, 1), view=(0, 0, 1, 0.5), size=400).ids.shape == (200, 400)


@pytest.mark.parametrize('form', ['geopandas', 'series', 'shapely', 'list', 'geojson', 'file', 'path', 'layer'])
def test_a_domain_may_be_any_polygon(form, tmp_path):
    half, other = [(0, 0), (0.5, 0), (0.5, 1), (0, 1)], [(0.5, 0), (1, 0), (1, 1)]
    shape = {'type': 'Polygon', 'coordinates': [[*half, half[0]]]}
    path = tmp_path / 'half.geojson'
    path.write_text(json.dumps(shape))
    domain = {'geojson': shape, 'file': str(path), 'path': path}.get(form)
    options = {}
    if domain is None:
        geometry = pytest.importorskip('shapely.geometry')
        domain = geometry.Polygon(half)
        if form == 'list':
            assert vorpipe.cells(POINTS, domain=[domain, geometry.Polygon(other)]).area_sum() == 0.75
            domain = [domain]
    if form in ('geopandas', 'series', 'layer'):
        geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
        series = geopandas.GeoSeries([domain])
        domain = series if form == 'series' else geopandas.GeoDataFrame(geometry=series)
        if form == 'layer':
            for layer, frame in (('a', domain), ('b', geopandas.GeoDataFrame(geometry=[geometry.Polygon(other)]))):
                frame.to_file(tmp_path / 'x.gpkg', layer=layer, driver='GPKG')
            domain, options = tmp_path / 'x.gpkg', {'domain_layer': 'a'}
            with pytest.raises(vorpipe.InputError, match='layer'):
                vorpipe.cells(POINTS, domain=domain)
    assert vorpipe.cells(POINTS, domain=domain, **options).area_sum() == 0.5
    if form == 'shapely':
        with pytest.raises(vorpipe.InputError, match='^domain_layer: is for a GeoPackage'):
            vorpipe.cells(POINTS, domain=domain, domain_layer='a')
