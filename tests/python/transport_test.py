"""Masses that are prescribed: arrays, steps, endings, and the same bytes from Python, from C and from the command
line."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

import vorpipe

UNIT = (0, 0, 1, 1)


def test_areas_are_equal_and_steps_are_told():
    points = vorpipe.generate('random', 300)
    steps = []
    found = vorpipe.transport(points, domain=UNIT, callback=steps.append)
    assert len(found) == 300 and found.converged and found.end == 'converged' and found.report.ok == 300
    assert np.allclose(found.areas, 1 / 300, rtol=1e-8) and np.array_equal(found.areas, found.masses)
    assert found.weights.shape == (300, ) and found.centroids.shape == (300, 2) and found.cost > 0
    assert [step.diagram for step in steps] == found.trace['diagram'].tolist() == list(range(len(steps)))
    assert found.trace['worst'][-1] == steps[-1].worst <= 1e-8 and found.trace['taken'].dtype == bool
    cells = vorpipe.cells(points, found.weights, UNIT)
    assert np.allclose(cells.areas, 1 / 300, rtol=1e-8) and np.allclose(cells.centroids, found.centroids)
    again = vorpipe.transport(points, domain=UNIT, weights=found.weights)
    assert len(again.trace) == 1 and again.trace['newton'][0] == 0


def test_masses_follow_arrays_and_densities():
    points, masses = vorpipe.generate('random', 100), np.arange(1.0, 101)
    found = vorpipe.transport(points, masses, domain=UNIT, normalize=True)
    assert np.allclose(found.areas, masses / masses.sum(), rtol=1e-8)
    density = np.exp(-np.linspace(0, 3, 60))[None, :].repeat(40, axis=0)
    found = vorpipe.transport(points * (60, 40), density=density, domain=(0, 0, 60, 40))
    assert np.allclose(found.masses, density.sum() / 100, rtol=1e-8) and not np.allclose(found.areas, 24, rtol=0.1)
    found = vorpipe.transport(points, domain=UNIT, fill=0.4)
    assert np.allclose(found.areas, 0.004, rtol=1e-8) and found.weights.min() > 0


def test_points_without_mass_can_be_left_out():
    points = [[0.2, 0.2], [0.8, 0.2], [0.2, 0.8], [0.8, 0.8]]
    with pytest.warns(vorpipe.InputWarning, match='skip_zero: 1 of 4 points, whose mass is 0, are left out'):
        found = vorpipe.transport(points, [1, 0, 2, 1], domain=UNIT, weights=np.zeros(4), normalize=True, skip_zero=True,
                                  attributes={'name': ['a', 'b', 'c', 'd']})
    assert np.allclose(found.areas, [0.25, 0.5, 0.25], rtol=1e-8)
    cells = found.cells()
    assert cells.sites.tolist() == [points[k] for k in (0, 2, 3)]
    assert cells.attributes['name'].tolist() == ['a', 'c', 'd']
    with pytest.raises(vorpipe.InputError, match='^skip_zero: is for masses'):
        vorpipe.transport(points, skip_zero=True)
    with pytest.raises(vorpipe.InputError, match='^masses: no point has any'):
        vorpipe.transport(points, np.zeros(4), skip_zero=True)
    with pytest.raises(vorpipe.InputError, match='3 for 4'):
        vorpipe.transport(points, [1, 0, 1], domain=UNIT, skip_zero=True)


def test_what_ends_early_has_what_was_reached():
    points = vorpipe.generate('random', 300)
    found = vorpipe.transport(points, domain=UNIT, diagrams=2)
    assert found.end == 'diagrams' and not found.converged and len(found.trace) <= 3
    found = vorpipe.transport(points, domain=UNIT, callback=lambda step: step.diagram < 1)
    assert found.end == 'cancelled' and found.weights.shape == (300, )
    with pytest.raises(ZeroDivisionError):
        vorpipe.transport(points, domain=UNIT, callback=lambda step: 1 // step.newton)
    with pytest.raises(vorpipe.Cancelled):
        vorpipe.transport(vorpipe.generate('random', 20000), progress=lambda stage, fraction: False)
    with vorpipe.Session('cpu') as session, pytest.raises(vorpipe.DeviceError, match='busy'):
        session.transport(points, callback=lambda step: session.cells(points))


def test_wrong_arguments_are_refused():
    points = vorpipe.generate('random', 10)
    for words, arguments in (('add up to 10', {'masses': np.ones(10)}), ('9 for 10', {'masses': np.ones(9)}),
                             ('site 0', {'masses': np.zeros(10)}), ('shape', {'masses': np.ones((5, 2))}),
                             ('fill', {'fill': 1.5}), ('surface', {'surface': 'rough'}),
                             ('free surface', {'surface': 'free'}), ('normalize', {'normalize': True, 'fill': 0.5}),
                             ('diagrams', {'diagrams': -1})):
        with pytest.raises(vorpipe.InputError, match=words):
            vorpipe.transport(points, domain=UNIT, **arguments)
    with pytest.raises(vorpipe.InputError, match='sites 1 and 2'):
        vorpipe.transport(points[[0, 1, 1]])


def test_a_view_shows_a_part():
    points = vorpipe.generate('random', 50)
    whole = vorpipe.render(points, domain=UNIT, size=(80, 80)).ids
    assert np.array_equal(vorpipe.render(points, domain=UNIT, size=(40, 40), view=(0, 0, 0.5, 0.5)).ids,
                          whole[40:, :40])
    with pytest.raises(vorpipe.InputError, match='view'):
        vorpipe.render(points, view=(1, 2, 3))


def test_program_and_python_write_the_same_bytes(tmp_path):
    program = pathlib.Path(os.environ.get('VORPIPE_PROGRAM', ''))
    if not program.is_file():
        pytest.skip('the program is not built')
    subprocess.run([program, 'transport', '--sites', 'random:200', '--quiet', '-o', 'cli.npy', '-o', 'cli.csv'],
                   check=True, cwd=tmp_path)
    found = vorpipe.transport(vorpipe.generate('random', 200), domain=UNIT)
    for name in ('npy', 'csv'):
        found.save(tmp_path / f'python.{name}')
        assert (tmp_path / f'cli.{name}').read_bytes() == (tmp_path / f'python.{name}').read_bytes()
