"""Types: what the package says of itself, and what a program that uses it is told."""
import os
import pathlib
import subprocess
import sys

import pytest

import vorpipe

pytest.importorskip('mypy', reason='there is no mypy')
PACKAGE = pathlib.Path(vorpipe.__file__).parent
STRICT = '--config-file', str(pathlib.Path(__file__).resolve().parents[2] / 'pyproject.toml')

PROGRAM = '''
from typing import List, Optional

import numpy as np
import numpy.typing as npt

import vorpipe
from vorpipe.compat import Delaunay, Voronoi, voronoi_plot_2d


def progress(stage: str, part: float) -> Optional[bool]:
    return part < 0.5


diagram: vorpipe.Diagram = vorpipe.cells([[0, 0], [1, 1]], weights=[0.0, 0.1], periodic='xy', domain=(0, 0, 2, 2))
areas: npt.NDArray[np.float64] = diagram.areas
cell: vorpipe.Cell = diagram[0]
status: vorpipe.Status = cell.status
picture: vorpipe.Picture = vorpipe.render(np.zeros((1, 2)), size=(10, 10))
broken: List[str] = vorpipe.check(diagram)
same: bool = vorpipe.compare(diagram, diagram).agree
foam: vorpipe.Diagram3 = vorpipe.cells(vorpipe.read("random:10", dim=3), detail="all")
shapes: npt.NDArray[np.int64] = foam.orders(threshold=0.01) + foam.coordination(by="solid_angle")[:, None]
ties: int = vorpipe.compare(picture, picture).ties
sites: vorpipe.Sites = vorpipe.read('random:10', columns=('x', 2), missing='skip')
map_of: vorpipe.Diagram = vorpipe.cells(sites, domain='hull', margin='10%', project=(10.0, 50.0), crs=4326,
                                        attributes={'name': ['a', None]}, repair=True)
crs: Optional[str] = map_of.crs
names: List[str] = list(map_of.attributes)
map_of.save('map.gpkg', only_cells=True)
map_of.save_edges('edges.wkt')
drawn: vorpipe.Diagram = vorpipe.draw(sites, 'x.svg', color='area', color_range=(0, 1), legend=True, dot_size=3)
key = vorpipe.render(sites, color='area', color_scale='log', edge_width=2, fit='letterbox').key
scale: str = key.scale if key is not None else ''
with vorpipe.Session('cpu', threads=2) as session:
    name: str = session.device.name
    session.cells(np.zeros((3, 2)), progress=progress, check=True)
try:
    vorpipe.cells([])
except vorpipe.InputError as error:
    subject: Optional[str] = error.subject
owners: npt.NDArray[np.int32] = vorpipe.cells({'x': [0, 1], 'y': [1, 2], 'name': ['a', 'b']}).owners
held: npt.NDArray[np.int64] = diagram.locate((0.5, 0.5))
fluid = vorpipe.Fluid('shear', particles=50, session=None)
fluid.run(steps=2, callback=lambda step: step.time < 1)
velocities: npt.NDArray[np.float64] = fluid.velocities
ended: Optional[str] = fluid.end
discs: vorpipe.Diagram = vorpipe.transport(np.eye(2), domain=(0, 0, 1, 1), fill=0.5).cells()
border: List[vorpipe.BorderPart] = discs[0].border()
ridges: List[List[int]] = Voronoi(np.eye(2)).ridge_vertices
triangles: npt.NDArray[np.int32] = Delaunay(np.eye(2)).simplices
'''


@pytest.fixture(scope='module', autouse=True)
def cache(tmp_path_factory):
    """What mypy found of NumPy's types, which takes it ten seconds each time."""
    os.environ['MYPY_CACHE_DIR'] = str(tmp_path_factory.mktemp('cache'))
    yield
    del os.environ['MYPY_CACHE_DIR']


def mypy(*arguments, folder):
    environment = {**os.environ, 'MYPYPATH': str(PACKAGE.parent)}
    return subprocess.run([sys.executable, '-B', '-m', *arguments], capture_output=True, text=True, cwd=folder,
                          env=environment)


def test_mypy_accepts_a_program_and_refuses_a_wrong_one(tmp_path):
    (tmp_path / 'program.py').write_text(PROGRAM)
    checked = mypy('mypy', *STRICT, 'program.py', folder=tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    (tmp_path / 'wrong.py').write_text('import vorpipe\nx: int = vorpipe.cells([[0, 0]]).areas\n'
                                       'vorpipe.compare(vorpipe.cells([[0, 0]]), 1)\n'
                                       'vorpipe.render([[0, 0]], edges="thick")\n'
                                       'vorpipe.draw([[0, 0]], "", colour=1)\n')
    checked = mypy('mypy', *STRICT, 'wrong.py', folder=tmp_path)
    assert checked.stdout.count('error:') == 4, checked.stdout


def test_the_package_is_typed_throughout(tmp_path):
    checked = mypy('mypy', *STRICT, '-p', 'vorpipe', folder=tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_the_stub_says_what_the_module_has(tmp_path):
    # What is of pybind11: the type of its types, and that objects which only vorpipe makes cannot be made.
    (tmp_path / 'allowed').write_text(r'vorpipe\._vorpipe\.[A-Z]\w+(\.__init__)?')
    checked = mypy('mypy.stubtest', '--allowlist', 'allowed', 'vorpipe._vorpipe', folder=tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_all_that_is_public_has_a_docstring():
    for name in vorpipe.__all__:
        thing = getattr(vorpipe, name)
        if callable(thing):
            assert thing.__doc__ and thing.__doc__.strip(), name
    for kind in (vorpipe.Diagram, vorpipe.Fluid, vorpipe.Picture, vorpipe.Transported):
        for name, member in vars(kind).items():
            assert name.startswith('_') or member.__doc__, f'{kind.__name__}.{name}'
