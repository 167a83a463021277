"""Points of tables that name their columns, of geometries, and of files."""
import warnings

import numpy as np
import pytest

import vorpipe

FRANKFURT, HAMBURG = (8.68, 50.11), (9.99, 53.55)
CITIES = [FRANKFURT, HAMBURG, (11.58, 48.14)]
NAMES = ['Frankfurt', 'Hamburg', 'München']


class Frame:
    """What a DataFrame has, as far as it is asked."""

    def __init__(self, columns):
        self.values = columns
        self.columns = list(columns)

    def __getitem__(self, name):
        return np.asarray(self.values[name])

    def __len__(self):
        return len(next(iter(self.values.values())))


def frame_of_pandas(columns):
    return pytest.importorskip('pandas').DataFrame(columns)


def array_of_records(columns):
    kinds = [(name, np.asarray(values).dtype) for name, values in columns.items()]
    return np.array(list(zip(*columns.values())), dtype=kinds)


@pytest.fixture(params=[dict, Frame, array_of_records, frame_of_pandas])
def table(request):
    """Makes a table of columns by name."""
    return request.param


def quietly(*arguments, **options):
    with warnings.catch_warnings():
        warnings.simplefilter('ignore', vorpipe.InputWarning)
        return vorpipe.cells(*arguments, **options)


@pytest.mark.parametrize('y, x', [('lat', 'lon'), ('Latitude', 'LONGITUDE'), ('y', 'x'), ('Y', 'X'), ('lat', 'lng'),
                                  ('northing', 'easting')])
def test_columns_are_known_by_their_names_wherever_they_stand(table, y, x):
    lon, lat = zip(*CITIES)
    diagram = quietly(table({'name': NAMES, y: lat, 'people': [770, 1900, 1500], x: lon}))
    assert diagram.sites.tolist() == [list(city) for city in CITIES]
    assert diagram.attributes['name'].tolist() == NAMES and diagram.attributes['people'].tolist() == [770, 1900, 1500]
    assert list(diagram.attributes) == ['name', 'people']


def test_names_that_are_taken_for_others_are_told(table):
    lon, lat = zip(*CITIES)
    with pytest.warns(vorpipe.InputWarning) as told:
        vorpipe.cells(table({'lat': lat, 'lon': lon}))
    assert str(told[0].message) == 'points: "lon", "lat" are taken as x, y' and told[0].filename == __file__
    assert 'look like degrees' in str(told[1].message)
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        vorpipe.cells(table({'x': lon, 'y': lat}))


@pytest.mark.parametrize('name, expected', [('weight', [4, 1, 2]), ('W', [4, 1, 2]), ('Radius', [16, 1, 4]),
                                            ('r', [16, 1, 4])])
def test_weights_and_radii_are_known_by_their_names(table, name, expected):
    columns = {name: [4.0, 1.0, 2.0], 'y': [0, 1, 2], 'x': [3, 4, 6]}
    assert quietly(table(columns)).weights.tolist() == expected
    with pytest.raises(vorpipe.InputError, match='^weights: points has weights of its own'):
        quietly(table(columns), [1, 2, 3])
    with pytest.raises(vorpipe.InputError, match='^points: the radius of point 1: "-1" is negative'):
        quietly({'x': [0, 1, 2], 'y': [1, 1, 0], 'radius': [1, -1, 1]})


def test_two_columns_whose_names_say_nothing_are_x_and_y(table):
    with pytest.warns(vorpipe.InputWarning, match="^points: 'a', 'b' are taken as x, y$"):
        assert vorpipe.cells(table({'a': [1, 2], 'b': [3, 5]})).sites.tolist() == [[1, 3], [2, 5]]


def test_numbers_for_names_are_those_of_an_array():
    pandas = pytest.importorskip('pandas')
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        assert vorpipe.cells(pandas.DataFrame(np.array(CITIES))).sites.tolist() == [list(city) for city in CITIES]


