"""Fluids: arrays, steps, calls after each, what stops them, and the same bytes as the program; free surfaces."""
import os
import pathlib
import signal
import subprocess
import threading

import numpy as np
import pytest
import shapely.geometry

import vorpipe

UNIT = (0, 0, 1, 1)


def test_a_vortex_keeps_its_energy_and_its_areas():
    fluid = vorpipe.Fluid('taylor-green', particles=100, scheme='projection', step=0.02)
    assert len(fluid) == 100 and fluid.domain == UNIT and fluid.periodic == 'none' and fluid.surface is None
    assert fluid.end is None and fluid.scheme == 'projection' and fluid.densities.shape == (0, )
    start = fluid.last
    step = fluid.step()
    assert step.step == 1 and step.time == fluid.time == pytest.approx(0.02) and step.worst <= 1e-6
    told = []
    last = fluid.run(until=0.09, callback=told.append)
    assert [step.step for step in told] == [2, 3, 4, 5] and last.time == 0.09 and fluid.end == 'time'
    assert last.energy == pytest.approx(start.energy, rel=0.01) and last.momentum == pytest.approx((0, 0), abs=1e-9)
    assert fluid.step() is None and fluid.report.ok == 100
    assert fluid.pressures.shape == fluid.weights.shape == (100, ) and fluid.sites.shape == (100, 2)
    assert np.allclose(fluid.cells().areas, 0.01, rtol=1e-6) and np.array_equal(fluid.volumes, np.full(100, 0.01))
    assert (fluid.render(size=(20, 20)).ids != vorpipe.NO_SITE).all()


def test_viscosity_takes_energy_as_theory_says():
    wave = vorpipe.Fluid('shear-wave', particles=576, viscosity=0.02)
    assert wave.scheme == 'projection' and wave.viscosity == 0.02 and wave.walls == 'slip'
    first, last = wave.last, wave.run(until=1)
    assert np.log(first.kinetic / last.kinetic) == pytest.approx(8 * np.pi**2 * 0.02, rel=0.01)
    exact = np.sin(2 * np.pi * wave.sites[:, 1]) * np.exp(-4 * np.pi**2 * 0.02)
    error = np.sqrt(np.sum((wave.velocities[:, 0] - exact)**2 + wave.velocities[:, 1]**2) / np.sum(exact**2))
    assert last.velocity_error == pytest.approx(error, rel=1e-6) and error < 0.01
    channel = vorpipe.Fluid('channel', particles=144)
    assert channel.walls == 'no-slip' and channel.run().velocity_error < 0.02
    wave.push(np.zeros((len(wave), 2)))
    assert wave.run(steps=1).velocity_error is None


def test_centering_keeps_points_in_their_cells(tmp_path):
    loose = vorpipe.Fluid('rayleigh-taylor', particles=256, until=1.5, centering=0)
    held = vorpipe.Fluid('rayleigh-taylor', particles=256, until=1.5)
    assert loose.centering == 0 and held.centering == 2
    assert vorpipe.Fluid('taylor-green', particles=64).centering == 0
    assert held.run().farthest < 0.7 * loose.run().farthest and held.last.worst <= 1e-6
    held.save(tmp_path / 'held.npz')
    assert vorpipe.Fluid(tmp_path / 'held.npz').centering == 2


def test_the_rim_of_a_mushroom_rolls_up():
    """On a level through it there is light fluid outside of the rim, and again between it and the stem."""
    fluid = vorpipe.Fluid('rayleigh-taylor', particles=2048, until=3.6)
    first, worst = fluid.last, []
    fluid.run(callback=lambda step: worst.append((step.worst, step.linear_iterations)))
    assert max(worst)[0] <= 1e-6 and max(count for _, count in worst) < 1000
    assert first.energy > fluid.last.energy > 0.97 * first.energy
    heavy = (fluid.densities > 1.5)[fluid.render(size=(100, 200)).ids]
    # Borders between fluids on each level: a stem alone has 2, with a rim on both sides 6.
    borders = np.count_nonzero(np.diff(heavy.astype(int), axis=1), axis=1)
    assert np.count_nonzero(borders == 6) >= 10 and np.count_nonzero(borders > 6) <= 20


