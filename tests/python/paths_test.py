"""Names of files: what is none is refused, and every name that a system has is taken."""
import os

import numpy as np
import pytest

import vorpipe

POINTS = np.array([[0.2, 0.3], [0.7, 0.6], [0.4, 0.9]])
STRANGE = os.fsdecode(b'caf\xe9')

WRITERS = {
    'cells': ('.csv', lambda path: vorpipe.cells(POINTS).save(path)),
    'edges': ('.csv', lambda path: vorpipe.cells(POINTS).save_edges(path)),
    'picture': ('.png', lambda path: vorpipe.render(POINTS, size=(5, 5)).save(path)),
    'drawing': ('.svg', lambda path: vorpipe.draw(POINTS, path)),
    'relaxed': ('.csv', lambda path: vorpipe.relax(POINTS, iterations=1).save(path)),
    'transported': ('.csv', lambda path: vorpipe.transport(POINTS).save(path)),
    'fluid': ('.npz', lambda path: vorpipe.Fluid(POINTS, domain=(0, 0, 1, 1)).save(path)),
}
READERS = {
    'points': ('.csv', vorpipe.read),
    'weights': ('.txt', lambda path: vorpipe.read_weights(path, 3)),
    'outline': ('.wkt', lambda path: vorpipe.cells(POINTS, domain=path)),
    'density': ('.npy', lambda path: vorpipe.cells(POINTS, density=path)),
    'fluid': ('.npz', vorpipe.Fluid),
}
BOTH = {**{f'writes {name}': case for name, case in WRITERS.items()},
        **{f'reads {name}': case for name, case in READERS.items()}}


@pytest.mark.parametrize('case', BOTH.values(), ids=BOTH)
def test_a_zero_byte_does_not_end_a_name(case, tmp_path):
    extension, use = case
    (tmp_path / 'kept').write_text('mine')
    with pytest.raises(vorpipe.InputError, match='has a zero byte'):
        use(f'{tmp_path}/kept\0{extension}')
    assert [path.name for path in tmp_path.iterdir()] == ['kept'] and (tmp_path / 'kept').read_text() == 'mine'


@pytest.mark.parametrize('case', WRITERS.values(), ids=WRITERS)
def test_names_that_are_not_utf_8_are_written(case, tmp_path):
    extension, write = case
    write(tmp_path / (STRANGE + extension))
    assert os.listdir(os.fsencode(tmp_path)) == [os.fsencode(STRANGE + extension)]


@pytest.mark.parametrize('case', READERS.values(), ids=READERS)
def test_messages_about_names_that_are_not_utf_8_can_be_printed(case, tmp_path):
    extension, read = case
    with pytest.raises(vorpipe.InputError, match=r'caf\\xe9') as caught:
        read(tmp_path / (STRANGE + extension))
    str(caught.value).encode()


def test_names_that_are_not_utf_8_are_read(tmp_path):
    path = tmp_path / (STRANGE + '.csv')
    path.write_text('x,y\n0,0\n1,1\n')
    for name in (path, str(path), os.fsencode(path)):
        assert vorpipe.read(name).points.tolist() == [[0, 0], [1, 1]]
    assert r'caf\xe9.csv' in repr(vorpipe.read(path))
    with pytest.raises(vorpipe.InputError, match='layer'):
        vorpipe.read(path, layer='l')
    assert vorpipe.cells(vorpipe.read(path)).areas.size == 2


def test_what_is_not_utf_8_in_a_file_is_told(tmp_path):
    (tmp_path / 'bad.csv').write_bytes(b'x,y\n0,\xff\n')
    with pytest.raises(vorpipe.InputError, match='bad.csv:2'):
        vorpipe.read(tmp_path / 'bad.csv')


def test_what_is_no_path_is_refused():
    with pytest.raises(vorpipe.InputError, match='^path: 5 is no path') as caught:
        vorpipe.cells(POINTS).save(5)
    assert caught.value.subject == 'path'


def test_what_a_result_is_of_is_not_replaced(tmp_path):
    path = tmp_path / 'a.csv'
    path.write_text('x,y\n0.2,0.3\n0.7,0.6\n0.4,0.9\n')
    ring = tmp_path / 'ring.geojson'
    ring.write_text('{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}')
    cells = vorpipe.cells(path, domain=ring)
    for save in (cells.save, cells.save_edges, vorpipe.relax(path, iterations=1).save, vorpipe.transport(path).save):
        with pytest.raises(vorpipe.InputError, match='^path: .*a.csv: is what this was computed from'):
            save(f'{tmp_path}/./a.csv')
    with pytest.raises(vorpipe.InputError, match='ring.geojson: is what'):
        cells.save(ring)
    assert path.read_text().startswith('x,y\n')
    cells.save(tmp_path / 'b.csv')
    cells.save(tmp_path / 'b.csv')
