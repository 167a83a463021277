"""Measures many cells in tiles, and checks them: memory, the sum of areas, and samples beside runs of their own.

check_cells.py PROGRAM [--sites N] [--kind random|clusters] [--limit SIZE] [--samples N] [--folder DIR] [--backend NAME]

Sites are written as float64 (N, 2) to DIR, mapped by the run, and removed at the end. A sample is measured again among
the sites of a window around it alone; it counts where no site beyond the window can reach it. Exits with 1 where
something is wrong, with 77 without NumPy.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time
import zipfile

try:
    import numpy as np
except ImportError:
    print("SKIPPED: all samples: there is no NumPy")
    if path := os.environ.get("VORPIPE_SKIPPED"):
        with open(path, "a") as file:
            file.write(f"{os.environ.get('VORPIPE_TEST_NAME', '')}\t\tthere is no NumPy\n")
    sys.exit(77)

UNITS = {"MB": 10**6, "GB": 10**9, "MiB": 2**20, "GiB": 2**30}
CHUNK = 4_000_000
WINDOW_SITES = 3000  # about, at least


def bytes_of(size):
    unit = size.lstrip("0123456789")
    return int(size[: -len(unit)]) * UNITS[unit]


def make_sites(kind, count, seed, path):
    """A hundred normal clusters, whose widths differ by up to 32 times; or random sites."""
    sites = np.lib.format.open_memmap(path, "w+", np.float64, (count, 2))
    random = np.random.default_rng(seed)
    centers, widths = 0.1 + 0.8 * random.random((100, 2)), 0.002 * 2 ** (5 * random.random(100))
    for first in range(0, count, CHUNK):
        number = min(CHUNK, count - first)
        if kind == "random":
            part = random.random((number, 2))
        else:
            which = random.integers(0, len(centers), number)
            part = centers[which] + widths[which][:, None] * random.standard_normal((number, 2))
            beyond = ((part < 0) | (part > 1)).any(axis=1)
            part[beyond] = random.random((np.count_nonzero(beyond), 2))
        sites[first : first + number] = part
    sites.flush()


class Windows:
    """Squares of cells of a lattice over the unit square, each around a sample, with the sites in them."""

    def __init__(self, sites, wanted, random):
        self.across = max(1, min(4096, math.isqrt(len(sites) // 6)))
        self.number = np.empty(len(sites), np.uint32)
        for first in range(0, len(sites), CHUNK):
            self.number[first : first + CHUNK] = self.cells_of(np.asarray(sites[first : first + CHUNK]))
        counts = np.bincount(self.number, minlength=self.across**2).reshape(self.across, self.across)
        self.sums = np.zeros((self.across + 1, self.across + 1), np.int64)
        self.sums[1:, 1:] = counts.cumsum(0).cumsum(1)
        self.all = [self.around(int(self.number[i])) for i in random.integers(0, len(sites), wanted)]
        marked = np.zeros((self.across, self.across), bool)
        for south, north, west, east in self.all:
            marked[south:north, west:east] = True
        self.inside = np.flatnonzero(marked.ravel()[self.number])
        self.number = self.number[self.inside]

    def cells_of(self, places):
        cells = np.minimum((places * self.across).astype(np.int64), self.across - 1)
        return cells[:, 1] * self.across + cells[:, 0]

    def around(self, cell):
        row, column = divmod(cell, self.across)
        for margin in range(1, self.across):
            south, north = max(row - margin, 0), min(row + margin + 1, self.across)
            west, east = max(column - margin, 0), min(column + margin + 1, self.across)
            sums = self.sums
            count = sums[north, east] - sums[south, east] - sums[north, west] + sums[south, west]
            if margin > 1 and count >= WINDOW_SITES:
                break
        return south, north, west, east

    def sites_in(self, window):
        south, north, west, east = window
        row, column = self.number // self.across, self.number % self.across
        return self.inside[(row >= south) & (row < north) & (column >= west) & (column < east)]

    def box(self, window):
        south, north, west, east = window
        return west / self.across, south / self.across, east / self.across, north / self.across


def check_window(program, backend, folder, places, box):
    """The cells of a window's sites alone, and which of them no other site can reach."""
    np.save(f"{folder}/window.npy", places)
    domain = ",".join(repr(side) for side in box)
    subprocess.run(
        [program, "cells", "--backend", backend, "--sites", f"{folder}/window.npy", "--domain", domain, "--quiet",
         "-o", f"{folder}/window.npz"],
        check=True,
    )
    alone = np.load(f"{folder}/window.npz")
    offsets, corners = alone["cell_offsets"], alone["cell_vertices"]
    owner = np.repeat(np.arange(len(places)), np.diff(offsets))
    radius = 1.001 * np.hypot(*(corners - places[owner]).T)
    # Beyond a side of the unit square there are no sites.
    low = [-np.inf if side == 0 else side for side in box[:2]]
    high = [np.inf if side == 1 else side for side in box[2:]]
    reached = ((corners - radius[:, None] < low) | (corners + radius[:, None] > high)).any(axis=1)
    closed = (alone["status"] == 0) & (np.bincount(owner, reached, len(places)) == 0)
    at_side = neighbors_at_own_sides(alone, box)
    return alone, np.flatnonzero(closed & ~at_side)


