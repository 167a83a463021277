"""What `render` promises, from every backend."""
import pickle

import numpy as np
import pytest

import vorpipe


def test_each_pixel_has_its_nearest_site(backend, random):
    points = random.random((300, 2))
    with vorpipe.Session(backend, validate=True) as session:
        picture = session.render(points, domain=(0, 0, 1, 1), size=(64, 48), check=True)
    assert picture.report.backend == backend and picture.report.validation_messages == []
    assert vorpipe.check(picture) == []
    x, y = (np.arange(64) + 0.5) / 64, 1 - (np.arange(48) + 0.5) / 48
    distances = (x[None, :, None] - points[:, 0])**2 + (y[:, None, None] - points[:, 1])**2
    assert (picture.ids == distances.argmin(axis=2)).mean() > 0.99
    on_cpu = vorpipe.render(points, domain=(0, 0, 1, 1), size=(64, 48), backend='cpu')
    assert vorpipe.compare(picture, on_cpu).agree


def test_row_0_is_the_top():
    picture = vorpipe.render([[0.5, 0.25], [0.5, 0.75]], domain=(0, 0, 1, 1), size=(4, 4))
    assert picture.ids.tolist() == [[1] * 4] * 2 + [[0] * 4] * 2


def test_beyond_an_outline_there_is_no_site():
    half = [(0, 0), (0.5, 0), (0.5, 1), (0, 1)]
    picture = vorpipe.render([[0.5, 0.5]], domain=half, view=(0, 0, 1, 1), size=(4, 4))
    assert picture.domain == (0, 0, 0.5, 1) and picture.extent == (0, 1, 0, 1)
    assert (picture.ids[:, 2:] == vorpipe.NO_SITE).all() and (picture.ids[:, :2] == 0).all()
    assert (picture.rgba[:, 2:, 3] == 0).all()


@pytest.mark.parametrize('color', ['site', 'area', 'neighbors', 'weight'])
def test_colors_are_those_of_the_command_line(color, tmp_path):
    picture = vorpipe.render(vorpipe.generate('random', 50), weights=vorpipe.random_weights(0, 1e-3, 50), color=color,
                             colormap='magma', edges=True, show_sites=True, size=(50, 50))
    assert len(np.unique(picture.rgba.reshape(-1, 4), axis=0)) > 5


def test_without_a_size_the_longer_side_is_1000():
    assert vorpipe.render([[0, 0]], domain=(0, 0, 4, 1)).ids.shape == (250, 1000)


def test_pictures_are_saved(tmp_path):
    picture = vorpipe.render(vorpipe.generate('hex', 50), size=(40, 30))
    picture.save(tmp_path / 'picture.png')
    assert (tmp_path / 'picture.png').read_bytes()[:4] == b'\x89PNG'
    picture.save(tmp_path / 'ids.npy')
    assert np.array_equal(np.load(tmp_path / 'ids.npy'), picture.ids)
    with pytest.raises(vorpipe.InputError, match='unknown kind of file for pictures'):
        picture.save(tmp_path / 'picture.jpg')


def test_pictures_of_other_sizes_cannot_be_compared():
    a, b = (vorpipe.render([[0, 0], [1, 1]], size=(side, 20)) for side in (20, 30))
    with pytest.raises(vorpipe.InputError, match='b: it has another size than a'):
        vorpipe.compare(a, b)
    with pytest.raises(vorpipe.InputError, match='cannot be compared'):
        vorpipe.compare(a, vorpipe.cells([[0, 0]]))


def test_colors_have_a_key():
    points = vorpipe.generate('clusters', 200)
    picture = vorpipe.render(points, size=(200, 100), color='area', color_scale='log', legend=True)
    key = picture.key
    areas = vorpipe.cells(points).areas
    assert (key.color, key.scale) == ('area', 'log') and np.allclose(key.range, (areas.min(), areas.max()))
    assert [place for place, _ in key.ticks] == sorted(place for place, _ in key.ticks) and key.ticks[-1][0] == 1
    assert vorpipe.render(points, size=(9, 9), color='area').key.scale == 'quantile'
    assert vorpipe.render(points, size=(9, 9)).key is None
    ranged = vorpipe.render(points, size=(9, 9), color='area', color_scale='linear', color_range=(0, 1)).key
    assert ranged.range == (0, 1)


