"""What is found in cells once they are there: what they share, the cells of places, the bytes of files."""
import pathlib

import numpy as np
import pytest

import vorpipe

UNIT = (0, 0, 1, 1)


@pytest.fixture(scope='module')
def diagram():
    return vorpipe.cells(vorpipe.generate('random', 2000, 3), domain=UNIT)


def test_shared_vertices_and_edges_satisfy_eulers_formula(diagram):
    shared = diagram.topology()
    assert len(shared.vertices) - len(shared.edge_cells) + len(diagram) + 1 == 2
    assert np.array_equal(shared.vertices[shared.vertex_of], diagram.cell_vertices)
    lengths = np.linalg.norm(np.diff(shared.vertices[shared.edge_vertices], axis=1)[:, 0], axis=1)
    assert np.allclose(lengths[shared.edge_of], diagram.edge_lengths, rtol=1e-9, atol=1e-15)


def test_each_pair_of_neighbors_is_an_edge(diagram):
    cells = diagram.topology().edge_cells
    inner = cells[cells[:, 1] >= 0]
    assert np.array_equal(np.unique(inner, axis=0), diagram.neighbor_pairs())


def test_topology_says_how_much_there_is():
    assert repr(vorpipe.cells([(0.25, 0.5), (0.75, 0.5)], domain=(0, 0, 1, 1)).topology()) == (
        '<vorpipe.Topology: 6 vertices, 7 edges>')


def test_topology_takes_polygons():
    with pytest.raises(vorpipe.InputError, match='topology takes'):
        vorpipe.cells([(0.5, 0.5)], domain=UNIT, detail='measures').topology()


def test_places_have_the_nearest_point(diagram):
    places = np.random.default_rng(5).random((500, 2))
    distances = np.linalg.norm(places[:, None] - diagram.sites[None], axis=2)
    assert np.array_equal(diagram.locate(places), distances.argmin(axis=1))
    assert np.array_equal(diagram.locate(diagram.sites), np.arange(len(diagram)))
    assert diagram.locate([(2, 2)])[0] == vorpipe.NO_SITE


def test_places_of_a_torus_wrap_around():
    torus = vorpipe.cells([(0.1, 0.1), (0.6, 0.6)], domain=UNIT, periodic='xy')
    assert torus.locate([(0.98, 0.98), (1.1, 0.1), (-0.4, 0.6)]).tolist() == [0, 0, 1]


@pytest.mark.parametrize('extension', '.csv .npz .geojson .geojsonl .gpkg .svg .obj .ply .vtk .vtp .vtu .wkt'.split())
def test_bytes_are_those_of_the_file(diagram, extension, tmp_path):
    path = pathlib.Path(tmp_path / f'cells{extension}')
    diagram.save(path)
    assert diagram.to_bytes(extension) == path.read_bytes()


def test_bytes_take_the_detail_of_their_format():
    with pytest.raises(vorpipe.InputError, match='detail'):
        vorpipe.cells([(0.5, 0.5)], domain=UNIT, detail='measures').to_bytes('.npz')
    with pytest.raises(vorpipe.InputError, match='unknown kind'):
        vorpipe.cells([(0.5, 0.5)], domain=UNIT).to_bytes('.xls')