def neighbors_at_own_sides(alone, box):
    """Which cells meet a side of the window that is none of the unit square."""
    is_own = [box[0] != 0, box[2] != 1, box[1] != 0, box[3] != 1]
    offsets, neighbors = alone["neighbor_offsets"], alone["neighbors"]
    own = np.array([False, *is_own])[np.where(neighbors < 0, -neighbors, 0)]
    owner = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    return np.bincount(owner, own, len(offsets) - 1) > 0


def sample(options, folder, sites, cells, random):
    """Compares samples; returns how many, how many of them are the same bytes, and lines of what is wrong."""
    wrong, compared, same, worst = [], 0, 0, 0.0
    windows = Windows(sites, max(1, options.samples // 100), random)
    rounds = 0
    while compared < options.samples and rounds < 5 * len(windows.all):
        window = windows.all[rounds % len(windows.all)]
        rounds += 1
        which = windows.sites_in(window)
        places = np.asarray(sites[which])
        alone, closed = check_window(options.program, options.backend, folder, places, windows.box(window))
        chosen = random.permutation(closed)[: min(100, options.samples - compared)]
        numbers = which[chosen]
        area, again = cells["areas"][numbers], alone["areas"][chosen]
        centroid, centroid_again = cells["centroids"][numbers], alone["centroids"][chosen]
        size = np.sqrt(again) + alone["perimeters"][chosen]
        off = np.maximum(np.abs(area - again) / (size * size), np.abs(centroid - centroid_again).max(axis=1) / size)
        counts = np.diff(alone["neighbor_offsets"])[chosen]
        for k in np.flatnonzero((off > 1e-12) | (counts != cells["neighbor_counts"][numbers])):
            wrong.append(f"site {numbers[k]}: area {area[k]!r} and {again[k]!r}, "
                         f"{cells['neighbor_counts'][numbers[k]]} and {counts[k]} neighbors")
        same += np.count_nonzero((area == again) & (centroid == centroid_again).all(axis=1))
        worst = max(worst, off.max(initial=0))
        compared += len(chosen)
    if compared < options.samples:
        wrong.append(f"only {compared} samples could be compared")
    return compared, same, worst, wrong


def mapped(path, name):
    """An array of an archive that is not compressed, mapped and not read."""
    with zipfile.ZipFile(path) as archive:
        entry = archive.getinfo(f"{name}.npy")
    with open(path, "rb") as file:
        file.seek(entry.header_offset + 26)
        name_size, extra_size = np.frombuffer(file.read(4), "<u2")
        begin = entry.header_offset + 30 + int(name_size) + int(extra_size)
        file.seek(begin)
        version = np.lib.format.read_magic(file)
        shape, _, dtype = np.lib.format.read_array_header_1_0(file)
        assert version == (1, 0)
        return np.memmap(path, dtype, "r", file.tell(), shape)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--sites", type=float, default=300_000)
    parser.add_argument("--kind", choices=["random", "clusters"], default="random")
    parser.add_argument("--limit", default="90MB")
    parser.add_argument("--samples", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--folder", default=None)
    options = parser.parse_args()
    wrong = []
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        path = f"{folder}/sites.npy"
        make_sites(options.kind, int(options.sites), options.seed, path)
        begin, before = time.time(), os.times()
        subprocess.run(
            [options.program, "cells", "--backend", options.backend, "--sites", path, "--domain", "0,0,1,1", "--quiet",
             "--detail", "measures", "-o", f"{folder}/cells.npz", "--stats", f"{folder}/stats.json",
             "--memory-limit", options.limit],
            check=True,
        )
        seconds, after = time.time() - begin, os.times()
        busy = after.children_user + after.children_system - before.children_user - before.children_system
        with open(f"{folder}/stats.json") as file:
            stats = json.load(file)
        peak, tiles = stats["peak_memory_bytes"], stats["tiles"]
        names = ["areas", "centroids", "neighbor_counts", "status"]
        cells = {name: mapped(f"{folder}/cells.npz", name) for name in names}
        if peak > bytes_of(options.limit):
            wrong.append(f"took {peak} bytes, more than {options.limit}")
        if peak > stats["forecast_memory_bytes"]:
            wrong.append(f"took {peak} bytes, more than forecast")
        parts = (cells["areas"][k : k + CHUNK] for k in range(0, len(cells["areas"]), CHUNK))
        gap = math.fsum([-1.0, *(value for part in parts for value in exact_sums(part))])
        if not abs(gap) <= 1e-12:
            wrong.append(f"areas add up to 1 + {gap}")
        sites = np.load(path, mmap_mode="r")
        compared, same, worst, differ = sample(options, folder, sites, cells, np.random.default_rng(options.seed))
        wrong += differ[:10]
        print(f"{len(sites)} {options.kind} sites, {tiles['count']} tiles, {tiles['open']} cells apart: "
              f"{seconds:.1f} s, {busy:.1f} CPU s, {peak / 2**30:.2f} GiB of {options.limit}; areas 1 + {gap:.1e}; "
              f"{compared} samples, {same} the same bytes, worst {worst:.1e}, {len(differ)} wrong")
    for line in wrong:
        print(line)
    sys.exit(1 if wrong else 0)


def exact_sums(values):
    """A few numbers with the same sum, to the last bit: sums in multiples of a power of two are exact."""
    step = 2.0 ** (math.frexp(float(np.max(values, initial=2.0**-900)))[1] - 28)
    rest = np.array(values, np.float64)
    while step > 0 and rest.any():
        multiple = np.trunc(rest / step)
        yield float(int(multiple.astype(np.int64).sum())) * step
        rest = rest - multiple * step
        step *= 2.0**-28


if __name__ == "__main__":
    main()
