#!/usr/bin/env python3
"""Pictures as SVG and PDF, world files and GeoTIFFs, read by programs that are not ours and compared with the PNG and
the .npy of the same run.

Usage: pictures_readers.py VORPIPE ISLANDS.geojson. A missing reader is said to be SKIPPED, as in cells_readers.py.
"""

import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
import zlib

sys.dont_write_bytecode = True  # the modules beside this one are in the source tree
from cells_readers import report_skipped
import numpy as np

from cells_readers_data import equal, near, program
from pictures_readers_maps import check_maps


def read_png(path):
    """Rows of RGB, transparent pixels as on white paper."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        (size,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        chunks[kind] = chunks.get(kind, b"") + data[at + 8 : at + 8 + size]
        at += size + 12
    width, height, bits, color = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    assert bits == 8 and color in (2, 6)
    channels = 3 if color == 2 else 4
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, width * channels + 1)
    image, above = [], np.zeros((width + 1, channels), np.uint8)
    for row in rows:
        above = unfiltered(row[0], row[1:].reshape(width, channels), above)
        image.append(above[1:])
    image = np.array(image).astype(float)
    if channels == 3:
        return image
    alpha = image[:, :, 3:] / 255
    return image[:, :, :3] * alpha + 255 * (1 - alpha)


def unfiltered(kind, row, above):
    """A row of a PNG with a pixel of zeros before it; `above` is the one above."""
    line = np.vstack([np.zeros_like(row[:1]), row])
    if kind == 1:
        return np.cumsum(line, 0, dtype=np.uint8)
    if kind == 2:
        return line + above
    if kind == 0:
        return line
    # Numbers of Python: each needs the one before it.
    flat, over, step = line.ravel().tolist(), above.ravel().tolist(), line.shape[1]
    for k in range(step, len(flat)):
        a, b, c = flat[k - step], over[k], over[k - step]
        from_a, from_b, from_c = abs(b - c), abs(a - c), abs(a + b - 2 * c)
        paeth = a if from_a <= from_b and from_a <= from_c else b if from_b <= from_c else c
        flat[k] = (flat[k] + ((a + b) // 2 if kind == 3 else paeth)) % 256
    return np.array(flat, np.uint8).reshape(line.shape)


def read_ppm(path):
    with open(path, "rb") as file:
        kind, width, height, most = (file.readline() + file.readline() + file.readline()).split()
        assert kind == b"P6" and most == b"255"
        return np.frombuffer(file.read(), np.uint8).reshape(int(height), int(width), 3).astype(float)


def silent(*words):
    """Whether a program is there; it has nothing to say."""
    if shutil.which(words[0]) is None:
        return False
    done = subprocess.run(words, capture_output=True, encoding="utf-8")
    assert done.returncode == 0 and not done.stderr, f"{' '.join(words)}: {done.returncode}: {done.stderr}"
    return True


def around(image, least):
    """For each pixel but those at the border the least or the greatest value of the 3 x 3 around it."""
    height, width = image.shape[:2]
    parts = [image[y : height - 2 + y, x : width - 2 + x] for y in range(3) for x in range(3)]
    return np.min(parts, 0) if least else np.max(parts, 0)


DARK = [0x18] * 3


def check_same_picture(image, scene):
    """Away from edges colors are equal; edges, and what is white of dots, are where the PNG has them."""
    png = read_png("p.png")
    assert image.shape == png.shape, f"{image.shape} pixels"
    even = (around(png, True) == around(png, False)).all(2)
    difference = np.abs(image - png)[1:-1, 1:-1].max(2)
    share = (difference[even] <= 4).mean()
    assert share >= 0.97, f"{share:.3f} of the pixels inside of cells are equal"
    assert (difference <= 40).mean() >= 0.9, f"{(difference <= 40).mean():.3f} of all pixels are alike"
    darkest, lightest = around(image, True).max(2), around(image, False).min(2)
    edges = (png == scene.edge_color).all(2)[1:-1, 1:-1]
    assert edges.any() == scene.edges
    if edges.any() and scene.edge_color is DARK:
        assert (darkest[edges] < 110).mean() >= 0.97, f"{(darkest[edges] < 110).mean():.3f} of the edges are dark"
    dots = (around(png, True) == 255).all(2) & (png[1:-1, 1:-1] == 255).all(2)
    assert not dots.any() or (lightest[dots] > 230).mean() >= 0.97, "there are dots, or holes, missing"


def librsvg_svg(scene):
    if not silent("rsvg-convert", "p.svg", "--output", "svg.png"):
        return "rsvg-convert"
    check_same_picture(read_png("svg.png"), scene)
    return None


def libxml_svg(_):
    return None if silent("xmllint", "--noout", "p.svg") else "xmllint"


def python_svg(scene):
    svg = "{http://www.w3.org/2000/svg}"
    root = xml.etree.ElementTree.parse("p.svg").getroot()
    ids = np.load("p.npy")
    assert (root.get("width"), root.get("height")) == tuple(str(n) for n in ids.shape[::-1])
    layers = [layer.get("id") for layer in root.findall(svg + "g")]
    order = ["background", "cells", "edges", "dual", "sites", "labels", "legend"]
    assert layers == [name for name in order if name in layers] and "cells" in layers, layers
    assert ("edges" in layers) == scene.edges
    inkscape = "{http://www.inkscape.org/namespaces/inkscape}"
    assert all(layer.get(inkscape + "groupmode") == "layer" for layer in root.findall(svg + "g"))
    cells = [path for path in root.iter(svg + "path") if path.get("id")]
    assert len({path.get("id") for path in cells}) == len(cells)
    for path in cells:
        site = path.get("id").split("-")[1]
        assert path.find(svg + "title").text.startswith(f"site {site}, "), path.get("id")
    named = {int(title.text.split(",")[0][len("site ") :]) for title in root.iter(svg + "title")}
    shown = set(ids[ids != 2**32 - 1].tolist())
    assert shown <= named, f"{sorted(shown - named)} have no shape"
    assert bool(list(root.iter(svg + "text"))) == scene.text
    return None


def poppler_pdf(scene):
    if not silent("pdftoppm", "-r", "96", "-singlefile", "p.pdf", "pdf"):
        return "pdftoppm"
    check_same_picture(read_ppm("pdf.ppm"), scene)
    if scene.legend:
        words = program("pdftotext", "p.pdf", "-").split()
        assert scene.legend_word in [word.strip(",") for word in words], words
    fonts = program("pdffonts", "p.pdf").splitlines()[2:]
    assert len(fonts) == scene.text, fonts
    # emb, sub, uni: embedded, a subset, and its letters can be searched for.
    assert all(font.split()[-5:-2] == ["yes", "yes", "yes"] for font in fonts), fonts
    return None


def python_tiff(_):
    """With nothing but the description of the format."""
    with open("p.tif", "rb") as file:
        data = file.read()
    assert struct.unpack("<2sHI", data[:8]) == (b"II", 42, 8)
    tags = {}
    for k in range(struct.unpack("<H", data[8:10])[0]):
        tag, kind, count, value = struct.unpack("<HHII", data[10 + 12 * k : 22 + 12 * k])
        letter, size = {2: ("s", 1), 3: ("H", 2), 4: ("I", 4), 12: ("d", 8)}[kind]
        at = value if count * size > 4 else 18 + 12 * k
        tags[tag] = struct.unpack(f"<{count}{letter}" if kind != 2 else f"<{count}s", data[at : at + count * size])
    assert list(tags) == sorted(tags)
    (width,), (height,) = tags[256], tags[257]
    assert [tags[t] for t in (258, 259, 262, 277, 317, 339)] == [(32,), (8,), (1,), (1,), (2,), (1,)]
    strips = zip(tags[273], tags[279])
    words = b"".join(zlib.decompress(data[offset : offset + count]) for offset, count in strips)
    equal(np.cumsum(np.frombuffer(words, "<u4").reshape(height, width), 1, dtype=np.uint32), np.load("p.npy"), "ids")
    return None


def gdal_tiff(scene):
    text = program("gdalinfo", "-json", "p.tif")
    if text is None:
        return "gdalinfo"
    info, ids = json.loads(text), np.load("p.npy")
    equal(info["size"], ids.shape[::-1], "size")
    band = info["bands"][0]
    assert band["type"] == "UInt32" and band["noDataValue"] == 2**32 - 1, band
    check_place(info["geoTransform"], scene, ids)
    silent("gdal_translate", "-q", "-of", "ENVI", "p.tif", "p.raw")
    equal(np.fromfile("p.raw", np.uint32).reshape(ids.shape), ids, "ids")
    return None


def osgeo_tiff(_):
    try:
        from osgeo import gdal
    except ImportError:
        return "GDAL's module for Python"
    equal(gdal.Open("p.tif").ReadAsArray(), np.load("p.npy"), "ids")
    return None


def gdal_world_file(scene):
    text = program("gdalinfo", "-json", "p.png")
    if text is None:
        return "gdalinfo"
    check_place(json.loads(text)["geoTransform"], scene, np.load("p.npy"))
    return None


def check_place(transform, scene, ids):
    """The pixels that show the domain lie where it is."""
    left, width, skew_x, top, skew_y, height = transform
    assert skew_x == skew_y == 0
    rows, columns = (np.flatnonzero((ids != 2**32 - 1).any(axis)) for axis in (1, 0))
    xmin, ymin, xmax, ymax = scene.domain
    near(left + width * columns[0], xmin, "xmin", 1e-6)
    near(left + width * (columns[-1] + 1), xmax, "xmax", 1e-6)
    near(top + height * rows[0], ymax, "ymax", 1e-6)
    near(top + height * (rows[-1] + 1), ymin, "ymin", 1e-6)


CHECKS = [librsvg_svg, libxml_svg, python_svg, poppler_pdf, python_tiff, gdal_tiff, osgeo_tiff, gdal_world_file]


class Scene:
    def __init__(self, sites, *options, domain=(0, 0, 1, 1)):
        self.domain = domain
        self.options = ["--sites", sites, *options]
        self.edges, self.legend = "--edges" in options, "--legend" in options
        self.edge_color = [255, 0, 0] if "--edge-color" in options else DARK
        self.text = self.legend or "--labels" in options
        self.legend_word = options[options.index("--color") + 1] if self.legend else None


def photograph():
    """A photograph that changes slowly, beside the pictures."""
    y, x = np.mgrid[0:60, 0:90]
    rgb = np.stack([40 + 2 * x, 30 + 3 * y, 200 - x - y], 2).astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in rgb)
    with open("photograph.png", "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        header = struct.pack(">IIBBBBB", 90, 60, 8, 2, 0, 0, 0)
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))
    return "photograph.png"


def scenes(islands):
    size = ["--size", "300x200"]
    yield Scene("random:80", *size)
    yield Scene("random:40", *size, "--edges", "--show-sites", "--color", "neighbors", "--periodic", "xy")
    box = (12.94, 11.8, 142.69, 84.5)
    yield Scene("clusters:200", *size, "--color", "area", "--legend", "--fit", "letterbox")
    marks = ["--edge-width", "3", "--dot-size", "9"]
    yield Scene("random:30", *size, "--edges", "--show-sites", *marks, "--color", "neighbors", "--legend")
    yield Scene("random:60", "--domain", islands, "--edges", "--show-sites", "--size", "300x200", domain=box)
    smooth = ["--antialias", "4", "--edge-width", "2.5", "--dual"]
    yield Scene("random:60", *size, "--edges", *smooth, "--labels")
    yield Scene("random:40", *size, *smooth, "--no-fill", "--periodic", "xy")
    yield Scene("random:60", "--domain", islands, "--edges", *smooth, "--size", "300x200", domain=box)
    yield Scene("random:60", *size, "--color", photograph(), "--edges", "--show-sites")
    yield Scene("random:60", "--domain", islands, *smooth, "--color", photograph(), "--size", "300x200", domain=box)
    colored = ["--edges", "--edge-color", "red", "--edge-width", "3", "--size", "300x200"]
    yield Scene("random:60", "--domain", islands, *colored, "--background", "#2040a080", domain=box)
    yield Scene("random:60", *colored, "--no-fill", "--background", "black", "--fit", "letterbox", "--show-sites")


def main():
    vorpipe, islands = (os.path.abspath(path) for path in sys.argv[1:3])
    failures, skipped = 0, set()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for scene in scenes(islands):
            files = ["-o", "p.png", "-o", "p.svg", "-o", "p.pdf", "-o", "p.pgw", "--ids", "p.npy"]
            command = [vorpipe, "render", "--backend", "cpu", *scene.options, "--quiet"]
            subprocess.run([*command, *files], check=True)
            subprocess.run([*command, "--ids", "p.tif"], check=True)
            for check in CHECKS:
                try:
                    missing = check(scene)
                    if missing and missing not in skipped:
                        skipped.add(missing)
                        report_skipped(check.__name__, f"there is no {missing}")
                except AssertionError as error:
                    failures += 1
                    print(f"FAILED: {check.__name__} of {' '.join(scene.options)}: {error}")
        failures += check_maps(vorpipe, read_png)
    print(f"{failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
