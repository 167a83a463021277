#!/usr/bin/env python3
"""How fast the Python package is, beside scipy and beside C++, each side by side in one run: python.py [RUNS]

PYTHONPATH says which build of the package is measured; VORPIPE_CALL, where it is there, the program of
tests/bench/call.cpp from the same build. What is printed is the median of RUNS, 5 where nothing is said, taken in turn.
"""
import os
import statistics
import subprocess
import sys
import time

import vorpipe


def seconds(call):
    begin = time.perf_counter()
    call()
    return time.perf_counter() - begin


def in_turn(calls, runs):
    """The median of each call's times; each is made once before, so that none pays for what the first one opens."""
    taken = {name: [] for name in calls}
    for k in range(runs + 1):
        for name, call in calls.items():
            time_taken = call()
            if k > 0:
                taken[name].append(time_taken)
    return {name: statistics.median(times) for name, times in taken.items()}


def show(title, times):
    print(title)
    slowest = max(times.values())
    for name, taken in times.items():
        print(f'  {name:32} {taken * 1000:8.0f} ms  {slowest / taken:6.1f} x')


def beside_scipy(runs):
    from scipy import spatial

    from vorpipe import compat

    points = vorpipe.generate('random', 200_000)

    def all_of(voronoi):
        return voronoi.vertices, voronoi.ridge_points, voronoi.ridge_vertices, voronoi.regions, voronoi.point_region

    show('200,000 points', in_turn({
        'scipy.spatial.Voronoi': lambda: seconds(lambda: spatial.Voronoi(points)),
        'scipy.spatial.Delaunay': lambda: seconds(lambda: spatial.Delaunay(points)),
        'vorpipe.cells': lambda: seconds(lambda: vorpipe.cells(points, backend='cpu')),
        "vorpipe.cells, detail='polygons'": lambda: seconds(
            lambda: vorpipe.cells(points, backend='cpu', detail='polygons')),
        'vorpipe.compat.Delaunay': lambda: seconds(lambda: compat.Delaunay(points)),
        'vorpipe.compat.Voronoi': lambda: seconds(lambda: compat.Voronoi(points)),
        'vorpipe.compat.Voronoi, all of it': lambda: seconds(lambda: all_of(compat.Voronoi(points))),
    }, runs))


def beside_scipy_on_the_sphere(runs):
    import numpy as np
    from scipy import spatial

    from vorpipe import compat

    ways = np.random.default_rng(1).standard_normal((100_000, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    x, y, z = ways.T
    places = np.degrees(np.column_stack((np.arctan2(y, x), np.arcsin(z))))
    show('100,000 points on the sphere, with areas', in_turn({
        'scipy.spatial.SphericalVoronoi': lambda: seconds(lambda: spatial.SphericalVoronoi(ways).calculate_areas()),
        'vorpipe.cells, globe=True': lambda: seconds(lambda: vorpipe.cells(places, globe=True).solid_angles),
        'vorpipe.compat.SphericalVoronoi': lambda: seconds(lambda: compat.SphericalVoronoi(ways).calculate_areas()),
    }, runs))


def beside_cpp(runs, program, points, domain, *space):
    with vorpipe.Session('cpu') as session, subprocess.Popen(
            [program, str(len(points)), *space], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as cpp:

        def in_cpp():
            cpp.stdin.write('\n')
            cpp.stdin.flush()
            return float(cpp.stdout.readline())

        def in_python():
            kept = []
            return seconds(lambda: kept.append(session.cells(points, domain=domain)))

        times = in_turn({'Session::cells in C++': in_cpp, 'Session.cells in Python': in_python}, runs)
        cpp.stdin.close()
    show(' '.join([f'{len(points):,} points', *(f'in {word}' for word in space)]), times)
    print(f'  Python takes {times["Session.cells in Python"] / times["Session::cells in C++"]:.3f} of the time of C++')


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    try:
        beside_scipy(runs)
        beside_scipy_on_the_sphere(runs)
    except ImportError as error:
        print(f'not beside scipy: {error}')
    program = os.environ.get('VORPIPE_CALL')
    if program:
        beside_cpp(runs, program, vorpipe.generate('random', 1_000_000), (0, 0, 1, 1))
        beside_cpp(runs, program, vorpipe.generate('random', 1_000_000, dim=3), (0, 0, 0, 1, 1, 1), 'space')
    else:
        print('not beside C++: VORPIPE_CALL names no program')


if __name__ == '__main__':
    main()
