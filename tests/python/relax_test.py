"""Points that move: arrays, endings, and the same bytes from Python, from C and from the command line."""
import ctypes
import os
import pathlib
import signal
import subprocess
import threading

import numpy as np
import pytest

import vorpipe

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITES = ROOT / 'tests/data/navaids.csv'


def test_energy_falls_and_points_stay_in_the_domain():
    points = vorpipe.generate('random', 300)
    relaxed = vorpipe.relax(points, domain=(0, 0, 1, 1), method='lloyd', iterations=8)
    assert len(relaxed) == 300 and relaxed.sites.shape == (300, 2)
    assert np.all(np.diff(relaxed.energy) < 0) and len(relaxed.farthest) == 9
    assert relaxed.sites.min() > 0 and relaxed.sites.max() < 1
    assert relaxed.end == 'iterations' and relaxed.weights is None and relaxed.report.ok == 300
    again = vorpipe.relax(points, domain=(0, 0, 1, 1), iterations=8)
    assert again.hexagonal[-1] < relaxed.hexagonal[-1]
    near = vorpipe.relax(relaxed.sites, domain=(0, 0, 1, 1), tolerance=0.5)
    assert near.end == 'tolerance' and np.array_equal(near.sites, relaxed.sites)
    assert 'set beside it' in vorpipe.relax(points[[0, 1, 1]], domain=(0, 0, 1, 1)).report.notes[0]


def test_points_follow_a_density():
    density = np.exp(-np.linspace(0, 3, 60))[None, :].repeat(40, axis=0)
    points = vorpipe.drawn_points(density, 400)
    assert points.shape == (400, 2) and points[:, 0].max() < 60 and points[:, 1].max() < 40
    relaxed = vorpipe.relax(points, domain=(0, 0, 60, 40), density=density, equal_masses=True)
    mass = vorpipe.cells(relaxed.sites, domain=(0, 0, 60, 40), density=density).mass
    assert np.mean(np.abs(mass / mass.mean() - 1) < 0.15) > 0.9


def test_wrong_arguments_are_refused():
    points = vorpipe.generate('random', 10)
    with pytest.raises(vorpipe.InputError, match='method'):
        vorpipe.relax(points, method='newton')
    with pytest.raises(vorpipe.InputError, match='iterations'):
        vorpipe.relax(points, iterations=-1)
    with pytest.raises(vorpipe.Cancelled):
        vorpipe.relax(points, progress=lambda stage, fraction: False, iterations=10**6)


def test_ctrl_c_is_heard():
    points = vorpipe.generate('random', 20000)
    told = threading.Event()

    def interrupt():
        told.wait()
        signal.raise_signal(signal.SIGINT)

    threading.Thread(target=interrupt, daemon=True).start()
    with pytest.raises(KeyboardInterrupt):
        vorpipe.relax(points, iterations=10**6, method='lloyd', progress=lambda stage, fraction: told.set())


def by_c(library, path):
    """The same run in C."""
    lib = ctypes.CDLL(str(library))
    session, placed, relaxation = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_void_p()
    assert lib.vorpipe_session_open(None, ctypes.byref(session)) == 0
    assert lib.vorpipe_input_read(str(SITES).encode(), ctypes.c_uint64(1), ctypes.byref(placed)) == 0
    lib.vorpipe_input_set_box.argtypes = [ctypes.c_void_p] + 4 * [ctypes.c_double] + [ctypes.c_int32]
    assert lib.vorpipe_input_set_box(placed, 5, 47, 15, 55, 0) == 0
    assert lib.vorpipe_relax(session, placed, None, ctypes.byref(relaxation)) == 0
    assert lib.vorpipe_relaxation_save(relaxation, str(path).encode()) == 0
    lib.vorpipe_relaxation_free(relaxation)
    lib.vorpipe_input_free(placed)
    lib.vorpipe_session_free(session)


def test_program_c_and_python_write_the_same_bytes(tmp_path):
    program = pathlib.Path(os.environ.get('VORPIPE_PROGRAM', ''))
    if not program.is_file():
        pytest.skip('the program is not built')
    subprocess.run([program, 'relax', '--sites', SITES, '--domain', '5,47,15,55', '--quiet', '-o', 'cli.npy', '-o',
                    'cli.csv'], check=True, cwd=tmp_path)
    relaxed = vorpipe.relax(vorpipe.read(SITES), domain=(5, 47, 15, 55))
    for name in ('npy', 'csv'):
        relaxed.save(tmp_path / f'python.{name}')
        assert (tmp_path / f'cli.{name}').read_bytes() == (tmp_path / f'python.{name}').read_bytes()
    library = program.parent.parent / 'c' / 'libvorpipe.so'
    if not library.is_file():
        pytest.skip('the library is not built')
    by_c(library, tmp_path / 'c.npy')
    assert (tmp_path / 'c.npy').read_bytes() == (tmp_path / 'cli.npy').read_bytes()
