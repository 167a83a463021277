"""What pictures of maps show of their sites: attributes as colors and as labels, distinct colors, and what stands
around a picture; read from .png, .svg, .pdf, world files and .npz."""

import json
import re
import shutil
import subprocess
import xml.etree.ElementTree

import numpy as np

from pictures_readers_globe import GLOBE_CHECKS

NO_SITE = 2**32 - 1
MISSING = [210, 210, 210]
SITES = """x,y,rain,kind,town
0.25,0.75,0,b,Zürich
0.75,0.75,10,a,Łódź
0.25,0.25,,,São
0.75,0.25,20,b,Ankh
"""


class Maps:
    """Runs of the program in the working directory, which has the sites in four.csv."""

    def __init__(self, vorpipe, read_png):
        self.vorpipe, self.read_png = vorpipe, read_png
        with open("four.csv", "w", encoding="utf-8") as file:
            file.write(SITES)
        self.four = ["--sites", "four.csv", "--domain", "0,0,1,1", "--size", "400x300", "--fit", "stretch"]

    def run(self, *options, code=0):
        done = subprocess.run([self.vorpipe, *options, "--backend", "cpu", "--quiet"], capture_output=True, check=False,
                              encoding="utf-8")
        assert done.returncode == code, f"{' '.join(options)}: exit code {done.returncode}: {done.stderr}"
        return done.stderr

    def render(self, *options, code=0):
        return self.run("render", *options, code=code)


def numbers_are_colors(maps):
    maps.render(*maps.four, "--color", "@rain", "-o", "p.png", "--stats", "s.json")
    png = maps.read_png("p.png")
    first, middle, missing, last = png[75, 100], png[75, 300], png[225, 100], png[225, 300]
    assert first.tolist() == [0x44, 0x01, 0x54], f"0 is {first}"
    assert (np.abs(last - [0xFD, 0xE7, 0x25]) < 8).all(), f"20 is {last}"
    assert (np.abs(middle - [0x21, 0x90, 0x8C]) < 8).all(), f"10 is {middle}"
    assert missing.tolist() == MISSING, f"a missing value is {missing}"
    with open("s.json", encoding="utf-8") as file:
        assert json.load(file)["color"] == {"by": "@rain", "scale": "linear", "range": [0, 20]}
    maps.render(*maps.four, "--color", "@rain", "--color-range", "10,20", "--colormap", "white,black", "-o", "p.png")
    png = maps.read_png("p.png")
    assert png[75, 100].tolist() == png[75, 300].tolist() == [255] * 3, "not all below the range are white"


def names_are_colors(maps):
    maps.render(*maps.four, "--color", "@kind", "--colormap", "#123456,#fedcba", "-o", "p.png", "-o", "p.svg")
    png = maps.read_png("p.png")
    assert png[75, 300].tolist() == [0x12, 0x34, 0x56], "a has not the first color"
    assert png[75, 100].tolist() == png[225, 300].tolist() == [0xFE, 0xDC, 0xBA], "b has not the second"
    assert png[225, 100].tolist() == MISSING
    with open("p.svg", encoding="utf-8") as file:
        colors = re.findall(r'<path [^>]*fill="(#\w+)"', file.read())
    assert colors == ["#fedcba", "#123456", "#d2d2d2", "#fedcba"], colors
    with open("many.csv", "w", encoding="utf-8") as file:
        file.write("x,y,kind\n" + "".join(f"{i},{j},{'k' if j else 'rare'}{i}\n" for i in range(23) for j in range(4)))
    maps.render("--sites", "many.csv", "--color", "@kind", "--legend", "beside", "-o", "p.svg")
    texts = texts_of("p.svg")
    assert texts == ["kind", *[f"k{i}" for i in range(20)], "and 26 others"], texts