@pytest.mark.parametrize('columns, message', [
    ({'a': [1], 'b': [2], 'c': [3]}, "of the columns 'a', 'b', 'c' none is called x or y, lon or lat"),
    ({'lat': [1], 'b': [2]}, 'the table "lat,b" names no column "x"'),
    ({'lon': [1], 'long': [1], 'lat': [2]}, 'the table names both "lon" and "long"; give an array of the two columns'),
    ({'x': [1], 'y': [2], 'weight': [1], 'radius': [1]}, 'the table names both "weight" and "radius"'),
    ({'x': ['west'], 'y': [2]}, 'expected numbers'), ({'x': [np.nan], 'y': [2]}, 'point 0 is not finite: nan, 2'),
    ({'wkt': ['POINT (1 2)']}, "the column 'wkt' holds no geometries; text in WKT is read from files")])
def test_what_names_do_not_tell_is_refused(table, columns, message):
    with pytest.raises(vorpipe.InputError, match=f'^points: {message}') as caught:
        quietly(table(columns))
    assert caught.value.subject == 'points' and '--' not in str(caught.value)


def test_two_columns_of_one_name_are_refused():
    pandas = pytest.importorskip('pandas')
    with pytest.raises(vorpipe.InputError, match="^points: two columns are called 'n'"):
        vorpipe.cells(pandas.DataFrame([[1, 2, 3, 4]], columns=['n', 'x', 'y', 'n']))


def test_masked_columns_are_refused():
    masked = np.ma.array(np.array([(1.0, 2.0), (3.0, 4.0)], dtype=[('x', float), ('y', float)]),
                         mask=[(False, False), (True, False)])
    with pytest.raises(vorpipe.InputError, match='^points: some elements are masked'):
        vorpipe.cells(masked)
    assert vorpipe.cells(masked[:1]).sites.tolist() == [[1, 2]]


def test_columns_of_other_lengths_are_refused():
    with pytest.raises(vorpipe.InputError, match=r'^points: columns of the shapes \(2,\) and \(1,\)'):
        vorpipe.cells({'x': [1, 2], 'y': [1]})
    with pytest.raises(vorpipe.InputError, match=r"^attributes: 'n' has the shape \(1,\)"):
        vorpipe.cells({'x': [1, 2], 'y': [1, 4], 'n': [1]})


def test_missing_values_of_pandas_are_said_to_be_no_number():
    pandas = pytest.importorskip('pandas')
    frame = pandas.DataFrame({'x': pandas.array([1, None, 3], dtype='Int64'), 'y': [1, 2, 3]})
    with pytest.raises(vorpipe.InputError, match='^points: point 1 is not finite: nan, 2'):
        vorpipe.cells(frame)
    assert vorpipe.cells(frame.dropna()).sites.tolist() == [[1, 1], [3, 3]]


def test_names_of_degrees_that_reach_too_far_are_of_a_plane():
    with pytest.warns(vorpipe.InputWarning, match='^points: should hold degrees .* taken as a plane') as told:
        vorpipe.cells({'lon': [500_000, 600_000], 'lat': [5_000_000, 5_100_000]})
    assert not any('look like degrees' in str(note.message) for note in told)


class Shape:
    """What geometries have in common."""

    def __init__(self, kind, coordinates):
        self.__geo_interface__ = {'type': kind, 'coordinates': coordinates}


@pytest.mark.parametrize('points', [
    [Shape('Point', city) for city in CITIES], tuple(Shape('Point', (*city, 7.0)) for city in CITIES),
    Shape('MultiPoint', CITIES), [Shape('Point', FRANKFURT), Shape('MultiPoint', CITIES[1:])],
    {'type': 'MultiPoint', 'coordinates': CITIES},
    {'type': 'GeometryCollection', 'geometries': [{'type': 'Point', 'coordinates': city} for city in CITIES]}])
def test_geometries_of_points_are_points(points):
    diagram = vorpipe.cells(points)
    assert diagram.sites.tolist() == [list(city) for city in CITIES]
    assert diagram.locate(points).tolist() == [0, 1, 2]


def test_features_are_points_with_their_properties():
    features = [{'type': 'Feature', 'properties': {'name': name, 'weight': 0.1},
                 'geometry': {'type': 'Point', 'coordinates': city}} for name, city in zip(NAMES, CITIES)]
    diagram = vorpipe.cells({'type': 'FeatureCollection', 'features': features})
    assert diagram.sites.tolist() == [list(city) for city in CITIES] and diagram.weights.tolist() == [0.1] * 3
    assert diagram.attributes['name'].tolist() == NAMES


