"""Files are those of the command line, byte for byte, and keywords are its options."""
import inspect
import os
import pathlib
import re
import subprocess

import pytest

import vorpipe

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITES = ROOT / 'tests/data/navaids.csv'
EXAMPLES = ROOT / 'docs/examples'
ITALY = EXAMPLES / 'italy.geojson'
BOX = (5, 47, 15, 55)


@pytest.fixture
def program(tmp_path):
    path = os.environ.get('VORPIPE_PROGRAM', '')
    if not os.path.exists(path):
        pytest.skip('the program is not built')

    def run(subcommand, *arguments):
        subprocess.run([path, subcommand, '--sites', SITES, '--backend', 'cpu', '--quiet', *arguments], check=True,
                       cwd=tmp_path)

    run.path = path
    return run


def same(tmp_path, name):
    return (tmp_path / name).read_bytes() == (tmp_path / f'by_{name}').read_bytes()


def test_cells_are_those_of_the_program(program, tmp_path):
    names = ['map.geojson', 'map.gpkg']
    program('cells', '--domain', '5,47,15,55', '--project', 'auto', '--only-cells', '-o', 'map.geojson', '-o',
            'map.gpkg', '--edges', 'edges.geojson')
    program('cells', '--domain', ITALY, '--project', '12,42', '-o', 'italy.csv', '-o', 'italy.npz')
    sites = vorpipe.read(SITES)
    diagram = vorpipe.cells(sites, domain=BOX, project='auto', backend='cpu')
    for name in names:
        diagram.save(tmp_path / f'by_{name}', only_cells=True)
    diagram.save_edges(tmp_path / 'by_edges.geojson')
    italy = vorpipe.cells(sites, domain=ITALY, project=(12, 42), backend='cpu')
    for name in ('italy.csv', 'italy.npz'):
        italy.save(tmp_path / f'by_{name}')
    assert [name for name in (*names, 'edges.geojson', 'italy.csv', 'italy.npz') if not same(tmp_path, name)] == []


def test_pictures_are_those_of_the_program(program, tmp_path):
    program('render', '--domain', '5,47,15,55', '--project', 'auto', '--color', 'area', '--legend', '--edges',
            '--edge-width', '2.5', '--show-sites', '--dual', '--labels', '--label-size', '6', '--antialias', '2',
            '--size', '300x300', '-o', 'p.png', '-o', 'p.pgw', '-o', 'p.svg', '-o',
            'p.pdf', '--ids', 'p.tif')
    sites = vorpipe.read(SITES)
    look = {'domain': BOX, 'project': 'auto', 'backend': 'cpu', 'color': 'area', 'legend': True, 'edges': True,
            'edge_width': 2.5, 'show_sites': True, 'dual': True, 'labels': True, 'label_size': 6, 'antialias': 2,
            'size': (300, 300)}
    picture = vorpipe.render(sites, **look)
    for name in ('p.png', 'p.pgw', 'p.tif'):
        picture.save(tmp_path / f'by_{name}')
    for name in ('p.svg', 'p.pdf'):
        vorpipe.draw(sites, tmp_path / f'by_{name}', **look)
    assert [name for name in ('p.png', 'p.pgw', 'p.tif', 'p.svg', 'p.pdf') if not same(tmp_path, name)] == []


@pytest.mark.parametrize('project', [None, 'auto'])
def test_cells_by_feature_are_those_of_the_program(program, tmp_path, project):
    geopandas, pandas = pytest.importorskip('geopandas'), pytest.importorskip('pandas')
    gauges = pandas.read_csv(EXAMPLES / 'rain.csv')
    catchments = geopandas.read_file(EXAMPLES / 'catchments.geojson')
    # Two features of one name are one, and one has none.
    catchments['name'] = ['Oker', None, 'Oker']
    gauges = geopandas.GeoDataFrame({'name': gauges.name.tolist()}, crs=catchments.crs, index=list('abcdefgh'),
                                    geometry=geopandas.points_from_xy(gauges.x, gauges.y))
    options = []
    if project:
        gauges, catchments, options = gauges.to_crs(4326), catchments.to_crs(4326), ['--project', project]
    gauges.to_file(tmp_path / 'gauges.gpkg')
    catchments.to_file(tmp_path / 'catchments.gpkg')
    subprocess.run([program.path, 'cells', '--sites', 'gauges.gpkg', '--domain', 'catchments.gpkg', '--by', 'name',
                    *options, '-o', 'shares.csv', '--quiet'], check=True, cwd=tmp_path)
    told = pandas.read_csv(tmp_path / 'shares.csv')
    for domain in (catchments, tmp_path / 'catchments.gpkg'):
        shares = vorpipe.voronoi_polygons(gauges, domain=domain, by='name', project=project)
        assert shares.name.fillna('').tolist() == told.name.fillna('').tolist()
        assert shares.index.tolist() == [gauges.index[site] for site in told.site]
        assert shares.site_name.tolist() == told.site_name.tolist()
        assert shares.share.tolist() == pytest.approx(told.share.tolist(), rel=1e-12)
        assert shares.to_crs(25832).area.tolist() == pytest.approx((told.area_km2 * 1e6).tolist(), rel=2e-3)
    with pytest.raises(vorpipe.InputError, match="^by: 'none' is no column of the domain, which has 'name'"):
        vorpipe.voronoi_polygons(gauges, domain=catchments, by='none')
    for wrong in ({'domain': (0, 0, 1, 1)}, {}, {'domain': catchments, 'only_edges': True}):
        with pytest.raises(vorpipe.InputError, match='^by: '):
            vorpipe.voronoi_polygons(gauges, by='name', **wrong)


# What the command line says in another way, and why.
OTHERWISE = {
    'points': '--sites names a file or a generator, these are at hand', 'path': '-o, or the file of --sites',
    'begin': '--case or --resume, or points at hand', 'attributes': 'columns of the file',
    'velocities': 'of the file', 'volumes': 'of the file', 'densities': 'of the file',
    'until': '--time; a fluid has a time already, that of its state',
    'progress': 'a function', 'callback': 'a function', 'session': 'an object'}
# By subcommand: options that this one alone has not, since a file or a case says it.
OF_FILES = {'fluid': {'weights', 'periodic', 'surface', 'diagrams'}}


@pytest.mark.parametrize('function, subcommand', [
    ('cells', 'cells'), ('render', 'render'), ('draw', 'render'), ('relax', 'relax'), ('transport', 'transport'),
    ('Fluid', 'fluid'), ('read', 'cells'), ('selftest', 'selftest'), ('devices', 'devices'), ('Session', 'cells')])
def test_keywords_are_the_options_of_the_command_line(program, function, subcommand):
    text = subprocess.run([program.path, subcommand, '--help'], check=True, capture_output=True, text=True).stdout
    options = {name.replace('-', '_') for name in re.findall(r'^ +--(?:no-)?([a-z][a-z-]+)', text, re.MULTILINE)}
    keywords = inspect.signature(getattr(vorpipe, function)).parameters.keys()
    assert keywords - options - OTHERWISE.keys() == OF_FILES.get(subcommand, set())