def neighbors_differ(maps):
    for domain in (["--domain", "0,0,1,1"], ["--domain", "0,0,1,1", "--periodic", "xy"]):
        which = ["--sites", "random:500", "--random-weights", "0,0.001", *domain]
        maps.run("cells", *which, "-o", "c.npz")
        maps.render(*which, "--color", "distinct", "--size", "1500", "-o", "p.png", "--ids", "p.npy")
        cells, ids, png = np.load("c.npz"), np.load("p.npy"), maps.read_png("p.png")
        pixels = png.reshape(-1, 3)
        sites, first, site = np.unique(ids, return_index=True, return_inverse=True)
        assert np.array_equal(pixels, pixels[first][site.ravel()]), "a cell has several colors"
        color = {int(site): tuple(pixel) for site, pixel in zip(sites, pixels[first])}
        count = np.diff(cells["cell_offsets"].astype(int))
        pairs = [(a, b) for a, b in zip(np.repeat(np.arange(len(count)), count), cells["neighbors"])
                 if b >= 0 and a != b and a in color and b in color]
        assert len(pairs) > 2000
        same = [pair for pair in pairs if color[pair[0]] == color[pair[1]]]
        assert not same, f"{same[:5]} have one color"
        assert len(set(color.values())) <= (7 if len(domain) > 2 else 6)


def sheets_leave_the_map(maps):
    """What stands around the map leaves its pixels, and files that say where pixels lie count from those of the .png."""
    options = [*maps.four, "--color", "@rain", "--edges"]
    maps.render(*options, "-o", "p.png", "--ids", "p.npy")
    sheet = ["--title", "Rain <&> Łódź", "--legend", "beside", "--legend-title", "Rain, mm"]
    maps.render(*options, *sheet, "-o", "q.png", "-o", "q.svg", "-o", "q.pdf", "-o", "q.pgw", "--ids", "q.npy",
                "--stats", "q.json")
    plain, png, ids = maps.read_png("p.png"), maps.read_png("q.png"), np.load("q.npy")
    assert np.array_equal(ids, np.load("p.npy")), "the ids are others"
    with open("q.pgw", encoding="utf-8") as file:
        width, _, _, height, x, y = (float(line) for line in file)
    left, top = (round((start - at) / step) for start, at, step in ((width / 2, x, width), (1 + height / 2, y, height)))
    assert left > 0 and top > 10, f"it begins at {left}, {top}"
    assert np.array_equal(png[top : top + 300, left : left + 400], plain), "the map is not where the .pgw says"
    assert (png[:top] < 128).any() and (png[top:, left + 400 :] < 128).any(), "there is no title, or no legend"
    root = xml.etree.ElementTree.parse("q.svg").getroot()
    assert root.get("viewBox") == f"-{left} -{top} {png.shape[1]} {png.shape[0]}", root.get("viewBox")
    texts = texts_of("q.svg")
    assert {"Rain <&> Łódź", "Rain, mm", "20", "no value"} <= set(texts), texts
    if shutil.which("pdftotext"):
        text = subprocess.run(["pdftotext", "q.pdf", "-"], capture_output=True, check=True, encoding="utf-8").stdout
        assert "Rain <&> Łódź" in text and "Rain, mm" in text and "no value" in text, text


def labels_are_texts(maps):
    maps.render(*maps.four, "--labels", "@town", "-o", "p.png", "-o", "p.svg", "-o", "p.pdf")
    assert sorted(texts_of("p.svg")) == ["Ankh", "São", "Zürich", "Łódź"], texts_of("p.svg")
    labeled = maps.read_png("p.png")
    maps.render(*maps.four, "-o", "q.png")
    changed = np.argwhere((labeled != maps.read_png("q.png")).any(2))
    assert len(changed) > 200
    for part in ((0, 0), (0, 200), (150, 0), (150, 200)):
        near = (changed >= part) & (changed < np.add(part, (150, 200)))
        assert near.all(1).any(), f"no label near {part}"
    if shutil.which("pdftotext"):
        text = subprocess.run(["pdftotext", "p.pdf", "-"], capture_output=True, check=True, encoding="utf-8").stdout
        assert "Zürich" in text and "Łódź" in text, text
    for town, kinds in (("Москва", ("png",)), ("東京", ("png", "pdf"))):
        with open("far.csv", "w", encoding="utf-8") as file:
            file.write(f"x,y,town\n0,0,{town}\n1,1,Oslo\n")
        far = ["--sites", "far.csv", "--labels", "@town", "--size", "300"]
        maps.render(*far, *[word for kind in {"svg", "pdf"} - set(kinds) for word in ("-o", f"p.{kind}")])
        assert sorted(texts_of("p.svg")) == ["Oslo", town]
        for kind in kinds:
            said = maps.render(*far, "-o", f"far.{kind}", code=2)
            assert town in said and said.count("\n") == 1, said