@pytest.mark.parametrize('argument, arguments', [
    ('color_scale', {'color_scale': 'cubic', 'color': 'area'}), ('color_scale', {'color_scale': 'log'}),
    ('color_range', {'color_range': (1, 0), 'color': 'area'}), ('color_range', {'color_range': 3, 'color': 'area'}),
    ('legend', {'legend': True}), ('legend', {'legend': True, 'color': 'area', 'size': (20, 20)}),
    ('edge_width', {'edge_width': 0.5, 'edges': True}), ('dot_size', {'dot_size': 500, 'show_sites': True}),
    ('antialias', {'antialias': 9}), ('label_size', {'labels': True, 'label_size': 3}),
    ('legend', {'legend': True, 'color': 'area', 'fill': False}), ('fit', {'fit': 'crop'}), ('color', {'color': 'weight'})])
def test_a_look_that_cannot_be_is_refused(argument, arguments):
    with pytest.raises(vorpipe.InputError, match=f'^{argument}: ') as caught:
        vorpipe.render([[0, 0], [1, 1]], **{'size': (200, 100), **arguments})
    assert caught.value.subject == argument


def test_edges_and_dots_are_as_wide_as_they_are_asked_for():
    def dark(**look):
        rgba = vorpipe.render([[0.5, 0.25], [0.5, 0.75]], domain=(0, 0, 1, 1), size=(100, 100), **look).rgba
        plain = vorpipe.render([[0.5, 0.25], [0.5, 0.75]], domain=(0, 0, 1, 1), size=(100, 100)).rgba
        return (rgba != plain).any(axis=2).sum()

    assert dark(edges=True, edge_width=10) > 4 * dark(edges=True) > 0
    assert dark(show_sites=True, dot_size=20) > 4 * dark(show_sites=True, dot_size=5) > 0


def test_edges_and_what_is_no_cell_have_the_colors_that_are_asked_for():
    arguments = {'domain': (0, 0, 1, 1), 'size': (200, 100), 'fit': 'letterbox'}
    points = [[0.25, 0.5], [0.75, 0.5]]
    picture = vorpipe.render(points, edges=True, edge_color='#f80', background='#20408080', fill=False, **arguments)
    assert picture.rgba[50, 10].tolist() == picture.rgba[50, 80].tolist() == [32, 64, 128, 128]
    assert (picture.rgba == [255, 136, 0, 255]).all(axis=2).sum() >= 100
    assert (pickle.loads(pickle.dumps(picture)).rgba == picture.rgba).all()
    for argument, text in {'edge_color': 'reddish', 'background': '#12'}.items():
        with pytest.raises(vorpipe.InputError, match=f'^{argument}: "{text}" is no color') as caught:
            vorpipe.render(points, edges=True, **{argument: text}, **arguments)
        assert caught.value.subject == argument
    with pytest.raises(vorpipe.InputError, match='^edge_color: #ff000080: must be opaque'):
        vorpipe.render(points, edges=True, edge_color='#ff000080')


def test_a_photograph_colors_cells_by_the_mean_of_their_light(tmp_path):
    image = pytest.importorskip('PIL.Image')
    pixels = np.random.default_rng(5).integers(0, 256, (60, 90, 3), np.uint8)
    image.fromarray(pixels).save(tmp_path / 'p.png')
    arguments = {'domain': (0, 0, 1, 1), 'size': (90, 60)}
    for points in vorpipe.generate('random', 40), np.vstack([vorpipe.generate('random', 9), [[0.5, 0.5], [0.5, 0.5]]]):
        picture = vorpipe.render(points, color=str(tmp_path / 'p.png'), **arguments)
        value = pixels / 255
        light = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
        for site in np.unique(picture.ids):
            mean = light[picture.ids == site].mean(axis=0)
            wanted = 255 * np.where(mean <= 0.0031308, 12.92 * mean, 1.055 * mean ** (1 / 2.4) - 0.055)
            got = picture.rgba[picture.ids == site]
            assert (got == got[0]).all() and np.abs(got[0, :3] - wanted).max() <= 1 and got[0, 3] == 255
        assert (picture.ids == vorpipe.render(points, **arguments).ids).all()
        assert (pickle.loads(pickle.dumps(picture)).rgba == picture.rgba).all()


