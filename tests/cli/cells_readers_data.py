"""The cells that NumPy reads, and how others are compared with them."""

import math
import shutil
import subprocess

import numpy as np


class Cells:
    """The .npz of one run, as NumPy reads it."""

    def __init__(self, path, domain):
        with np.load(path) as arrays:
            self.__dict__.update({name: arrays[name] for name in arrays.files})
        self.domain = domain
        self.count = len(self.sites)

    def ring(self, site):
        return self.cell_vertices[self.cell_offsets[site] : self.cell_offsets[site + 1]]

    def neighbors_of(self, site):
        return self.neighbors[self.neighbor_offsets[site] : self.neighbor_offsets[site + 1]]

    def faces(self):
        return [site for site in range(self.count) if len(self.ring(site)) >= 3]

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
