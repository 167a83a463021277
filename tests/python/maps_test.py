"""Degrees, planes, and the domains that points and outlines give."""
import shutil
import sys
import warnings

import numpy as np
import pytest

import vorpipe

BOX = (5, 45, 15, 55)
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
BESIDE = [(1, 0), (2, 0), (2, 1), (1, 1)]
BOWTIE = [(0, 0), (1, 1), (1, 0), (0, 1)]


@pytest.fixture
def degrees(random):
    return random.uniform((5, 45), (15, 55), (60, 2))


def test_cells_of_a_plane_come_back_in_degrees(degrees):
    diagram = vorpipe.cells(degrees, domain=BOX, project='auto', check=True)
    # Of the zone from 45 to 55 degrees on WGS 84, 10 of 360 degrees.
    assert diagram.area_sum() == pytest.approx(793_000, rel=0.02)
    assert np.array_equal(diagram.sites, degrees) and diagram.crs == 'EPSG:4326'
    low, high = diagram.cell_vertices.min(axis=0), diagram.cell_vertices.max(axis=0)
    assert np.allclose([*low, *high], BOX, atol=1e-3)
    assert diagram.center == pytest.approx((10, 50), abs=0.5)
    assert diagram.check() == [] and vorpipe.compare(diagram, diagram).agree
    assert np.array_equal(diagram.locate(degrees), np.arange(60))


def test_the_center_can_be_named(degrees):
    assert vorpipe.cells(degrees, project=(8, 50)).center == (8, 50)
    with pytest.raises(vorpipe.InputError, match='^project: ') as caught:
        vorpipe.cells(degrees, project=(-170, -50))
    assert caught.value.subject == 'project'


@pytest.mark.parametrize('arguments, argument, message', [
    ({'project': 'mercator'}, 'project', '"auto" nor'), ({'project': (1, 2, 3)}, 'project', '"auto" nor'),
    ({'project': True, 'periodic': 'x', 'domain': BOX}, 'periodic', 'the Earth does not repeat itself'),
    ({'project': True, 'crs': 'EPSG:32632'}, 'project', 'those of a plane'),
    ({'domain': 'box'}, 'domain', 'neither "hull" nor a file'),
    ({'margin': 'wide'}, 'margin', '10%'), ({'margin': -1}, 'margin', ''),
    ({'margin': 1, 'domain': BOX}, 'margin', 'give one of them'),
    ({'domain': (177, -20, -177, -15)}, 'domain', 'in degrees, across the antimeridian, xmax is 183'),
    ({'repair': True}, 'repair', 'there is none'), ({'domain': BOWTIE}, 'domain', 'repair mends it')])
def test_what_contradicts_itself_is_refused(degrees, arguments, argument, message):
    if arguments.get('crs'):
        pytest.importorskip('pyproj', reason='there is no pyproj')
    with pytest.raises(vorpipe.InputError, match=message) as caught:
        vorpipe.cells(degrees, **arguments)
    assert caught.value.subject == argument and str(caught.value).startswith(f'{argument}: ')


def test_a_hull_and_a_margin_are_domains(random):
    points = random.random((50, 2))
    spatial = pytest.importorskip('scipy.spatial')
    assert vorpipe.cells(points, domain='hull').area_sum() == pytest.approx(spatial.ConvexHull(points).volume)
    low, high = points.min(axis=0), points.max(axis=0)
    assert np.allclose(vorpipe.cells(points, margin=2).domain, [*low - 2, *high + 2])
    part = 0.1 * max(high - low)
    assert np.allclose(vorpipe.cells(points, margin='10%').domain, [*low - part, *high + part])


def test_outlines_are_mended_with_a_warning():
    points = [(0.5, 0.5), (1.5, 0.5)]
    with pytest.warns(vorpipe.InputWarning, match='^domain: ') as told:
        diagram = vorpipe.cells(points, domain=[[SQUARE], [BESIDE]])
    assert diagram.areas.tolist() == [1, 1] and len(diagram.ring_starts) == 2
    assert told[0].filename == __file__
    with pytest.warns(vorpipe.InputWarning, match='^domain: '):
        assert vorpipe.cells(points, domain=BOWTIE, repair=True).area_sum() == 0.5


def test_coordinates_that_look_like_degrees_are_told(random):
    world = random.uniform((-180, -90), (180, 90), (100, 2))
    world[0] = -170, 0
    world[1] = 170, 0
    with pytest.warns(vorpipe.InputWarning, match='^points: coordinates look like degrees.*project="auto"') as told:
        vorpipe.cells(world)
    assert told[0].filename == __file__
    with pytest.warns(vorpipe.InputWarning, match='look like degrees') as told, vorpipe.Session('cpu') as session:
        session.render(world, size=(20, 20))
    assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        vorpipe.cells(world * 10)
        vorpipe.cells(world[:1], crs='EPSG:32632')


def test_a_coordinate_reference_system_goes_along(tmp_path):
    points = [(500_000, 5_000_000), (510_000, 5_020_000)]
    diagram = vorpipe.cells(points, crs='EPSG:32632', attributes={'name': ['a', 'b']})
    assert diagram.crs == 'EPSG:32632'
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    assert vorpipe.cells(points, crs=geopandas.GeoSeries(crs=25832).crs).crs == 'EPSG:25832'
    with pytest.raises(vorpipe.InputError, match="^crs: 'nowhere'"):
        vorpipe.cells(points, crs='nowhere')
    frame = diagram.to_geopandas()
    assert frame.crs.to_epsg() == 32632 and frame['name'].tolist() == ['a', 'b']
    frame.set_geometry(geopandas.points_from_xy(frame.x, frame.y), crs=frame.crs)[['name', 'geometry']].to_file(
        tmp_path / 'points.gpkg')
    sites = vorpipe.read(tmp_path / 'points.gpkg')
    assert sites.crs == 'EPSG:32632' and sites.attributes['name'].tolist() == ['a', 'b']
    assert np.array_equal(sites.points, points)


