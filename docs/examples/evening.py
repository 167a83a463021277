#!/usr/bin/env python3
"""Draws an evening by a lake, 480x320 pixels in color: a photograph to color cells by.

Python alone, no packages:  evening.py evening.png
"""

import math
import struct
import sys
import zlib

WIDTH, HEIGHT = 480, 320
SHORE = 0.36  # where the water ends, counted from the bottom
SUN = (0.62, 0.50, 0.065)
SKY = [(0.36, (1.00, 0.80, 0.42)), (0.50, (0.98, 0.55, 0.32)), (0.68, (0.78, 0.34, 0.44)), (1.00, (0.17, 0.20, 0.46))]
# Hills, the farthest first: how high they are, how far apart, where they begin, and their color.
HILLS = [
    (0.10, 1.7, 0.3, (0.50, 0.30, 0.46)),
    (0.075, 2.9, 1.9, (0.31, 0.21, 0.38)),
    (0.05, 5.1, 4.4, (0.14, 0.12, 0.24)),
]


def mixed(a, b, part):
    return tuple(p + (q - p) * part for p, q in zip(a, b))


def sky_at(height):
    for (low, below), (high, above) in zip(SKY, SKY[1:]):
        if height <= high:
            return mixed(below, above, max(height - low, 0) / (high - low))
    return SKY[-1][1]


def above_water(x, y):
    """What stands at a place, both from 0 to 1; a pixel is as wide as it is high."""
    for high, often, begin, color in reversed(HILLS):
        ridge = 0.6 * math.sin(often * 3 * x + begin) + 0.3 * math.sin(often * 7 * x + 2 * begin)
        ridge += 0.1 * math.sin(often * 19 * x)
        if y < SHORE + high * (1.1 + ridge):
            return color
    across, up, radius = (x - SUN[0]) * WIDTH / HEIGHT, y - SUN[1], SUN[2]
    far = math.hypot(across, up)
    if far < radius:
        return (1.0, 0.96, 0.78)
    glow = math.exp(-(far - radius) / 0.11)
    bands = 0.5 + 0.5 * math.sin(9 * x + 60 * y + 3 * math.sin(5 * x))
    cloud = mixed(sky_at(y), (1.0, 0.62, 0.48), 0.35 * bands * max(1 - abs(y - 0.72) / 0.2, 0))
    return mixed(cloud, (1.0, 0.86, 0.55), 0.8 * glow)


def color_at(x, y):
    if y >= SHORE:
        return above_water(x, y)
    depth = (SHORE - y) / SHORE
    wave = 0.012 * (0.3 + depth) * math.sin(70 * depth ** 0.6 * 3 + 8 * math.sin(6 * x))
    mirrored = above_water(x + wave, SHORE + (SHORE - y) * 1.35)
    return mixed(mirrored, (0.06, 0.11, 0.24), 0.25 + 0.45 * depth)


def main(path):
    rows = []
    for row in range(HEIGHT):
        values = bytearray(b"\0")
        for column in range(WIDTH):
            color = color_at((column + 0.5) / WIDTH, 1 - (row + 0.5) / HEIGHT)
            values += bytes(round(255 * min(max(channel, 0), 1)) for channel in color)
        rows.append(bytes(values))
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(b"".join(rows), 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "evening.png")