def test_walls_are_outlines(tmp_path):
    ring = np.array([(0, 0), (2, 0), (2, 1), (0, 1)])
    hole = np.array([(0.8, 0.4), (0.8, 0.6), (1.2, 0.5)])
    inside = shapely.geometry.Polygon(ring, [hole])
    points = vorpipe.generate('jitter', 300, domain=(0, 0, 2, 1))
    points = points[[inside.buffer(-0.02).contains(shapely.geometry.Point(point)) for point in points]]
    fluid = vorpipe.Fluid(points, domain=inside, densities=np.where(points[:, 0] > 1, 2.0, 1.0), gravity=(-1, 0),
                          viscosity=0.001)
    assert fluid.domain == (0, 0, 2, 1) and len(fluid.outline) == 1 and len(fluid.outline[0]) == 2
    worst = []
    fluid.run(until=0.5, callback=lambda step: worst.append(step.worst))
    assert len(worst) > 5 and max(worst) <= 1e-6 and fluid.last.velocity_error is None
    cells = fluid.cells()
    assert np.allclose(cells.areas, inside.area / len(points), rtol=1e-5)
    assert max(inside.distance(shapely.geometry.Point(point)) for point in fluid.sites) < 1e-9
    assert np.mean(fluid.render(size=(200, 100)).ids == vorpipe.NO_SITE) == pytest.approx(1 - inside.area / 2, abs=0.01)
    fluid.save(tmp_path / 'part.npz')
    again = vorpipe.Fluid(tmp_path / 'part.npz')
    assert again.viscosity == 0.001 and np.array_equal(again.outline[0][1], fluid.outline[0][1])
    fluid.run(until=2, steps=3)
    again.run(until=2, steps=3)
    assert fluid.last.step == again.last.step and np.array_equal(fluid.sites, again.sites)
    with pytest.raises(vorpipe.InputError, match='sites: 1 of'):
        vorpipe.Fluid(np.vstack((points, (1, 0.5))), domain=inside)
    with pytest.raises(vorpipe.InputError, match='^domain: .*this case repeats itself'):
        vorpipe.Fluid('shear', domain=inside)
    with pytest.raises(vorpipe.InputError, match='^domain: .*part.npz has its own'):
        vorpipe.Fluid(tmp_path / 'part.npz', domain=inside)
    with pytest.raises(vorpipe.InputError, match='^weights: taylor-green has its own'):
        vorpipe.Fluid('taylor-green', weights=[1])


def test_a_case_begins_in_an_outline_as_on_the_command_line():
    shapely = pytest.importorskip('shapely.geometry')
    inside = shapely.Point(0.5, 0.5).buffer(0.4)
    fluid = vorpipe.Fluid('taylor-green', parcels=100, domain=inside)
    assert fluid.volumes.sum() == pytest.approx(inside.area, rel=1e-6) and len(fluid.outline) == 1
    # A ring that crosses itself is mended where that is asked for.
    bow = [[0.1, 0.1], [0.9, 0.9], [0.9, 0.1], [0.1, 0.9]]
    with pytest.raises(vorpipe.InputError, match='^domain: '):
        vorpipe.Fluid('taylor-green', parcels=100, domain=bow)
    assert vorpipe.Fluid('taylor-green', parcels=100, domain=bow, repair=True).volumes.sum() == pytest.approx(0.32)
    assert repr(fluid.step()).startswith('<vorpipe.FluidStep 1: time 0.')


def test_arrays_are_views_that_later_steps_leave_alone():
    fluid = vorpipe.Fluid('shear', particles=64)
    velocities, copy = fluid.velocities, fluid.velocities.copy()
    assert not velocities.flags.writeable and not velocities.flags.owndata
    fluid.step()
    assert np.array_equal(velocities, copy) and not np.array_equal(fluid.velocities, copy)
    before = fluid.velocities
    fluid.push(np.ones((len(fluid), 2)))
    assert np.array_equal(fluid.velocities, before + 1)
    del fluid
    assert np.array_equal(velocities, copy)


def test_it_begins_with_arrays():
    points = vorpipe.generate('jitter', 100)
    fluid = vorpipe.Fluid(points, np.tile((1.0, 0.0), (100, 1)), domain=UNIT, periodic='x', densities=np.full(100, 3.0))
    assert fluid.last.kinetic == pytest.approx(1.5) and fluid.periodic == 'x'
    fluid.run(steps=3)
    assert fluid.last.step == 3 and fluid.last.momentum[0] == pytest.approx(3, rel=1e-6)
    drops = vorpipe.Fluid(points, volumes=np.full(100, 0.003), domain=UNIT, surface='free', gravity=(0, -1))
    drops.run(steps=2)
    assert drops.last.potential < 1 and drops.surface == 'free'
    cells = drops.cells()
    assert np.allclose(cells.areas, 0.003, rtol=1e-5) and cells.area_sum() == pytest.approx(0.3, rel=1e-5)


