"""Sites as people have them, even and uneven, each kind as an array of NumPy: kinds.py FOLDER [COUNT].

What a program makes of even random sites says little about these: clusters, postal codes, both ends of runways, columns
of circuit boards, points along curves, coordinates with few digits.
"""
import sys
from pathlib import Path

import numpy as np


def kinds(count, random):
    """Names and sites, (count, 2) each."""
    def around(centers, sizes):
        chosen = random.integers(0, len(centers), count)
        return centers[chosen] + random.normal(size=(count, 2)) * sizes[chosen][:, None]

    yield "random", random.random((count, 2))
    yield "clusters", around(random.random((300, 2)), 10 ** random.uniform(-3.2, -1.2, 300))
    towns = np.concatenate([8 * random.normal(size=(count // 30, 2)), 60 * random.random((count // 50, 2))])
    yield "towns", around(towns, 10 ** random.uniform(-3, -1, len(towns)))
    yield "crowds", around(random.random((count // 70, 2)), np.full(count // 70, 1e-4))
    boards = np.column_stack((np.round(900 * random.random(count)) / 900, random.random(count)))
    boards[:count // 3, 1] = np.round(4000 * boards[:count // 3, 1]) / 4000
    yield "boards", boards + 1e-6 * random.normal(size=(count, 2))
    half = random.random((count // 2, 2))
    angle, length = 2 * np.pi * random.random(count // 2), 10 ** random.uniform(-5, -2.5, count // 2)
    yield "pairs", np.concatenate([half, half + length[:, None] * np.column_stack((np.cos(angle), np.sin(angle)))])
    x, curve = random.random(count), random.integers(0, 6, count)
    y = 0.1 + 0.15 * curve + 0.05 * np.sin(12 * x + curve)
    yield "curves", np.column_stack((x, y)) + 1e-9 * random.normal(size=(count, 2))
    away, angle = random.random(count) ** 3 / 2, 2 * np.pi * random.random(count)
    yield "halo", 0.5 + np.column_stack((away * np.cos(angle), away * np.sin(angle)))
    yield "snapped", np.round(2000 * random.random((count, 2))) / 2000


folder = Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
for name, sites in kinds(int(sys.argv[2]) if len(sys.argv) > 2 else 1_000_000, np.random.default_rng(1)):
    np.save(folder / f"{name}.npy", np.ascontiguousarray(sites))
