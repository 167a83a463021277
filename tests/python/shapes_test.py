"""Cells for matplotlib, shapely, GeoPandas and notebooks."""
import base64
import io
import re

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
    holed, = vorpipe.cells([[2, 1.5]], domain=geometry.Polygon(RING, [HOLE])).to_shapely()
    assert holed.area == 10 and len(holed.interiors) == 1
    cells = vorpipe.cells([[1.5, 0], [1.5, 2.5]], domain=geometry.Polygon(FORK))
    shapes = cells.to_shapely()
    assert shapes[1].geom_type == 'MultiPolygon' and len(shapes[1].geoms) == 2
    assert np.allclose([shape.area for shape in shapes], cells.areas)
    two = geometry.MultiPolygon([geometry.Polygon(RING), geometry.box(5, 0, 6, 1)])
    assert vorpipe.cells([[0, 0]], domain=two).areas.tolist() == [13]


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
    vorpipe.cells([[2, 1.5]], domain=[RING, HOLE]).plot(ax, color=None, facecolor='red')
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


def shown(value):
    """The picture that a notebook shows, and its caption."""
    png, text = value._repr_png_(), value._repr_html_()
    picture = r'<div><img src="data:image/png;base64,([^"]+)" alt="[^"]+"><br><small>(.+)</small></div>'
    source, caption = re.fullmatch(picture, text).groups()
    assert base64.b64decode(source) == png
    return pytest.importorskip('PIL.Image').open(io.BytesIO(png)), caption


def test_notebooks_show_a_small_picture(diagram):
    drops = vorpipe.transport(diagram.sites[:100], domain=(0, 0, 1, 1), fill=0.5)
    for value in (diagram, vorpipe.cells(diagram.sites[:100], domain=[(0, 0), (2, 0), (2, 1), (0, 1)]), drops,
                  vorpipe.relax(diagram.sites[:100], domain=(0, 0, 1, 1), iterations=2)):
        image, caption = shown(value)
        assert max(image.size) == 400 and len(image.getcolors(1 << 20)) > 50
        assert caption.startswith(f'&lt;vorpipe.{type(value).__name__}: ') and str(len(value)) in caption
    assert shown(diagram)[0].size == (400, 400)
    assert shown(vorpipe.cells(diagram.sites, domain=(0, 0, 4, 1), detail='measures'))[0].size == (400, 100)
    pixels = np.asarray(shown(drops)[0].convert('RGBA'))
    assert 0.4 < (pixels[..., 3] == 0).mean() < 0.6
    svg = vorpipe.cells(vorpipe.generate('random', 50), domain=(0, 0, 2, 1))._repr_svg_()
    assert svg.startswith('<svg') and 'width="400" height="200"' in svg and svg.count('<p') >= 50
    assert vorpipe.cells(vorpipe.generate('random', 3000))._repr_svg_() is None
    assert vorpipe.cells(vorpipe.generate('random', 50), detail='measures')._repr_svg_() is None


def test_notebooks_show_pictures_as_they_are_if_they_are_not_large():
    small = vorpipe.render(vorpipe.generate('random', 100), size=(300, 200))
    assert np.array_equal(np.asarray(shown(small)[0].convert('RGBA')), small.rgba)
    assert shown(vorpipe.render(vorpipe.generate('random', 100), size=(2001, 1000)))[0].size == (667, 334)


def test_of_very_many_points_there_is_only_a_line(monkeypatch, diagram):
    monkeypatch.setattr('vorpipe._shown.MOST_POINTS', 100)
    assert diagram._repr_png_() is None
    assert diagram._repr_html_() == '<div>&lt;vorpipe.Diagram: 100 cells of 101 points, cpu&gt;</div>'