@pytest.mark.parametrize('points, message', [
    ([Shape('Point', FRANKFURT), Shape('LineString', CITIES)], 'geometry 1 is a LineString; its centroid is a point'),
    ([Shape('Point', FRANKFURT), None], 'geometry 1 has no place'),
    ([Shape('Point', FRANKFURT), Shape('Point', ())], 'geometry 1 has no place'),
    (Shape('Polygon', [CITIES]), 'geometry 0 is a Polygon')])
def test_geometries_that_are_no_points_are_refused(points, message):
    with pytest.raises(vorpipe.InputError, match=f'^points: {message}'):
        vorpipe.cells(points)


def test_points_of_shapely_are_points():
    geometry = pytest.importorskip('shapely.geometry')
    shapes = np.empty(3, dtype=object)
    shapes[:] = [geometry.Point(city) for city in CITIES]
    for points in (list(shapes), shapes, geometry.MultiPoint(CITIES)):
        diagram = vorpipe.cells(points)
        assert diagram.sites.tolist() == [list(city) for city in CITIES]
        assert diagram.locate(points).tolist() == [0, 1, 2]
    box = (5, 45, 15, 55)
    assert vorpipe.cells(CITIES, domain=box).locate(geometry.Point(9.9, 53.5)) == 1


def test_geopandas_gives_places_attributes_and_what_its_coordinates_are():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    series = geopandas.points_from_xy(*zip(*CITIES), crs='EPSG:4258')
    frame = geopandas.GeoDataFrame({'name': NAMES, 'y': [0, 0, 0], 'radius': [1.0, 2.0, 3.0]}, geometry=series)
    for points in (frame, frame.geometry, series):
        diagram = quietly(points)
        assert diagram.sites.tolist() == [list(city) for city in CITIES] and diagram.crs == 'EPSG:4258'
        assert np.array_equal(diagram.locate(points), [0, 1, 2])
    diagram = quietly(frame)
    assert list(diagram.attributes) == ['name', 'y'] and diagram.attributes['name'].tolist() == NAMES
    assert diagram.weights.tolist() == [1, 4, 9]
    assert diagram.to_geopandas().crs.to_epsg() == 4258
    plane = quietly(frame[['name', 'geometry']].to_crs(25832))
    assert plane.crs == 'EPSG:25832' and plane.weights is None


@pytest.mark.filterwarnings('ignore::vorpipe.InputWarning')
def test_places_and_outlines_in_another_system_are_refused_by_name():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    geometry = pytest.importorskip('shapely.geometry')
    degrees = geopandas.GeoDataFrame(geometry=[geometry.Point(city) for city in CITIES], crs='EPSG:4326')
    meters, box = degrees.to_crs(25832), geopandas.GeoSeries([geometry.box(5, 45, 15, 55)], crs='EPSG:4326')
    with pytest.raises(vorpipe.InputError, match='^domain: .* is in EPSG:4326, points in EPSG:25832') as caught:
        vorpipe.cells(meters, domain=box)
    assert caught.value.subject == 'domain'
    for points, outline in ((meters, box.to_crs(25832)), (degrees, box)):
        assert vorpipe.cells(points, domain=outline).report.ok == 3
    with pytest.raises(vorpipe.InputError, match='^places: they are in EPSG:25832, the diagram in EPSG:4326'):
        vorpipe.cells(degrees).locate(meters)
    assert vorpipe.cells(degrees, project='auto').locate(degrees.to_crs(4258)).tolist() == [0, 1, 2]


def test_a_row_of_several_points_gives_each_its_values():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    geometry = pytest.importorskip('shapely.geometry')
    shapes = [geometry.MultiPoint(CITIES[:2]), geometry.Point(CITIES[2])]
    frame = geopandas.GeoDataFrame({'n': [1, 2], 'tag': ['a', None], 'weight': [0.5, 0.25]}, geometry=shapes,
                                   index=[7, 3])
    diagram = vorpipe.cells(frame)
    assert diagram.sites.tolist() == [list(city) for city in CITIES] and diagram.weights.tolist() == [0.5, 0.5, 0.25]
    assert diagram.attributes['n'].tolist() == [1, 1, 2] and diagram.attributes['tag'].tolist() == ['a', 'a', None]


