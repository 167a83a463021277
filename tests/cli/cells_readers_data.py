"""The cells that NumPy reads, and how others are compared with them."""

import math
import shutil
import subprocess

import numpy as np


class Cells:
    """The .npz of one run, as NumPy reads it."""

    def __init__(self, path, scene):
        with np.load(path) as arrays:
            self.__dict__.update({name: arrays[name] for name in arrays.files})
        self.domain, self.periodic, self.outline = scene.domain, scene.periodic, scene.outline
        self.count = len(self.sites)

    def ring(self, site):
        return self.cell_vertices[self.cell_offsets[site] : self.cell_offsets[site + 1]]

    def rings(self, site):
        """Outer rings, each followed by its holes."""
        if self.outline is None:
            return [ring for ring in [self.ring(site)] if len(ring) >= 3]
        begin, end = self.cell_offsets[site : site + 2]
        starts = [start for start in self.ring_starts if begin <= start < end]
        return [self.cell_vertices[a:b] for a, b in zip(starts, starts[1:] + [end])]

    def pieces(self, site):
        """For each piece its rings; the first is the outer one."""
        pieces = []
        for ring in self.rings(site):
            if shoelace(ring) > 0:
                pieces.append([])
            pieces[-1].append(ring)
        return pieces

    def neighbors_of(self, site):
        return self.neighbors[self.neighbor_offsets[site] : self.neighbor_offsets[site + 1]]

    def domain_area(self):
        if self.outline is not None:
            return 1 - 0.6**2 + 0.2**2  # ring.wkt
        xmin, ymin, xmax, ymax = self.domain
        return (xmax - xmin) * (ymax - ymin)

    def faces(self):
        return [site for site in range(self.count) if self.rings(site)]

    def on_wall(self, a, b):
        (xmin, ymin, xmax, ymax), (ax, ay), (bx, by) = self.domain, a, b
        return ax == bx and ax in (xmin, xmax) or ay == by and ay in (ymin, ymax)


def equal(a, b, what):
    assert np.array_equal(a, b), f"{what}: {a} is not {b}"


def near(a, b, what, bound=1e-9):
    assert math.isclose(a, b, rel_tol=bound, abs_tol=1e-15), f"{what}: {a} is not {b}"


def shoelace(ring):
    x, y = (ring - ring[0]).T
    return (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2


def program(*words):
    """What a program prints, or None where it is not installed."""
    if shutil.which(words[0]) is None:
        return None
    done = subprocess.run(words, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, f"{' '.join(words)}: exit code {done.returncode}: {done.stderr}"
    return done.stdout
