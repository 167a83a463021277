"""Points that tests of vorpipe.compat are about, and what makes a triangulation right."""
from fractions import Fraction

import numpy as np
from scipy import spatial

import vorpipe
from vorpipe.compat import Delaunay


def random(rng):
    return rng.random((2000, 2))


def clusters(rng):
    return np.concatenate([rng.normal(rng.random(2), 10.0**-k, (300, 2)) for k in range(1, 5)])


def away(rng):
    return rng.random((1000, 2)) + [3, 50]


def disk(rng):
    return rng.normal(size=(1000, 2))


GENERAL = [random, clusters, away, disk]


def lattice(rng):
    return np.stack(np.meshgrid(np.arange(20.0), np.arange(15.0)), axis=-1).reshape(-1, 2)


def turned(rng):
    angle = rng.random()
    return lattice(rng) @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]


def hexagons(rng):
    return vorpipe.generate('hex', 400)


def circle(rng):
    angles = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    return np.column_stack((np.cos(angles), np.sin(angles)))


TIED = [lattice, turned, hexagons, circle]


def triangle_set(simplices):
    return {tuple(sorted(simplex)) for simplex in simplices.tolist()}


def ridges_of(voronoi):
    """Pairs of points to where their ridge ends; nothing for infinity."""
    return {tuple(sorted(pair)): sorted(tuple(voronoi.vertices[vertex]) for vertex in ends if vertex >= 0)
            for pair, ends in zip(voronoi.ridge_points.tolist(), voronoi.ridge_vertices)}


def in_circle(corners):
    """Exactly: above 0 where the last one lies inside the circle through the first three, counter-clockwise."""
    *three, last = [(Fraction(x), Fraction(y)) for x, y in corners.tolist()]
    (ax, ay), (bx, by), (cx, cy) = [(x - last[0], y - last[1]) for x, y in three]
    a, b, c = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    return a * (bx * cy - by * cx) - b * (ax * cy - ay * cx) + c * (ax * by - ay * bx)


def faults(triangulation, only):
    """Triangles among `only` in whose circle the far corner of a neighbor lies."""
    found = 0
    for triangle, adjacent in zip(triangulation.simplices.tolist(), triangulation.neighbors.tolist()):
        for other in adjacent if tuple(sorted(triangle)) in only else []:
            if other >= 0:
                far, = set(triangulation.simplices[other].tolist()) - set(triangle)
                found += in_circle(triangulation.points[[*triangle, far]]) > 0
    return found


def agreed(pattern, rng):
    """Points of a pattern of which scipy finds the Delaunay triangles, too: of a few in a hundred it does not."""
    for _ in range(100):
        points = pattern(rng)
        if triangle_set(Delaunay(points).simplices) == triangle_set(spatial.Delaunay(points).simplices):
            return points
    raise AssertionError('scipy never agrees')
