"""Files with all that they say of their points, and what becomes of it."""
import json
import warnings

import numpy as np
import pytest

import vorpipe

UNIT = (0, 0, 1, 1)
TABLE = '''name,lon,lat,height,open,code
Ulm,10.0,48.4,478,true,007
Bonn,7.1,50.7,,false,
"Linz, Au",14.3,48.3,266,true,4020
'''
TYPES = {'count': np.array([1, 2, 3]), 'size': np.array([0.5, np.nan, 2.0]), 'big': [2**63, 1, 2],
         'is_old': [True, False, True], 'maybe': [True, None, False], 'few': [1, None, 3], 'name': ['a', None, 'ü,"'],
         'mixed': [1, 'a', {'k': [1, None]}], 'bytes': np.array([1, 2, 255], dtype=np.uint8),
         'day': np.array(['2024-05-01', 'NaT', '1999-01-02'], dtype='datetime64[D]')}
POINTS = [(0.2, 0.3), (0.7, 0.6), (0.4, 0.9)]


@pytest.fixture
def towns(tmp_path):
    (tmp_path / 'towns.csv').write_text(TABLE)
    return vorpipe.read(tmp_path / 'towns.csv', columns=('lon', 'lat'))


def test_a_file_gives_points_attributes_and_what_its_coordinates_are(towns):
    assert towns.points.tolist() == [[10, 48.4], [7.1, 50.7], [14.3, 48.3]] and towns.weights is None
    assert list(towns.attributes) == ['name', 'height', 'open', 'code']
    assert towns.attributes['name'].tolist() == ['Ulm', 'Bonn', 'Linz, Au']
    assert towns.attributes['height'].tolist() == [478, None, 266]
    assert towns.attributes['open'].dtype == bool and towns.attributes['open'].tolist() == [True, False, True]
    assert towns.attributes['code'].tolist() == ['007', None, '4020']
    assert np.array_equal(np.asarray(towns), towns.points)
    assert len(towns) == 3 and 'towns.csv' in repr(towns) and towns.skipped == 0


def test_what_a_file_leaves_open_is_told(tmp_path):
    (tmp_path / 'towns.csv').write_text(TABLE)
    with pytest.warns(vorpipe.InputWarning, match='"lon", "lat" are taken as x, y; columns names others') as told:
        sites = vorpipe.read(tmp_path / 'towns.csv')
    assert told[0].filename == __file__ and sites.notes == [str(told[0].message)]


def test_columns_and_rows_are_chosen(tmp_path):
    (tmp_path / 'odd.txt').write_text('a;b;c\n1;2;3\n4;;6\n7;8;9\n')
    with pytest.warns(vorpipe.InputWarning, match='1 row without a place or a weight is left out'):
        sites = vorpipe.read(tmp_path / 'odd.txt', format='csv', columns=['C', 2], missing='skip')
    assert sites.points.tolist() == [[3, 2], [9, 8]] and sites.skipped == 1
    with pytest.raises(vorpipe.InputError, match=r'odd\.txt:3:3: empty field'):
        vorpipe.read(tmp_path / 'odd.txt', format='csv', columns=('c', 'b'))
    with pytest.raises(vorpipe.InputError, match='^missing: '):
        vorpipe.read(tmp_path / 'odd.txt', missing='drop')


def test_generators_fill_the_unit_square():
    sites = vorpipe.read('random:100', seed=7)
    assert np.array_equal(sites.points, vorpipe.generate('random', 100, 7))
    assert vorpipe.cells(sites).domain == UNIT
    assert vorpipe.cells(sites, periodic='xy').area_sum() == pytest.approx(1)
    with pytest.raises(vorpipe.InputError, match='neither a file nor a generator'):
        vorpipe.generate('stripes', 10)


def test_generators_fill_the_box_that_is_named():
    box = (0, 0, 1.5, 1)
    sites, points = vorpipe.read('square:150'), vorpipe.generate('square', 150, domain=box)
    assert points.shape == (150, 2) and len(sites) == 144
    cells = vorpipe.cells(sites, domain=box)
    assert np.array_equal(cells.sites, points) and np.allclose(cells.areas, 0.01)
    assert vorpipe.generate('random', 500, domain=(-2, 5, 2, 6)).min(axis=0) == pytest.approx((-2, 5), abs=0.1)
    with pytest.raises(vorpipe.InputError, match='weights: 144 for the 150 points of this domain'):
        vorpipe.cells(sites, np.zeros(144), domain=box)
    with pytest.raises(vorpipe.InputError, match='domain: .* is not a rectangle'):
        vorpipe.generate('random', 5, domain=(0, 0, 0, 1))


def test_weights_of_a_file_are_taken_and_no_others(tmp_path):
    (tmp_path / 'w.csv').write_text('x,y,weight\n0.3,0.5,0.2\n0.8,0.5,0\n')
    sites = vorpipe.read(tmp_path / 'w.csv')
    diagram = vorpipe.cells(sites, domain=UNIT)
    assert diagram.weights.tolist() == [0.2, 0] and np.allclose(diagram.areas, [0.75, 0.25])
    with pytest.raises(vorpipe.InputError, match='^weights: .*w.csv has weights of its own'):
        vorpipe.cells(sites, [1, 2], domain=UNIT)