def test_every_function_takes_them(tmp_path):
    lon, lat = zip(*CITIES)
    table = {'y': lat, 'x': lon, 'name': NAMES}
    points = vorpipe.cells(CITIES).sites
    assert np.array_equal(vorpipe.render(table, size=(20, 20)).sites, points)
    assert np.array_equal(vorpipe.draw(table, tmp_path / 'cells.svg').sites, points)
    assert len(vorpipe.relax(table, iterations=1)) == len(vorpipe.transport(table)) == 3
    assert vorpipe.forecast(table).fits and len(vorpipe.Fluid(table, domain=(5, 45, 15, 55))) == 3
    with vorpipe.Session('cpu') as session:
        assert session.cells(table).attributes['name'].tolist() == NAMES


def test_a_path_in_place_of_points_is_read(tmp_path):
    (tmp_path / 'towns.csv').write_text('name,lat,lon\nUlm,48.4,10.0\nBonn,50.7,7.1\n')
    with pytest.warns(vorpipe.InputWarning, match='"lon", "lat" are taken as x, y; columns names others'):
        diagram = vorpipe.cells(tmp_path / 'towns.csv')
    assert diagram.sites.tolist() == [[10, 48.4], [7.1, 50.7]]
    assert diagram.attributes['name'].tolist() == ['Ulm', 'Bonn']
    assert vorpipe.cells('random:50').domain == (0, 0, 1, 1)
    with pytest.raises(vorpipe.InputError, match='gauges.csv: '):
        vorpipe.cells('gauges.csv')


def test_one_place_is_located_as_one_number():
    diagram = vorpipe.cells(CITIES)
    for place in (HAMBURG, list(HAMBURG), np.array(HAMBURG)):
        found = diagram.locate(place)
        assert found == 1 and np.ndim(found) == 0
    assert diagram.locate((0, 0)) == vorpipe.NO_SITE
    with pytest.raises(vorpipe.InputError, match=r'^places: shape \(3,\), must be \(N, 2\)'):
        diagram.locate((1, 2, 3))
    with pytest.raises(vorpipe.InputError, match='^places: geometry 0 is a Polygon'):
        diagram.locate([Shape('Polygon', [CITIES])])


def test_a_geometry_without_a_place_is_refused_by_its_row():
    shapely = pytest.importorskip('shapely.geometry')
    geopandas = pytest.importorskip('geopandas')
    with pytest.raises(vorpipe.InputError, match='geometry 1 has no place'):
        vorpipe.cells(geopandas.GeoSeries([shapely.Point(1, 2), shapely.Point(), shapely.Point(2, 3)]))
    with pytest.raises(vorpipe.InputError, match="^points: geometry 'b' has no place"):
        vorpipe.cells(geopandas.GeoSeries([shapely.Point(1, 2), None, shapely.Point(2, 3)], index=list('abc')))


def towns(geopandas, index=('f', 'h', 'm'), **columns):
    """As a GeoDataFrame in a plane."""
    points = geopandas.points_from_xy(*zip(*CITIES), crs='EPSG:4326').to_crs(25832)
    return geopandas.GeoDataFrame({'name': NAMES, **columns}, geometry=points, index=list(index))


def test_labels_of_rows_come_back(tmp_path):
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    pandas = pytest.importorskip('pandas', reason='there is no pandas')
    frame = towns(geopandas, people=pandas.array([770, None, 1500], dtype='Int64'))
    plain = pandas.DataFrame({'x': [1, 2, 4], 'y': [1, 3, 2]}, index=['f', 'h', 'm'])
    for points in (frame, frame.geometry, plain):
        diagram = quietly(points)
        for result in (diagram, vorpipe.relax(points, iterations=1).cells(), vorpipe.transport(points).cells(),
                       vorpipe.draw(points, tmp_path / 'x.svg')):
            assert result.index.tolist() == ['f', 'h', 'm']
        assert diagram.to_dataframe().index.equals(points.index) and diagram.to_geopandas().index.equals(points.index)
    some = vorpipe.transport(frame, masses=[1, 0, 3], normalize=True, skip_zero=True)
    assert some.cells().index.tolist() == ['f', 'm'] and some.cells().attributes['name'].tolist() == NAMES[::2]
    assert quietly({'x': [1, 2], 'y': [1, 3]}).index is None
    assert quietly({'x': [1, 2], 'y': [1, 3]}).to_dataframe().index.tolist() == [0, 1]