@pytest.mark.filterwarnings('ignore:.*look like degrees', 'ignore:Geometry is in a geographic')
def test_other_programs_read_where_cells_are(degrees, tmp_path):
    geopandas = pytest.importorskip('geopandas', reason='there is no geopandas')
    for crs, code in ((3035, 3035), ('EPSG:4258', 4258), (None, None)):
        diagram = vorpipe.cells(degrees, domain=BOX, crs=crs, attributes={'tag': range(60)})
        diagram.save(tmp_path / f'{code}.gpkg')
        frame = geopandas.read_file(tmp_path / f'{code}.gpkg')
        assert code is None or frame.crs.to_epsg() == code
        assert frame['tag'].tolist() == list(range(60)) and np.allclose(frame.area, diagram.areas)


def test_codes_need_no_pyproj(monkeypatch):
    monkeypatch.setitem(sys.modules, 'pyproj', None)
    points = [(0, 0), (1, 1)]
    with pytest.warns(vorpipe.InputWarning, match='look like degrees'):
        assert vorpipe.cells(points, crs='epsg:4326').crs == 'EPSG:4326'
    assert vorpipe.cells(points, crs=32632).crs == 'EPSG:32632'
    with pytest.raises(vorpipe.InputError, match='^crs: .*there is no pyproj'):
        vorpipe.cells(points, crs='+proj=utm +zone=32')


def test_geopandas_gets_degrees_and_attributes(degrees):
    pytest.importorskip('geopandas', reason='there is no geopandas')
    frame = vorpipe.cells(degrees, project=True, attributes={'area': np.arange(60.0), 'tag': ['x'] * 60}).to_geopandas()
    assert frame.crs.to_epsg() == 4326 and frame['input_area'].tolist() == list(range(60))
    assert set(frame['tag']) == {'x'} and (frame['area'] > 0).all()
    in_plane = frame.to_crs('+proj=laea +lat_0=50 +lon_0=10 +units=km')
    assert np.allclose(in_plane.area, frame['area'], rtol=1e-3)


def test_different_systems_are_refused_by_name(degrees, tmp_path):
    outline = tmp_path / 'city.geojson'
    crs = '"crs":{"type":"name","properties":{"name":"EPSG:25832"}},'
    ring = '[[[0,0],[9e5,0],[9e5,9e5],[0,0]]]'
    outline.write_text('{"type":"Polygon",' + crs + '"coordinates":' + ring + '}')
    with pytest.raises(vorpipe.InputError, match='city.geojson is in EPSG:25832, points in EPSG:4326') as caught:
        vorpipe.cells(degrees, domain=outline, crs='EPSG:4326')
    assert caught.value.subject == 'domain'
    with pytest.warns(vorpipe.InputWarning, match='domain: no site lies in the box 0,0,900000,900000'):
        vorpipe.cells(-degrees, domain=outline)

    class Frame:
        crs = 'EPSG:25832'
        __geo_interface__ = {'type': 'Polygon', 'coordinates': [[(0, 0), (9, 0), (9, 9), (0, 0)]]}

    with pytest.raises(vorpipe.InputError, match='the outline is in EPSG:25832, points in EPSG:4326'):
        vorpipe.cells(degrees, domain=Frame(), crs='EPSG:4326')


def test_points_adopt_the_system_of_their_outline(tmp_path):
    geopandas = pytest.importorskip('geopandas')
    shapely = pytest.importorskip('shapely')
    frame = geopandas.GeoDataFrame({'name': ['a']}, geometry=[shapely.geometry.box(0, 0, 4000, 2000)], crs=25832)
    points = [[1000, 1000], [3000, 1000]]
    for name in ('square.gpkg', 'square.shp'):
        if name.endswith('.shp') and shutil.which('ogr2ogr') is None:
            continue
        frame.to_file(tmp_path / name)
        diagram = vorpipe.cells(points, domain=tmp_path / name)
        assert diagram.crs == 'EPSG:25832' and diagram.areas.tolist() == [4e6, 4e6]
        diagram.save(tmp_path / 'cells.gpkg')
        cells = geopandas.read_file(tmp_path / 'cells.gpkg')
        assert cells.crs.to_epsg() == 25832 and cells['area_km2'].tolist() == [4, 4]


def test_cells_around_a_pole_are_polygons(tmp_path):
    ring = [(longitude, 75) for longitude in range(0, 360, 45)]
    diagram = vorpipe.cells([*ring, (0, 90)], domain=(-180, 60, 180, 90), project='auto')
    across = diagram[4].vertices[:, 0]
    assert across.min() == pytest.approx(157.5) and across.max() == pytest.approx(202.5)
    assert diagram.sites[4].tolist() == [180, 75]
    geometry = pytest.importorskip('shapely.geometry', reason='there is no shapely')
    shapes = diagram.to_shapely()
    assert all(shape.is_valid for shape in shapes)
    assert all(shape.intersects(geometry.Point(point)) for shape, point in zip(shapes, diagram.sites))
    assert shapes[8].bounds[0] == -180 and shapes[8].bounds[2:] == (180, 90)