def test_cells_without_a_pixel_have_the_one_at_their_site(tmp_path):
    image = pytest.importorskip('PIL.Image')
    pixels = np.random.default_rng(6).integers(0, 256, (3, 4, 3), np.uint8)
    image.fromarray(pixels).save(tmp_path / 'p.png')
    points = vorpipe.generate('random', 500)
    picture = vorpipe.render(points, color=str(tmp_path / 'p.png'), domain=(0, 0, 1, 1), size=(200, 200))
    column, row = (points[:, 0] * 4).astype(int), ((1 - points[:, 1]) * 3).astype(int)
    same = (picture.rgba[..., :3] == pixels[row, column][picture.ids]).all(axis=2)
    centers = [((c + 0.5) / 4, 1 - (r + 0.5) / 3) for c in range(4) for r in range(3)]
    owners = vorpipe.cells(points, domain=(0, 0, 1, 1)).locate(centers)
    assert same[~np.isin(picture.ids, owners)].all()


@pytest.mark.parametrize('orientation', range(1, 9))
def test_photographs_stand_as_their_cameras_say(orientation, tmp_path):
    image = pytest.importorskip('PIL.Image')
    from PIL import ImageOps
    stored = image.new('RGB', (64, 32))
    for place, color in {(0, 0): 'red', (32, 0): 'lime', (0, 16): 'blue', (32, 16): 'yellow'}.items():
        stored.paste(color, (*place, place[0] + 32, place[1] + 16))
    exif = image.Exif()
    exif[0x112] = orientation
    stored.save(tmp_path / 'p.jpg', quality=100, subsampling=0, exif=exif.tobytes())
    upright = np.asarray(ImageOps.exif_transpose(image.open(tmp_path / 'p.jpg')).convert('RGB'))
    points = [[0.25, 0.75], [0.75, 0.75], [0.25, 0.25], [0.75, 0.25]]
    picture = vorpipe.render(points, color=str(tmp_path / 'p.jpg'), domain=(0, 0, 1, 1), size=(64, 64))
    for x, y in points:
        seen = picture.rgba[int((1 - y) * 64), int(x * 64), :3].astype(int)
        stands = upright[int((1 - y) * upright.shape[0]), int(x * upright.shape[1])].astype(int)
        assert np.abs(seen - stands).max() <= 3, (x, y)


def test_photographs_in_inks_and_grays_are_read(tmp_path):
    image = pytest.importorskip('PIL.Image')
    for mode, color in {'CMYK': (40, 100, 0, 30), 'L': 77}.items():
        image.new(mode, (8, 8), color).save(tmp_path / 'p.jpg', quality=100)
        picture = vorpipe.render([[0.5, 0.5]], color=str(tmp_path / 'p.jpg'), domain=(0, 0, 1, 1), size=(2, 2))
        wanted = image.open(tmp_path / 'p.jpg').convert('RGB').getpixel((4, 4))
        assert np.abs(picture.rgba[0, 0, :3].astype(int) - wanted).max() <= 2, mode


def test_a_photograph_that_cannot_be_is_refused(tmp_path):
    (tmp_path / 'p.jpg').write_bytes(b'GIF89a')
    with pytest.raises(vorpipe.InputError, match='^color: .*p.jpg: is not a JPEG file') as caught:
        vorpipe.render([[0.5, 0.5]], color=str(tmp_path / 'p.jpg'))
    assert caught.value.subject == 'color'


def test_css_names_are_those_of_matplotlib():
    colors = pytest.importorskip('matplotlib.colors')
    assert len(colors.CSS4_COLORS) == 148
    for name, written in colors.CSS4_COLORS.items():
        picture = vorpipe.render([[0.5, 0.5]], domain=(0, 0, 1, 1), size=(1, 1), fill=False, background=name)
        assert '#{:02X}{:02X}{:02X}'.format(*picture.rgba[0, 0, :3]) == written, name


def test_a_letterbox_keeps_the_aspect():
    arguments = {'domain': (0, 0, 2, 1), 'size': (40, 40), 'check': True}
    picture = vorpipe.render([[0.5, 0.5], [1.5, 0.5]], fit='letterbox', **arguments)
    assert (picture.ids[:10] == vorpipe.NO_SITE).all() and (picture.ids[10:30] < 2).all()
    assert picture.extent == pytest.approx((0, 2, -0.5, 1.5)) and picture.domain == (0, 0, 2, 1)
    assert vorpipe.compare(picture, picture).agree
    stretched = vorpipe.render([[0.5, 0.5], [1.5, 0.5]], **arguments)
    assert stretched.extent == (0, 2, 0, 1) and (stretched.ids < 2).all()
    with pytest.raises(vorpipe.InputError, match='b: its domain fits into it in another way'):
        vorpipe.compare(picture, stretched)