def test_a_table_has_measures_and_attributes():
    pandas = pytest.importorskip('pandas', reason='there is no pandas')
    points = pandas.DataFrame({'x': [1, 2, 4, 9], 'y': [1, 3, 2, 9], 'area': [7, 8, 9, 9],
                               'radius': [0.5, 0.5, 0.1, 0]})
    diagram = quietly(points, domain=(0, 0, 5, 5), density=np.ones((5, 5)))
    found = diagram.to_dataframe()
    assert list(found) == ['x', 'y', 'weight', 'status', 'owner', 'area', 'perimeter', 'centroid_x', 'centroid_y',
                           'vertices', 'mass', 'mass_centroid_x', 'mass_centroid_y', 'input_area']
    assert found['area'].sum() == 25 and found['input_area'].tolist() == [7, 8, 9, 9]
    assert found['status'].tolist() == ['ok'] * 3 + ['empty'] and found['vertices'][0] == len(diagram[0])
    found.loc[0, 'area'] = 1
    assert 'perimeter' not in quietly(points, detail='measures').to_dataframe()


def test_voronoi_polygons_keeps_rows_labels_columns_and_system():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    pandas = pytest.importorskip('pandas', reason='there is no pandas')
    frame = towns(geopandas, people=pandas.array([770, None, 1500], dtype='Int64'), area=[1.5, 2.5, 3.5])
    frame['built'] = pandas.to_datetime(['1900-01-01', None, '1950-02-03'])
    cells = vorpipe.voronoi_polygons(frame)
    assert cells.crs == frame.crs and cells.index.equals(frame.index) and list(cells) == list(frame)
    pandas.testing.assert_frame_equal(pandas.DataFrame(cells.drop(columns='geometry')),
                                      pandas.DataFrame(frame.drop(columns='geometry')))
    assert cells.contains(frame).all() and frame.geom_type.eq('Point').all()
    assert np.allclose(cells.area, quietly(frame).areas, rtol=1e-9)
    series = vorpipe.voronoi_polygons(frame.geometry.rename('place'))
    assert isinstance(series, geopandas.GeoSeries) and series.name == 'place'
    assert series.geom_equals(cells.geometry).all()
    other = vorpipe.voronoi_polygons(frame.rename_geometry('seat'))
    assert other.geometry.name == 'seat' and 'geometry' not in other


def test_voronoi_polygons_takes_polygons_for_a_domain():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    geometry = pytest.importorskip('shapely.geometry')
    frame = towns(geopandas)
    country = geopandas.GeoDataFrame(geometry=frame.buffer(1e5).rename('x'), crs=frame.crs)
    land = country.unary_union
    for domain in (country, country.geometry, land):
        cells = vorpipe.voronoi_polygons(frame, domain)
        assert cells.area.sum() == pytest.approx(land.area) and cells.within(land.buffer(1)).all()
    advice = 'the outline is in EPSG:4326, points in EPSG:25832; take one .*, as to_crs."EPSG:25832". does'
    with pytest.raises(vorpipe.InputError, match=f'^domain: {advice}'):
        vorpipe.voronoi_polygons(frame, country.to_crs(4326))
    far = geometry.box(0, 0, 1e6, 7e6)
    grown = vorpipe.voronoi_polygons(frame, extend_to=geopandas.GeoSeries([far])).unary_union
    assert far.within(grown.buffer(1)) and grown.bounds[3] == 7e6
    with pytest.raises(vorpipe.InputError, match='^extend_to: is for a box around the points'):
        vorpipe.voronoi_polygons(frame, 'hull', extend_to=far)
    with pytest.raises(vorpipe.InputError, match='^extend_to: a str is neither'):
        vorpipe.voronoi_polygons(frame, extend_to='wide')