def test_a_callback_uses_the_fluid_and_ends_the_run():
    fluid = vorpipe.Fluid('dam-break', particles=60)
    areas = []

    def measure(step):
        areas.append(fluid.cells(detail='measures').area_sum())
        fluid.push(np.zeros((len(fluid), 2)))
        return step.step < 2

    fluid.run(callback=measure)
    assert fluid.last.step == 2 and fluid.end is None and np.allclose(areas, 2, rtol=1e-5)
    with pytest.raises(ZeroDivisionError):
        fluid.run(callback=lambda step: 1 // 0)
    assert fluid.last.step == 3


def test_what_is_cancelled_goes_on_as_if_it_had_not_been():
    fluid, other = (vorpipe.Fluid('taylor-green', particles=100, step=0.01) for _ in range(2))
    fluid.run(steps=2)
    with pytest.raises(vorpipe.Cancelled):
        for _ in range(100):
            fluid.step(progress=lambda stage, part: False)
    reached = fluid.last.step
    fluid.run(steps=2)
    other.run(steps=fluid.last.step)
    assert reached + 2 == other.last.step and np.array_equal(fluid.sites, other.sites)


def test_ctrl_c_ends_a_run_and_the_fluid_stays_whole():
    fluid = vorpipe.Fluid('shear', particles=5000)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        fluid.run(until=1e9)
    before = fluid.last.step
    assert fluid.run(steps=1).step >= before and fluid.last.worst <= 1e-6


def test_it_knows_its_session():
    with vorpipe.Session('cpu', threads=1) as session:
        fluid = vorpipe.Fluid('gresho', particles=50, session=session)
        fluid.step()
    with pytest.raises(vorpipe.DeviceError, match='closed'):
        fluid.step()
    assert len(fluid.sites) == len(fluid)


def test_wrong_arguments_are_refused_by_name():
    points = vorpipe.generate('random', 10)
    for words, arguments in (('velocities: shape', {'velocities': np.ones((9, 2))}),
                             ('velocities: they', {'velocities': np.full((10, 2), np.nan)}),
                             ('volumes', {'volumes': np.zeros(10)}), ('densities', {'densities': np.ones(9)}),
                             ('scheme', {'scheme': 'sph'}), ('gravity', {'gravity': 9.81}), ('step', {'step': -1}),
                             ('epsilon', {'epsilon': np.nan}), ('until', {'until': np.nan}),
                             ('tolerance', {'tolerance': 0}), ('volume', {'surface': 'free'}),
                             ('viscosity', {'viscosity': -1}), ('centering', {'centering': -1}),
                             ('walls', {'walls': 'glue'}), ('walls', {'walls': 'no-slip'}),
                             ('domain', {'domain': [(0, 0), (1, 1)]}), ('particles', {'particles': 10}),
                             ('scheme', {'surface': 'free', 'scheme': 'projection'})):
        with pytest.raises(vorpipe.InputError, match=f'^{words}'):
            vorpipe.Fluid(points, **{'domain': UNIT, **arguments})
    for words, name, arguments in (('begin', 'dam', {}), ('domain', 'shear', {'domain': UNIT}),
                                   ('particles', 'shear', {'particles': 1}), ('none.npz', 'none.npz', {}),
                                   ('particles', 'none.npz', {'particles': 9})):
        with pytest.raises(vorpipe.InputError, match=f'^{words}'):
            vorpipe.Fluid(name, **arguments)
    fluid = vorpipe.Fluid(points, domain=UNIT)
    with pytest.raises(vorpipe.InputError, match='^until'):
        fluid.run()
    with pytest.raises(vorpipe.InputError, match='^velocities'):
        fluid.push(np.ones((3, 2)))


def test_it_begins_with_files_as_numpy_writes_them(tmp_path):
    points = vorpipe.generate('jitter', 30, domain=(0, 0, 2, 1))
    velocity = np.tile((1, 0), (30, 1))
    plain = {'sites': points, 'velocity': velocity.astype(float), 'domain': np.array([0, 0, 2, 1.0]),
             'periodic': np.array([1], np.uint8), 'scheme': np.array([1], np.uint8)}
    packed = {'sites': np.asfortranarray(points.astype('>f8')), 'velocity': velocity.astype('i2'), 'domain': [0, 0, 2, 1],
              'periodic': 'x', 'scheme': 'projection', 'time': 0, 'step': np.int64(0)}
    np.savez(tmp_path / 'plain.npz', **plain)
    np.savez_compressed(tmp_path / 'packed.npz', **packed)
    fluids = [vorpipe.Fluid(tmp_path / name) for name in ('plain.npz', 'packed.npz')]
    for fluid in fluids:
        fluid.run(steps=2)
    assert fluids[1].periodic == 'x' and fluids[1].scheme == 'projection'
    assert np.array_equal(fluids[0].sites, fluids[1].sites)
    np.savez(tmp_path / 'single.npz', **{**plain, 'sites': points.astype('f4')})
    assert np.allclose(vorpipe.Fluid(tmp_path / 'single.npz').sites, points, rtol=1e-6)
    for more, words in (({'velocities': velocity}, 'did you mean velocity'), ({'heat': 0.1}, 'known are sites'),
                        ({'periodic': 'z'}, 'not one of none, x, y, xy'), ({'step': 1.5}, 'no number of type'),
                        ({'order': np.full(30, -1)}, 'no number of type'), ({'volume': ['a'] * 30}, 'not numbers')):
        np.savez(tmp_path / 'wrong.npz', **{**plain, **more})
        with pytest.raises(vorpipe.InputError, match=words):
            vorpipe.Fluid(tmp_path / 'wrong.npz')


def test_its_report_says_what_should_be_known():
    assert vorpipe.Fluid('taylor-green', particles=64).report.notes == []
    fluid = vorpipe.Fluid('taylor-green', particles=64, step=1, scheme='springs')
    assert 'up to which springs of epsilon' in fluid.report.notes[0]
    points = vorpipe.generate('jitter', 10)
    points[3] = points[4]
    with pytest.raises(vorpipe.InputError, match='sites 3 and 4'):
        vorpipe.Fluid(points, domain=UNIT)


def test_cells_of_a_free_surface_end_at_discs():
    points = vorpipe.generate('random', 100)
    found = vorpipe.transport(points, domain=UNIT, fill=0.3)
    assert found.surface == 'free'
    for cells in (found.cells(), vorpipe.cells(points, found.weights, UNIT, surface='free')):
        assert np.allclose(cells.areas, 0.003, rtol=1e-7) and np.allclose(cells.centroids, found.centroids)
    assert vorpipe.cells(points, found.weights, UNIT).area_sum() == pytest.approx(1)
    for cell in cells:
        border = cell.border()
        assert [part.end for part in border] == [part.start for part in border[1:] + border[:1]]
        assert all((part.angle > 0) == (part.neighbor == vorpipe.Wall.OUTLINE) for part in border)
    radii = np.sqrt(found.weights)
    away = np.hypot(*(cells.cell_vertices - np.repeat(points, np.diff(cells.cell_offsets), axis=0)).T)
    assert (away <= np.repeat(radii, np.diff(cells.cell_offsets)) * (1 + 1e-9)).all()
    places = np.random.default_rng(1).random((2000, 2))
    held = cells.locate(places)
    assert np.mean(held != vorpipe.NO_SITE) == pytest.approx(0.3, abs=0.05)
    ids = vorpipe.render(points, found.weights, UNIT, size=(200, 200), surface='free').ids
    assert np.mean(ids != vorpipe.NO_SITE) == pytest.approx(0.3, abs=0.01)
    for refused in ({'check': True}, {'periodic': 'xy'}, {'density': np.ones((2, 2))}):
        with pytest.raises(vorpipe.InputError):
            vorpipe.cells(points, found.weights, UNIT, surface='free', **refused)
    with pytest.raises(vorpipe.InputError, match='surface'):
        vorpipe.cells(points)[0].border()
    assert vorpipe.transport(points, domain=UNIT).cells(detail='measures').area_sum() == pytest.approx(1)


def test_program_and_python_write_the_same_bytes(tmp_path):
    program = pathlib.Path(os.environ.get('VORPIPE_PROGRAM', ''))
    if not program.is_file():
        pytest.skip('the program is not built')
    subprocess.run([program, 'fluid', '--backend', 'cpu', '--case', 'dam-break', '--particles', '100', '--steps', '3',
                    '--quiet', '--checkpoint', 'cli.npz', '-o', 'cli.csv'], check=True, cwd=tmp_path)
    fluid = vorpipe.Fluid('dam-break', particles=100)
    fluid.run(steps=3)
    for name in ('npz', 'csv'):
        fluid.save(tmp_path / f'python.{name}')
        assert (tmp_path / f'cli.{name}').read_bytes() == (tmp_path / f'python.{name}').read_bytes()
    again = vorpipe.Fluid(tmp_path / 'cli.npz')
    assert again.last.step == 3 and again.surface == 'free'
    fluid.run(steps=2)
    again.run(steps=2)
    assert np.array_equal(fluid.sites, again.sites) and np.array_equal(fluid.weights, again.weights)