def test_pictures_of_files_keep_their_aspect(tmp_path):
    (tmp_path / 'sites.csv').write_text('x,y\n0,0\n2,1\n')
    assert (vorpipe.render(vorpipe.read(tmp_path / 'sites.csv'), size=(40, 40)).ids == vorpipe.NO_SITE).any()


def test_maps_are_saved_with_their_place(tmp_path):
    picture = vorpipe.render([[0.5, 0.5]], domain=(0, 0, 4, 2), size=(40, 20))
    picture.save(tmp_path / 'ids.tif')
    assert (tmp_path / 'ids.tif').read_bytes()[:2] == b'II'
    picture.save(tmp_path / 'picture.pgw')
    assert [float(line) for line in (tmp_path / 'picture.pgw').read_text().split()] == [0.1, 0, 0, -0.1, 0.05, 1.95]
    with pytest.raises(vorpipe.InputError, match='call vorpipe.draw'):
        picture.save(tmp_path / 'picture.svg')


def test_cells_are_drawn_as_shapes(tmp_path):
    drawn = vorpipe.draw(vorpipe.generate('random', 20), tmp_path / 'cells.svg', size=(300, 200), color='area',
                         legend=True, edges=True, show_sites=True, check=True)
    assert len(drawn) == 20 and drawn.detail == 'polygons'
    assert '<svg' in (tmp_path / 'cells.svg').read_text()[:500]
    vorpipe.draw([[0, 0], [1, 1]], tmp_path / 'cells.pdf', project=True)
    assert (tmp_path / 'cells.pdf').read_bytes()[:5] == b'%PDF-'
    with pytest.raises(vorpipe.InputError, match='unknown kind of file for drawings; known are .svg, .pdf'):
        vorpipe.draw([[0, 0]], tmp_path / 'cells.png')
    with pytest.raises(vorpipe.InputError, match='^legend: '):
        vorpipe.draw([[0, 0]], tmp_path / 'none.svg', legend=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ['cells.pdf', 'cells.svg']


def test_colors_and_labels_are_values_or_attributes(tmp_path):
    points = [[0.25, 0.75], [0.75, 0.75], [0.25, 0.25], [0.75, 0.25]]
    box = dict(domain=(0, 0, 1, 1), size=(200, 200), backend='cpu')
    by_number = vorpipe.render(points, color=[0, 1, None, 2], legend='beside', legend_title='rain, mm', **box)
    corners = by_number.rgba[[50, 50, 150, 150], [50, 150, 50, 150]]
    assert corners[2].tolist() == [210, 210, 210, 255] and by_number.key.range == (0, 2)
    assert by_number.rgba.shape == (200, 200, 4)
    by_number.save(tmp_path / 'p.png')
    from PIL import Image
    assert Image.open(tmp_path / 'p.png').size[0] > 200
    by_name = vorpipe.render(points, color=['b', 'a', None, 'b'], colormap=['#010203', 'white'], **box)
    assert by_name.key.names == ['a', 'b']
    assert by_name.rgba[[50, 50, 150, 150], [50, 150, 50, 150], 0].tolist() == [255, 1, 210, 255]
    assert pickle.loads(pickle.dumps(by_name)).key.names == ['a', 'b']
    (tmp_path / 's.csv').write_text('x,y,name,rain\n0.25,0.75,Zürich,1\n0.75,0.75,Genève,2\n0.25,0.25,Bern,3\n',
                                    encoding='utf-8')
    sites = vorpipe.read(tmp_path / 's.csv')
    vorpipe.draw(sites, tmp_path / 's.svg', color='@rain', labels='@name', title='Towns', **box)
    svg = (tmp_path / 's.svg').read_text(encoding='utf-8')
    assert all(f'>{text}</text>' in svg for text in ('Zürich', 'Genève', 'Bern', 'Towns'))
    vorpipe.draw(points, tmp_path / 't.svg', labels=['n', 'e', 's', 'w'], color='distinct', **box)
    assert '>w</text>' in (tmp_path / 't.svg').read_text(encoding='utf-8')
    for wrong, words in (({'color': '@snow'}, 'snow'), ({'color': [1, 2]}, 'one for each point'),
                         ({'labels': '@x'}, 'x'), ({'legend': 'above'}, 'above'), ({'colormap': ['red']}, '1 colors'),
                         ({'colormap': ['red', 'blau'], 'color': 'area'}, 'blau'), ({'color': [None] * 4}, 'no site')):
        with pytest.raises(vorpipe.InputError, match=words):
            vorpipe.render(points, **{**box, **wrong})
