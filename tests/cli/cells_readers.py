#!/usr/bin/env python3
"""Files of cells, read by programs that are not ours and compared with the .npz.

Usage: cells_readers.py VORPIPE. A missing reader is said to be SKIPPED; exits with 77 without NumPy.
"""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import numpy as np
except ImportError:
    print("SKIPPED: there is no NumPy, and with it nothing to compare with")
    sys.exit(77)

sys.dont_write_bytecode = True  # the modules beside this one are in the source tree
from cells_readers_data import Cells, equal, near, program, shoelace
from cells_readers_mesh import assimp_meshes, python_obj, python_ply, vtk_meshes

WORDS = ["ok", "empty", "duplicate"]
FORMATS = ["npz", "csv", "geojson", "wkt", "svg", "obj", "ply", "vtk"]


def numpy_npz(cells):
    edges = 0
    for site in cells.faces():
        ring = cells.ring(site)
        near(shoelace(ring), cells.areas[site], f"area of site {site}")
        lengths = np.hypot(*(np.roll(ring, -1, 0) - ring).T)
        near(lengths.sum(), cells.perimeters[site], f"perimeter of site {site}")
        for other in cells.neighbors_of(site):
            edges += 1
            assert other < 0 or site in cells.neighbors_of(other), f"{other} is not a neighbor of {site}"
    assert edges == len(cells.neighbors) == len(cells.edge_lengths) == len(cells.cell_vertices)
    xmin, ymin, xmax, ymax = cells.domain
    near(cells.areas.sum(), (xmax - xmin) * (ymax - ymin), "sum of areas", 1e-6)
    own = np.flatnonzero(cells.status != 2)
    equal(cells.owners[own], own, "owners")
    equal(cells.sites[cells.owners], cells.sites, "positions of the owners")
    for triangle in cells.triangles:
        assert shoelace(cells.sites[triangle]) > 0, f"triangle {triangle} is not counter-clockwise"


