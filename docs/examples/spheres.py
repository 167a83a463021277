#!/usr/bin/env python3
"""Draws three spheres on a table in soft light, 640x480 shades of gray: something to stipple.

Python alone, no packages:  spheres.py spheres.png
"""

import math
import struct
import sys
import zlib

WIDTH, HEIGHT = 640, 480
SPHERES = [((-1.05, 0.95, 4.4), 0.95), ((0.75, 0.62, 3.5), 0.62), ((1.75, 1.1, 5.6), 1.1)]
EYE = (0.0, 1.55, -0.6)
LIGHT = (-0.56, 0.70, -0.44)  # where it comes from; of length 1


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def along(start, way, far):
    return (start[0] + far * way[0], start[1] + far * way[1], start[2] + far * way[2])


def unit(a):
    return along((0.0, 0.0, 0.0), a, 1 / math.sqrt(dot(a, a)))


def first_hit(start, way):
    """The distance to the nearest sphere or to the table, and the sphere's number: -1 for the table."""
    nearest, hit = math.inf, None
    for number, (center, radius) in enumerate(SPHERES):
        to = minus(start, center)
        half = dot(to, way)
        rest = half * half - dot(to, to) + radius * radius
        if rest > 0 and 1e-4 < -half - math.sqrt(rest) < nearest:
            nearest, hit = -half - math.sqrt(rest), number
    if way[1] < 0 and -start[1] / way[1] < nearest:
        return -start[1] / way[1], -1
    return nearest, hit


def light_at(place, skip):
    """How much of the light reaches a place: 0 to 1, with soft edges of shadows."""
    light = 1.0
    for number, (center, radius) in enumerate(SPHERES):
        if number == skip:
            continue
        to = minus(place, center)
        half = dot(to, LIGHT)
        if half >= 0:
            continue
        gap = math.sqrt(max(dot(to, to) - half * half, 0)) - radius
        edge = min(max(0.5 + gap / (-half * 0.22), 0), 1)
        light *= edge * edge * (3 - 2 * edge)
    return light


def open_sky(place, normal, skip):
    """How much of the sky is not hidden by spheres nearby."""
    sky = 1.0
    for number, (center, radius) in enumerate(SPHERES):
        if number == skip:
            continue
        to = minus(center, place)
        far = math.sqrt(dot(to, to))
        sky *= 1 - max(dot(normal, to) / far, 0) * (radius / far) ** 2
    return sky


def shade(start, way, mirrors):
    far, hit = first_hit(start, way)
    if hit is None:
        return 0.80 + 0.16 * max(way[1], 0)
    place = along(start, way, far)
    if hit == -1:
        fog = 1 - math.exp(-0.02 * far * far)
        table = 0.12 + 0.30 * open_sky(place, (0, 1, 0), -1) + 0.50 * light_at(place, -1)
        return table * (1 - fog) + 0.82 * fog
    normal = unit(minus(place, SPHERES[hit][0]))
    sunny = max(dot(normal, LIGHT), 0) * light_at(place, hit)
    body = (0.62, 0.42, 0.24)[hit]
    sky = (0.5 + 0.5 * normal[1]) * open_sky(place, normal, hit)
    # The table throws light back from below.
    below = max(-normal[1], 0) * 0.12
    value = body * (0.10 + 0.32 * sky + below + 0.85 * sunny)
    mirrored = along(way, normal, -2 * dot(way, normal))
    value += 0.75 * max(dot(mirrored, LIGHT), 0) ** 40 * light_at(place, hit)
    if mirrors:
        value += (0.05 + 0.35 * (1 + dot(way, normal)) ** 3) * shade(place, mirrored, False)
    return value


def main(path):
    rows = []
    for row in range(HEIGHT):
        values = bytearray(b"\0")
        for column in range(WIDTH):
            way = unit(((column + 0.5 - WIDTH / 2) / HEIGHT, (HEIGHT / 2 - row - 0.5) / HEIGHT - 0.12, 1.05))
            value = min(max(shade(EYE, way, True), 0), 1)
            values += struct.pack(">H", round(65535 * value))
        rows.append(bytes(values))
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 0, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(b"".join(rows), 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "spheres.png")
