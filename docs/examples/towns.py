#!/usr/bin/env python3
"""Draws where people live, 300x200 shades of gray: towns, villages along two roads, and few in between.

Python alone, no packages:  towns.py towns.png
"""

import math
import struct
import sys
import zlib

WIDTH, HEIGHT = 300, 200
TOWNS = [(70, 60, 14, 1.0), (205, 50, 20, 0.8), (140, 130, 26, 1.0), (250, 150, 10, 0.7), (40, 155, 12, 0.6)]
ROADS = [((70, 60), (140, 130)), ((140, 130), (205, 50))]


def to_road(x, y, road):
    """The distance to a road from one town to another."""
    (ax, ay), (bx, by) = road
    dx, dy = bx - ax, by - ay
    along = min(max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0), 1)
    return math.hypot(x - ax - along * dx, y - ay - along * dy)


def people(x, y):
    """How many live at a place, 0 to 1."""
    many = 0.04 + sum(much * math.exp(-((x - tx) ** 2 + (y - ty) ** 2) / (2 * wide * wide)) for tx, ty, wide, much in TOWNS)
    many += sum(0.25 * math.exp(-to_road(x, y, road) / 6) for road in ROADS)
    return min(many, 1)


def main(path):
    rows = []
    for row in range(HEIGHT):
        # Dark is dense.
        rows.append(b"\0" + bytes(round(255 * (1 - people(column + 0.5, row + 0.5))) for column in range(WIDTH)))
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 0, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(b"".join(rows), 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "towns.png")