def labels_stand_in_their_cells(maps):
    """Also of sites that lie elsewhere, and of cells whose middle lies outside."""
    with open("u.wkt", "w", encoding="utf-8") as file:
        file.write("POLYGON ((0 0, 9 0, 9 6, 6 6, 6 2, 3 2, 3 6, 0 6, 0 0))")
    with open("u.csv", "w", encoding="utf-8") as file:
        file.write("x,y,name\n4.5,5,Middle\n-3,-9,South\n2,13,North\n4.5,3,Both\n")
    for marks in ([], ["--show-sites"]):
        maps.render("--sites", "u.csv", "--domain", "u.wkt", "--size", "600", "--labels", "@name", *marks, "--ids", "u.npy",
                    "-o", "u.svg")
        ids, found = np.load("u.npy"), {}
        names = ["Middle", "South", "North", "Both"]
        for text in elements_of("u.svg", "text"):
            found[text.text] = float(text.get("x")), float(text.get("y")) - 5
        visible = {names[site] for site in np.unique(ids[ids != NO_SITE])}
        assert visible == set(found), f"{visible} are visible, {set(found)} have labels"
        for name, (x, y) in found.items():
            assert ids[int(y), int(x)] == names.index(name), f"{name} stands at {x}, {y}"


def borders_are_those_of_features(maps):
    """What --by changes of a picture are pixels beside borders; shapes have each border as a ring."""
    rings = {"west": [[0, 0], [4, 0], [4.5, 3], [4, 6], [0, 6]], "east": [[4, 0], [10, 0], [10, 6], [4, 6], [4.5, 3]]}
    with open("parts.geojson", "w", encoding="utf-8") as file:
        json.dump({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"name": name}, "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}}
            for name, ring in rings.items()]}, file)
    with open("many.csv", "w", encoding="utf-8") as file:
        file.write("x,y\n" + "".join(f"{x},{y}\n" for x, y in np.random.default_rng(3).uniform(0, [10, 6], (40, 2))))
    options = ["--sites", "many.csv", "--domain", "parts.geojson", "--size", "500x300", "--edges"]
    for smooth in ([], ["--antialias", "3"]):
        maps.render(*options, *smooth, "-o", "p.png", "--ids", "p.npy")
        maps.render(*options, *smooth, "--by", "name", "--check", "-o", "q.png", "--ids", "q.npy", "-o", "q.svg", "-o", "q.pdf")
        assert (np.load("p.npy") == np.load("q.npy")).all(), "borders change the site of a pixel"
        changed = (maps.read_png("p.png") != maps.read_png("q.png")).any(-1)
        line = np.concatenate([np.linspace([4, 0], [4.5, 3], 600), np.linspace([4.5, 3], [4, 6], 600)]) * 50
        row, column = np.nonzero(changed[5:-5, 5:-5])
        distance = np.hypot(column[:, None] + 5.5 - line[:, 0], row[:, None] + 5.5 - line[:, 1]).min(1)
        assert len(distance) > 300 and distance.max() < 3, f"{len(distance)} pixels differ, up to {distance.max()} off the border"
    borders = [path for path in elements_of("q.svg", "g") if path.get("id") == "borders"][0][0].get("d")
    found = sorted(sorted(tuple(float(n) for n in point.split()) for point in re.findall(r"[-\d.]+ [-\d.]+", ring))
                   for ring in borders.split("Z")[:-1])
    wanted = sorted(sorted((50.0 * x, 300 - 50.0 * y) for x, y in ring) for ring in rings.values())
    assert np.allclose(found, wanted), f"{found} are the borders"
    maps.run("render", "--globe", *options, "--by", "name", "--view-from", "5,3", "-o", "p.png", "-o", "p.svg", "--check")
    rings_there = [path for path in elements_of("p.svg", "g") if path.get("id") == "borders"][0][0].get("d").count("Z")
    assert rings_there == 2, f"{rings_there} borders on the globe"
    said = maps.render("--sites", "many.csv", "--by", "name", "-o", "p.png", code=2)
    assert "--by: is for features of a file that --domain names" in said, said


