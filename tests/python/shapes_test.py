"""Cells for matplotlib, shapely and GeoPandas."""
import numpy as np
import pytest

import vorpipe

RING = [(0, 0), (4, 0), (4, 3), (0, 3)]
HOLE = [(1, 1), (1, 2), (3, 2), (3, 1)]
# One point, both of whose arms are its own.
FORK = [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)]


@pytest.fixture
def diagram(random):
    return vorpipe.cells(np.concatenate((random.random((100, 2)), [[9, 9]])), domain=(0, 0, 1, 1))


def test_shapely_has_the_same_areas(diagram):
    pytest.importorskip('shapely')
    shapes = diagram.to_shapely()
    assert np.allclose([shape.area for shape in shapes], diagram.areas, rtol=1e-9)
    assert np.allclose([shape.length for shape in shapes], diagram.perimeters)
    assert shapes[-1].is_empty and all(shape.is_valid for shape in shapes)


def test_shapely_has_holes_and_several_parts():
    geometry = pytest.importorskip('shapely.geometry')
    holed, = vorpipe.cells([[2, 1.5]], outline=geometry.Polygon(RING, [HOLE])).to_shapely()
    assert holed.area == 10 and len(holed.interiors) == 1
    cells = vorpipe.cells([[1.5, 0], [1.5, 2.5]], outline=geometry.Polygon(FORK))
    shapes = cells.to_shapely()
    assert shapes[1].geom_type == 'MultiPolygon' and len(shapes[1].geoms) == 2
    assert np.allclose([shape.area for shape in shapes], cells.areas)
    two = geometry.MultiPolygon([geometry.Polygon(RING), geometry.box(5, 0, 6, 1)])
    assert vorpipe.cells([[0, 0]], outline=two).areas.tolist() == [13]


def test_geopandas_has_a_row_for_each_point(diagram):
    pytest.importorskip('geopandas', reason='there is no geopandas')
    frame = diagram.to_geopandas(crs='EPSG:32632')
    assert len(frame) == len(diagram) and frame.crs.to_epsg() == 32632
    assert np.allclose(frame.geometry.area, frame['area'])
    assert frame['status'].tolist() == ['ok'] * 100 + ['empty']


def test_matplotlib_draws_what_the_cells_are(diagram):
    pyplot = pytest.importorskip('matplotlib.pyplot')
    figure, ax = pyplot.subplots()
    assert diagram.plot(ax, cmap='magma', edgecolor='white', show_sites=True) is ax
    drawn, = ax.collections
    assert len(drawn.get_paths()) == 100
    assert np.array_equal(drawn.get_array(), diagram.areas[:100])
    assert ax.get_xlim() == (0, 1) and ax.get_ylim() == (0, 1)
    figure.canvas.draw()
    pyplot.close(figure)


def test_matplotlib_leaves_holes_empty():
    pyplot = pytest.importorskip('matplotlib.pyplot')
    figure = pyplot.figure(figsize=(4, 3), dpi=50)
    ax = figure.add_axes((0, 0, 1, 1), frameon=False)
    vorpipe.cells([[2, 1.5]], outline=[RING, HOLE]).plot(ax, color=None, facecolor='red')
    ax.axis('off')
    figure.canvas.draw()
    pixels = np.asarray(figure.canvas.buffer_rgba())
    assert pixels[75, 100].tolist()[:3] == [255, 255, 255] and pixels[20, 20].tolist()[:3] == [255, 0, 0]
    pyplot.close(figure)


def test_colors_are_by_an_array_or_a_name(diagram):
    pyplot = pytest.importorskip('matplotlib.pyplot')
    figure, ax = pyplot.subplots()
    diagram.plot(ax, color=np.arange(101))
    diagram.plot(ax, color='perimeters')
    with pytest.raises(vorpipe.InputError, match="color: 'size' is none of areas"):
        diagram.plot(ax, color='size')
    with pytest.raises(vorpipe.InputError, match='color: shape'):
        diagram.plot(ax, color=[1, 2])
    pyplot.close(figure)


def test_pictures_lie_where_their_domain_is():
    pyplot = pytest.importorskip('matplotlib.pyplot')
    picture = vorpipe.render([[1, 1], [3, 2]], domain=(0, 0, 4, 3), size=(40, 30))
    figure, ax = pyplot.subplots()
    picture.plot(ax)
    assert ax.get_xlim() == (0, 4) and ax.get_ylim() == (0, 3)
    pyplot.close(figure)
