"""What `render` promises, from every backend."""
import numpy as np
import pytest

import vorpipe


def test_each_pixel_has_its_nearest_site(backend, random):
    points = random.random((300, 2))
    with vorpipe.Session(backend, validation=True) as session:
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
    picture = vorpipe.render([[0.5, 0.5]], domain=(0, 0, 1, 1), outline=half, size=(4, 4))
    assert picture.domain == (0, 0, 1, 1)
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
