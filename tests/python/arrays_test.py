"""Arrays show the memory of results, and keep it."""
import gc
import sys

import numpy as np
import pytest

import vorpipe

OF_DIAGRAMS = ['status', 'owners', 'areas', 'perimeters', 'centroids', 'second_moments', 'cell_offsets', 'cell_vertices',
               'neighbors', 'edge_lengths', 'triangles', 'ring_starts', 'mass', 'mass_centroids']


@pytest.fixture(scope='module')
def diagram():
    return vorpipe.cells(vorpipe.generate('random', 1000), density=np.ones((2, 2)))


@pytest.mark.parametrize('name', OF_DIAGRAMS)
def test_arrays_of_a_diagram_are_read_only_views(name, diagram):
    array = getattr(diagram, name)
    assert not array.flags.writeable and array.flags.c_contiguous and array.flags.owndata == (array.size == 0)
    with pytest.raises(ValueError):
        array[...] = 0
    if array.size:
        assert np.shares_memory(array, getattr(diagram, name))
        copy = array.copy()
        copy[...] = 0


@pytest.mark.parametrize('options', [
    {}, {'domain': (0, 0, 1, 1), 'periodic': 'xy'},
    {'domain': [[(0, 0), (1, 0), (1, 1), (.7, 1), (.7, .3), (.3, .3), (.3, 1), (0, 1)],
                [(.1, .5), (.1, .6), (.2, .6), (.2, .5)]]}])
def test_triangles_of_a_mesh_fill_each_cell(options):
    points = np.random.default_rng(12).random((60, 2), dtype=np.float32)  # which are taken as they are
    diagram = vorpipe.cells(points, **options)
    vertices, owners, triangles = diagram.triangle_mesh()
    assert (vertices.dtype, owners.dtype, triangles.dtype) == (np.float32, np.uint32, np.uint32)
    assert np.array_equal(vertices, diagram.cell_vertices.astype(np.float32))
    a, b, c = vertices[triangles].astype(float).transpose(1, 0, 2)
    areas = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert (owners[triangles] == owners[triangles][:, :1]).all()
    filled = np.bincount(owners[triangles[:, 0]], weights=areas, minlength=60)
    assert np.allclose(filled, diagram.areas, atol=1e-6, rtol=0) and areas.min() > -1e-7
    with pytest.raises(vorpipe.InputError, match='polygons'):
        vorpipe.cells(points, detail='measures').triangle_mesh()


def test_arrays_have_types_that_numpy_computes_with(diagram):
    assert (diagram.cell_offsets + diagram.neighbors[:1]).dtype == np.int64
    assert diagram.sites[diagram.triangles].shape == (len(diagram.triangles), 3, 2)


def test_indices_have_signs_so_that_their_differences_do(diagram):
    shared = diagram.topology()
    for array in (diagram.owners, diagram.triangles, shared.vertex_of, shared.edge_of, shared.edge_vertices,
                  vorpipe.render(diagram.sites, size=(20, 20)).owners):
        assert array.dtype == np.int32 and not array.flags.writeable
    one, other = diagram.triangles[:, 1], diagram.triangles[:, 2]
    assert (one - other).min() < 0 < (one - other).max()
    found = diagram.locate([diagram.sites[0], (1e9, 0)])
    assert found.tolist() == [0, vorpipe.NO_SITE] and found.dtype == np.int64


def test_arrays_outlive_the_diagram(random):
    points = random.random((5000, 2))
    diagram = vorpipe.cells(points, domain=(0, 0, 1, 1))
    areas, vertices = diagram.areas, diagram[7].vertices
    expected = areas.copy(), vertices.copy()
    del diagram
    gc.collect()
    others = [vorpipe.cells(random.random((5000, 2))) for _ in range(5)]
    assert np.array_equal(areas, expected[0]) and np.array_equal(vertices, expected[1])
    assert len(others) == 5


def test_a_result_goes_with_its_last_array():
    held = memory()
    arrays = [vorpipe.cells(vorpipe.generate('random', 50_000, seed), detail='polygons').areas for seed in range(3)]
    del arrays
    gc.collect()
    for seed in range(10):
        vorpipe.cells(vorpipe.generate('random', 50_000, seed), detail='polygons')
    assert memory() - held < 125e6


def memory():
    """Bytes that this process has."""
    if not sys.platform.startswith('linux'):
        pytest.skip('only Linux tells how much memory a process has by /proc')
    with open('/proc/self/statm') as file:
        return int(file.read().split()[1]) * 4096


def test_arrays_of_a_picture_are_read_only_views():
    picture = vorpipe.render([[0.2, 0.5], [0.8, 0.5]], domain=(0, 0, 1, 1), size=(30, 20))
    for array, shape, kind in ((picture.rgba, (20, 30, 4), np.uint8), (picture.ids, (20, 30), np.uint32)):
        assert array.shape == shape and array.dtype == kind
        assert not array.flags.owndata and not array.flags.writeable
    ids = picture.ids
    del picture
    gc.collect()
    assert ids[:, :15].max() == 0 and ids[:, 15:].min() == 1