def test_attributes_go_from_a_file_to_files(towns, tmp_path):
    diagram = vorpipe.cells(towns, project='auto')
    assert diagram.attributes['code'].tolist() == ['007', None, '4020']
    diagram.save(tmp_path / 'cells.geojson')
    records = [feature['properties'] for feature in json.loads((tmp_path / 'cells.geojson').read_text())['features']]
    assert [record['name'] for record in records] == ['Ulm', 'Bonn', 'Linz, Au']
    assert [record['height'] for record in records] == [478, None, 266]


def test_attributes_of_every_type_come_back(tmp_path):
    diagram = vorpipe.cells(POINTS, domain=UNIT, attributes=TYPES)
    kept = diagram.attributes
    assert kept['count'].dtype == np.int64 and kept['bytes'].tolist() == [1, 2, 255]
    assert kept['size'].dtype == np.float64 and np.array_equal(kept['size'], TYPES['size'], equal_nan=True)
    assert kept['big'].tolist() == [2.0**63, 1, 2]
    assert kept['is_old'].dtype == bool
    for name in ('maybe', 'few', 'name', 'mixed', 'is_old'):
        assert kept[name].tolist() == TYPES[name], name
    assert kept['day'].tolist() == ['2024-05-01', None, '1999-01-02']
    assert not kept['count'].flags.writeable
    written = json.loads(diagram.to_bytes('.geojson'))['features'][2]['properties']
    assert {name: written[name] for name in TYPES} == {
        'count': 3, 'size': 2.0, 'big': 2, 'is_old': True, 'maybe': False, 'few': 3, 'name': 'ü,"',
        'mixed': {'k': [1, None]}, 'bytes': 255, 'day': '1999-01-02'}
    assert isinstance(written['size'], float)


def test_a_data_frame_is_a_mapping():
    pandas = pytest.importorskip('pandas')
    frame = pandas.DataFrame({'n': pandas.array([1, None, 3], dtype='Int64'),
                              'kind': pandas.Categorical(['a', 'b', 'a'])})
    kept = vorpipe.cells(POINTS, attributes=frame).attributes
    assert kept['n'].tolist() == [1, None, 3] and kept['kind'].tolist() == ['a', 'b', 'a']


@pytest.mark.parametrize('attributes, message', [
    ([1, 2, 3], 'a list is no mapping'), ({'a': [1, 2]}, r"'a' has the shape \(2,\), must be \(3,\)"),
    ({'a': np.zeros((3, 2))}, r'shape \(3, 2\)'), ({'a': [1.0, np.inf, 2]}, "'a' of point 1 is infinite"),
    ({1: [1, 2, 3], '1': [1, 2, 3]}, "two of the name '1'"), ({'a': ['\ud800', 'b', 'c']}, 'UTF-8'),
    ({'\ud800': [1, 2, 3]}, 'UTF-8'), ({'a\0b': [1, 2, 3]}, 'has a zero byte')])
def test_attributes_that_cannot_be_are_refused(attributes, message):
    with pytest.raises(vorpipe.InputError, match=f'^attributes: .*{message}') as caught:
        vorpipe.cells(POINTS, attributes=attributes)
    assert caught.value.subject == 'attributes'


def test_attributes_of_sites_and_the_callers_stand_side_by_side(towns):
    diagram = vorpipe.cells(towns, project='auto', attributes={'rank': [1, 2, 3]})
    assert list(diagram.attributes) == ['name', 'height', 'open', 'code', 'rank']
    assert list(towns.attributes) == ['name', 'height', 'open', 'code']
    with pytest.raises(vorpipe.InputError, match="attributes: there are two of the name 'code'"):
        vorpipe.cells(towns, project='auto', attributes={'code': [1, 2, 3]})


def test_names_of_other_fields_are_changed_with_a_warning():
    diagram = vorpipe.cells(POINTS, domain=UNIT, attributes={'Area': [1, 2, 3]})
    with pytest.warns(vorpipe.InputWarning, match='input_Area'):
        assert b'"input_Area":1' in diagram.to_bytes('.geojson')
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        diagram.to_bytes('.npz')


def test_records_without_a_cell_are_left_out_where_that_is_asked_for(tmp_path):
    diagram = vorpipe.cells([*POINTS, (9, 9)], domain=UNIT)
    diagram.save(tmp_path / 'all.geojson')
    diagram.save(tmp_path / 'some.geojson', only_cells=True)
    counts = [len(json.loads((tmp_path / name).read_text())['features']) for name in ('all.geojson', 'some.geojson')]
    assert counts == [4, 3] and len(json.loads(diagram.to_bytes('.geojson', only_cells=True))['features']) == 3
    with pytest.raises(vorpipe.InputError, match=r'^only_cells: \.npz has no features to leave out; .*\.geojson'):
        diagram.save(tmp_path / 'cells.npz', only_cells=True)
    assert not (tmp_path / 'cells.npz').exists()


def test_edges_are_saved_once_each(tmp_path):
    diagram = vorpipe.cells(vorpipe.generate('random', 50), domain=UNIT)
    diagram.save_edges(tmp_path / 'edges.csv')
    rows = (tmp_path / 'edges.csv').read_text().splitlines()
    assert len(rows) - 1 == len(diagram.topology().edge_cells)
    with pytest.raises(vorpipe.InputError, match=r'edges\.npz: unknown kind of file for edges'):
        diagram.save_edges(tmp_path / 'edges.npz')
    with pytest.raises(vorpipe.InputError, match='^detail: '):
        vorpipe.cells(POINTS, detail='measures').save_edges(tmp_path / 'edges.wkt')