def python_csv(cells):
    with open("c.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    header = "site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors"
    assert list(rows[0]) == header.split(","), rows[0]

    def column(name):
        return [float(row[name]) for row in rows]

    equal(column("site"), range(cells.count), "site")
    equal([row["status"] for row in rows], [WORDS[status] for status in cells.status], "status")
    equal(np.array([column("x"), column("y")]).T, cells.sites, "x, y")
    equal(column("area"), cells.areas, "area")
    equal(column("perimeter"), cells.perimeters, "perimeter")
    equal(np.array([column("centroid_x"), column("centroid_y")]).T, cells.centroids, "centroid")
    equal(column("vertices"), np.diff(cells.cell_offsets), "vertices")
    neighbors = [int(word) for row in rows for word in row["neighbors"].split()]
    equal(neighbors, cells.neighbors, "neighbors")


def python_geojson(cells):
    with open("c.geojson") as file:
        collection = json.load(file)
    assert collection["type"] == "FeatureCollection" and len(collection["features"]) == cells.count
    for site, feature in enumerate(collection["features"]):
        properties, geometry = feature["properties"], feature["geometry"]
        assert feature["type"] == "Feature" and feature["id"] == site
        assert properties["status"] == WORDS[cells.status[site]]
        assert properties["owner"] == cells.owners[site]
        equal([properties["x"], properties["y"]], cells.sites[site], "x, y")
        equal(properties["area"], cells.areas[site], "area")
        equal(properties["perimeter"], cells.perimeters[site], "perimeter")
        equal(properties["centroid"], cells.centroids[site], "centroid")
        equal(properties["neighbors"], cells.neighbors_of(site), "neighbors")
        if geometry is None:
            assert site not in cells.faces()
            continue
        assert geometry["type"] == "Polygon" and len(geometry["coordinates"]) == 1
        ring = cells.ring(site)
        equal(geometry["coordinates"][0], np.vstack([ring, ring[:1]]), "ring")


def ogr_geojson(cells):
    query = "SELECT status, area, OGR_GEOM_AREA AS measured, OGR_GEOMETRY AS kind FROM c"
    text = program("ogr2ogr", "-f", "CSV", "/vsistdout/", "c.geojson", "c", "-dialect", "OGRSQL", "-sql", query)
    if text is None:
        return "ogr2ogr"
    rows = list(csv.DictReader(text.splitlines()))
    assert len(rows) == cells.count, f"{len(rows)} features"
    for site, row in enumerate(rows):
        assert row["status"] == WORDS[cells.status[site]]
        if row["kind"]:
            assert row["kind"] == "POLYGON", row
            near(float(row["measured"]), cells.areas[site], f"area of site {site}", 1e-6)
    return None


def geos_wkt(cells):
    try:
        import shapely.ops
        import shapely.wkt
    except ImportError:
        return "Shapely"
    with open("c.wkt") as file:
        polygons = list(shapely.wkt.loads(file.read()).geoms)
    assert len(polygons) == cells.count, f"{len(polygons)} polygons"
    for site, polygon in enumerate(polygons):
        ring = cells.ring(site)
        assert polygon.geom_type == "Polygon" and polygon.is_empty == (site not in cells.faces())
        if not polygon.is_empty:
            assert polygon.is_valid and polygon.exterior.is_ccw, f"polygon of site {site}"
            equal(np.array(polygon.exterior.coords), np.vstack([ring, ring[:1]]), "ring")
    union = shapely.ops.unary_union(polygons)
    assert union.geom_type == "Polygon" and len(union.interiors) == 0, "the cells leave gaps"
    equal(union.bounds, cells.domain, "box of the cells")
    return None


def python_svg(cells):
    svg = "{http://www.w3.org/2000/svg}"
    root = xml.etree.ElementTree.parse("c.svg").getroot()
    width, height = (float(word) for word in root.get("viewBox").split()[2:])
    xmin, ymin, xmax, ymax = cells.domain
    scale = 1000 / max(xmax - xmin, ymax - ymin)
    near(width, (xmax - xmin) * scale, "width", 1e-6)
    near(height, (ymax - ymin) * scale, "height", 1e-6)
    polygons = root.findall(svg + "polygon")
    assert len(polygons) == len(cells.faces()), f"{len(polygons)} polygons"
    for site, polygon in zip(cells.faces(), polygons):
        title = re.fullmatch("site (.*), area (.*)", polygon.find(svg + "title").text)
        assert int(title[1]) == site and float(title[2]) == cells.areas[site], title[0]
        points = np.array([pair.split(",") for pair in polygon.get("points").split()], float)
        expected = (cells.ring(site) * [1, -1] - [xmin, -ymax]) * scale
        assert np.abs(points - expected).max() < 1e-4, f"polygon of site {site}"


def libxml_svg(_):
    return "xmllint" if program("xmllint", "--noout", "c.svg") is None else None


def librsvg_svg(_):
    return "rsvg-convert" if program("rsvg-convert", "c.svg", "--output", "c.png") is None else None


CHECKS = [numpy_npz, python_csv, python_geojson, ogr_geojson, geos_wkt, python_svg, libxml_svg, librsvg_svg]
CHECKS += [python_obj, python_ply, assimp_meshes, vtk_meshes]


def scenes():
    with open("few.csv", "w") as file:
        file.write("x,y\n.2,.3\n.7,.3\n.2,.3\n.5,.8\n5,5\n.1,.9\n.9,.6\n-3,.5\n.35,.55\n.7,.3\n")
    yield "few.csv", (0, 0, 1, 0.95)
    yield "random:400", (0, 0, 1, 1)
    yield "square:100", (0, 0, 1, 1)
    yield "random:300", (0.25, 0.5, 0.75, 0.625)


def main():
    vorpipe = os.path.abspath(sys.argv[1])
    failures, skipped = 0, set()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for sites, domain in scenes():
            outputs = [word for extension in FORMATS for word in ("-o", f"c.{extension}")]
            box = ",".join(map(str, domain))
            command = [vorpipe, "cells", "--backend", "cpu", "--sites", sites, "--domain", box, "--quiet", *outputs]
            subprocess.run(command, check=True)
            cells = Cells("c.npz", domain)
            for check in CHECKS:
                try:
                    missing = check(cells)
                    if missing:
                        skipped.add(f"SKIPPED: {check.__name__}: there is no {missing}")
                except Exception as error:  # whatever a reader throws
                    failures += 1
                    print(f"FAILED: {check.__name__} of {sites}: {error!r}"[:200])
        os.chdir("/")
    print("\n".join(sorted(skipped)))
    print(f"{failures} checks failed, {len(skipped)} of {len(CHECKS)} readers are missing")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