def test_voronoi_polygons_has_empty_cells_edges_and_several_points_of_a_row():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    geometry = pytest.importorskip('shapely.geometry')
    shapes = [geometry.MultiPoint([(0, 0), (2, 0)]), geometry.Point(1, 1), geometry.Point(9, 9)]
    frame = geopandas.GeoDataFrame({'n': [1, 2, 3]}, geometry=shapes, index=[7, 7, 5])
    cells = vorpipe.voronoi_polygons(frame, (0, 0, 3, 3))
    assert cells.index.tolist() == [7, 7, 7, 5] and cells['n'].tolist() == [1, 1, 2, 3]
    assert cells.is_empty.tolist() == [False] * 3 + [True] and cells.area.sum() == 9
    edges = vorpipe.voronoi_polygons(frame, (0, 0, 3, 3), only_edges=True)
    assert edges.geom_type.eq('LineString').all()
    # Those at the domain's border, 12 long, are of one cell, all others of two.
    assert edges.unary_union.length == pytest.approx((cells.geometry[:3].length.sum() + 12) / 2)
    with pytest.raises(vorpipe.InputError, match='^points: a list is neither a GeoDataFrame nor a GeoSeries'):
        vorpipe.voronoi_polygons(CITIES)


def test_voronoi_polygons_leaves_rows_without_a_geometry_without_one():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    geometry = pytest.importorskip('shapely.geometry')
    shapes = [geometry.Point(1, 1), None, geometry.MultiPoint([(2, 1), (2, 2)]), geometry.Point()]
    frame = geopandas.GeoDataFrame({'n': [1, 2, 3, 4]}, geometry=shapes, index=list('abcd'), crs=25832)
    domain = geopandas.GeoSeries([None, geometry.box(0, 0, 3, 3)], crs=25832)
    with pytest.warns(vorpipe.InputWarning, match='^points: 2 of 4 rows have no geometry, and get none$'):
        cells = vorpipe.voronoi_polygons(frame, domain)
    assert cells.index.tolist() == list('abccd') and cells['n'].tolist() == [1, 2, 3, 3, 4] and cells.crs == frame.crs
    assert cells.geometry.isna().tolist() == [False, True, False, False, True] and cells.area.sum() == 9
    with pytest.warns(vorpipe.InputWarning, match='2 of 3 rows'):
        series = vorpipe.voronoi_polygons(frame.geometry[['d', 'a', 'b']], domain, weights=[5, 0, 7])
    assert series.isna().tolist() == [True, False, True] and series.loc['a'].area == 9
    with pytest.warns(vorpipe.InputWarning, match='2 of 2 rows'):
        assert vorpipe.voronoi_polygons(frame.loc[['b', 'd']]).geometry.isna().all()
    for empty in (frame[:0], frame.geometry[:0]):
        with warnings.catch_warnings():
            warnings.simplefilter('error', vorpipe.InputWarning)
            nothing = vorpipe.voronoi_polygons(empty)
        assert type(nothing) is type(empty) and len(nothing) == 0 and nothing.crs == frame.crs
        assert list(nothing) == list(empty)
    with pytest.raises(vorpipe.InputError, match='^domain: it has no ring'):
        vorpipe.cells([(0, 0), (1, 1)], domain=domain[:1])


def test_voronoi_polygons_of_degrees_say_so_or_are_projected():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    frame = towns(geopandas).to_crs(4326)
    with pytest.warns(vorpipe.InputWarning, match='project="auto" makes a local plane'):
        plain = vorpipe.voronoi_polygons(frame)
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        cells = vorpipe.voronoi_polygons(frame, project='auto')
    assert cells.crs == frame.crs and not cells.geom_equals(plain).any()
    # Each point of an edge is as far from one town as from the other on the Earth, nearly.
    geod = pytest.importorskip('pyproj').Geod(ellps='WGS84')

    def unevenness(found):
        middle = found.geometry.iloc[0].intersection(found.geometry.iloc[1]).interpolate(0.5, normalized=True)
        away = [geod.inv(middle.x, middle.y, *city)[2] for city in (FRANKFURT, HAMBURG)]
        return abs(away[0] - away[1]) / away[0]

    assert unevenness(cells) < 0.03 < unevenness(plain)


def test_another_system_than_that_of_the_points_is_refused():
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    frame = towns(geopandas)
    with pytest.raises(vorpipe.InputError, match='^crs: is EPSG:4326, and the points say that they are in EPSG:25832'):
        vorpipe.cells(frame, crs='EPSG:4326')
    assert vorpipe.cells(frame, crs=25832).crs == 'EPSG:25832'
    assert vorpipe.voronoi_polygons(geopandas.GeoSeries(list(frame.geometry)), crs=25832).crs == 25832