def names_leave_small_cells(maps):
    """Names stand beside dots over a halo, on what is no cell as well; dots at the rim are whole."""
    with open("rim.csv", "w", encoding="utf-8") as file:
        file.write("x,y,name\n0.5,0.5,Middle\n0.995,0.5,Harbour\n")
    with open("rim.wkt", "w", encoding="utf-8") as file:
        file.write("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((1.6 0, 1.61 0, 1.61 1, 1.6 1, 1.6 0)))")
    options = ["--sites", "rim.csv", "--domain", "rim.wkt", "--size", "322x200", "--labels", "@name", "--show-sites",
               "--color", "distinct", "--dot-size", "12", "--view", "0,0,1.61,1"]
    maps.render(*options, "-o", "p.png", "-o", "p.svg", "-o", "p.pdf", "--ids", "p.npy")
    png, ids = maps.read_png("p.png"), np.load("p.npy")
    assert ids[100, 202] == NO_SITE and png[100, 202].min() > 250, f"the dot at the rim is cut: {png[100, 202]}"
    text = {element.text: element for element in elements_of("p.svg", "text")}["Harbour"]
    middle = float(text.get("x")), float(text.get("y")) - 5
    assert abs(middle[0] - 199) > 20 or abs(middle[1] - 100) > 10, f"the name covers its dot: {middle}"
    assert text.get("stroke") == "#ffffff" and text.get("paint-order") == "stroke", text.attrib
    if shutil.which("pdftotext"):
        said = subprocess.run(["pdftotext", "p.pdf", "-"], capture_output=True, check=True, encoding="utf-8").stdout
        assert "Harbour" in said, said


def areas_have_a_unit(maps):
    """Beside a map in a metric system areas are in km2; a title of one's own leaves the numbers."""
    with open("utm.csv", "w", encoding="utf-8") as file:
        file.write("x,y\n500000,5000000\n503000,5000000\n")
    options = ["--sites", "utm.csv", "--crs", "EPSG:32632", "--domain", "499000,4999000,507000,5001000", "--color", "area",
               "--legend", "beside"]
    maps.render(*options, "-o", "p.svg")
    texts = texts_of("p.svg")
    assert "area, km²" in texts and {"5", "11"} <= set(texts), texts
    maps.render(*options, "--legend-title", "m²", "-o", "p.svg")
    assert {"m²", "5e6", "1.1e7"} <= set(texts_of("p.svg")), texts_of("p.svg")


def elements_of(path, tag):
    return list(xml.etree.ElementTree.parse(path).getroot().iter("{http://www.w3.org/2000/svg}" + tag))


def texts_of(path):
    return [element.text for element in elements_of(path, "text")]


def check_maps(vorpipe, read_png):
    """The number of failures."""
    failures = 0
    maps = Maps(vorpipe, read_png)
    for check in (numbers_are_colors, names_are_colors, neighbors_differ, sheets_leave_the_map, labels_are_texts,
                  labels_stand_in_their_cells, names_leave_small_cells, areas_have_a_unit, borders_are_those_of_features, *GLOBE_CHECKS):
        try:
            check(maps)
        except AssertionError as error:
            failures += 1
            print(f"FAILED: {check.__name__}: {error}")
    return failures
