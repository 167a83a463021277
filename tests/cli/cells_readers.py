#!/usr/bin/env python3
"""Files of cells, read by programs that are not ours and compared with the .npz.

Usage: cells_readers.py VORPIPE. A missing reader is said to be SKIPPED, in the file that VORPIPE_SKIPPED names as
well; exits with 77 without NumPy.
"""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree


def report_skipped(part, reason):
    """A line for ../skipped.sh; no part is the whole test."""
    print(f"SKIPPED: {part or 'all readers'}: {reason}")
    if path := os.environ.get("VORPIPE_SKIPPED"):
        with open(path, "a") as file:
            file.write(f"{os.environ.get('VORPIPE_TEST_NAME', '')}\t{part}\t{reason}\n")


try:
    import numpy as np
except ImportError:
    report_skipped("", "there is no NumPy, and with it nothing to compare with")
    sys.exit(77)

sys.dont_write_bytecode = True  # the modules beside this one are in the source tree
from cells_readers_attributes import check_attributes
from cells_readers_data import Cells, equal, near, program, shoelace
from cells_readers_layers import CELLS_CHECKS, EDGES_CHECKS, EDGES_FORMATS
from cells_readers_mesh import assimp_meshes, python_obj, python_ply, vtk_meshes, vtk_xml_meshes

WORDS = ["ok", "empty", "duplicate"]
FORMATS = ["npz", "csv", "geojson", "geojsonl", "gpkg", "wkt", "svg", "obj", "ply", "vtk", "vtp", "vtu"]


def numpy_npz(cells):
    edges = 0
    for site in cells.faces():
        rings = cells.rings(site)
        near(sum(shoelace(ring) for ring in rings), cells.areas[site], f"area of site {site}")
        lengths = np.hstack([np.hypot(*(np.roll(ring, -1, 0) - ring).T) for ring in rings])
        near(lengths.sum(), cells.perimeters[site], f"perimeter of site {site}")
        for other in cells.neighbors_of(site):
            edges += 1
            assert other < 0 or site in cells.neighbors_of(other), f"{other} is not a neighbor of {site}"
    assert edges == len(cells.neighbors) == len(cells.edge_lengths) == len(cells.cell_vertices)
    near(cells.areas.sum(), cells.domain_area(), "sum of areas", 1e-6)
    own = np.flatnonzero(cells.status != 2)
    equal(cells.owners[own], own, "owners")
    equal(cells.sites[cells.owners], cells.sites, "positions of the owners")
    for triangle in cells.triangles:
        assert shoelace(cells.sites[triangle]) > 0, f"triangle {triangle} is not counter-clockwise"
    if cells.periodic:
        shifts_name_each_other(cells)


def shifts_name_each_other(cells):
    """Each edge is one of the neighbor's as well, with the opposite shift, moved by it."""
    assert cells.neighbor_shifts.dtype == np.int32
    sides = np.array(cells.domain[2:]) - cells.domain[:2]
    edges = {}
    for site in cells.faces():
        ring, begin = cells.ring(site), cells.cell_offsets[site]
        for k, other in enumerate(cells.neighbors_of(site)):
            shift = cells.neighbor_shifts[begin + k]
            edges[(site, other, *shift)] = ring[k], ring[(k + 1) % len(ring)], shift * sides
    for (site, other, kx, ky), (a, b, moved) in edges.items():
        if other < 0:
            assert (kx, ky) == (0, 0), "a wall has no shift"
            continue
        back = edges[(other, site, -kx, -ky)]
        assert np.allclose(a - moved, back[1], atol=1e-9) and np.allclose(b - moved, back[0], atol=1e-9)


def python_csv(cells):
    with open("c.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    header = "site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors"
    header += ",neighbor_shifts" * bool(cells.periodic) + ",rings" * (cells.outline is not None)
    header += ",owner" * bool((np.array(cells.owners) != np.arange(cells.count)).any())
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
    if cells.periodic:
        shifts = [word.split(":") for row in rows for word in row["neighbor_shifts"].split()]
        equal(np.array(shifts, int), cells.neighbor_shifts, "shifts")
    if cells.outline is not None:
        equal(column("rings"), [len(cells.rings(site)) for site in range(cells.count)], "rings")


def python_geojson(cells):
    with open("c.geojson") as file:
        collection = json.load(file)
    assert collection["type"] == "FeatureCollection"
    check_features(collection["features"], cells)


def python_geojsonl(cells):
    with open("c.geojsonl") as file:
        check_features([json.loads(line) for line in file], cells)


def check_features(features, cells):
    assert len(features) == cells.count, f"{len(features)} features"
    for site, feature in enumerate(features):
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
        pieces, polygons = cells.pieces(site), geometry["coordinates"]
        assert geometry["type"] == ("Polygon" if len(pieces) == 1 else "MultiPolygon")
        polygons = [polygons] if len(pieces) == 1 else polygons
        assert [len(piece) for piece in pieces] == [len(polygon) for polygon in polygons]
        for ring, written in zip(sum(pieces, []), sum(polygons, [])):
            equal(written, np.vstack([ring, ring[:1]]), "ring")


def ogr_geojson(cells):
    for name in ["c.geojson", "GeoJSONSeq:c.geojsonl"]:
        if missing := ogr(name, cells):
            return missing
    return None


def ogr(name, cells):
    query = "SELECT status, area, OGR_GEOM_AREA AS measured, OGR_GEOMETRY AS kind FROM c"
    text = program("ogr2ogr", "-f", "CSV", "/vsistdout/", name, "c", "-dialect", "OGRSQL", "-sql", query)
    if text is None:
        return "ogr2ogr"
    rows = list(csv.DictReader(text.splitlines()))
    assert len(rows) == cells.count, f"{len(rows)} features"
    for site, row in enumerate(rows):
        assert row["status"] == WORDS[cells.status[site]]
        if row["kind"]:
            assert row["kind"] == ("POLYGON" if len(cells.pieces(site)) == 1 else "MULTIPOLYGON"), row
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
        pieces = cells.pieces(site)
        assert polygon.geom_type == ("MultiPolygon" if len(pieces) > 1 else "Polygon")
        assert polygon.is_empty == (not pieces)
        found = [] if polygon.is_empty else [polygon] if len(pieces) == 1 else polygon.geoms
        for piece, part in zip(pieces, found):
            assert part.is_valid and part.exterior.is_ccw, f"polygon of site {site}"
            for ring, line in zip(piece, [part.exterior, *part.interiors]):
                equal(np.array(line.coords), np.vstack([ring, ring[:1]]), "ring")
    if cells.periodic or cells.outline is not None:
        return None
    union = shapely.ops.unary_union(polygons)
    assert union.geom_type == "Polygon" and len(union.interiors) == 0, "the cells leave gaps"
    equal(union.bounds, cells.domain, "box of the cells")
    return None


def python_svg(cells):
    svg = "{http://www.w3.org/2000/svg}"
    root = xml.etree.ElementTree.parse("c.svg").getroot()
    width, height = (float(word) for word in root.get("viewBox").split()[2:])
    (xmin, ymin), (xmax, ymax) = cells.cell_vertices.min(0), cells.cell_vertices.max(0)
    if not cells.periodic and cells.outline is None:
        equal((xmin, ymin, xmax, ymax), cells.domain, "box of the cells")
    scale = 1000 / max(xmax - xmin, ymax - ymin)
    near(width, (xmax - xmin) * scale, "width", 1e-6)
    near(height, (ymax - ymin) * scale, "height", 1e-6)
    shapes = [shape for shape in root if shape.tag in (svg + "polygon", svg + "path")]
    assert len(shapes) == len(cells.faces()), f"{len(shapes)} shapes"
    for site, shape in zip(cells.faces(), shapes):
        title = re.fullmatch("site (.*), area (.*)", shape.find(svg + "title").text)
        assert int(title[1]) == site and float(title[2]) == cells.areas[site], title[0]
        lines = [shape.get("points")] if shape.tag == svg + "polygon" else re.findall("M([^Z]*)Z", shape.get("d"))
        rings = cells.rings(site)
        assert len(lines) == len(rings), f"{len(lines)} rings of site {site}"
        for line, ring in zip(lines, rings):
            points = np.array([pair.split(",") for pair in line.split()], float)
            assert np.abs(points - (ring * [1, -1] - [xmin, -ymax]) * scale).max() < 1e-4, f"site {site}"


def libxml_svg(_):
    return "xmllint" if program("xmllint", "--noout", "c.svg") is None else None


def librsvg_svg(_):
    return "rsvg-convert" if program("rsvg-convert", "c.svg", "--output", "c.png") is None else None


CHECKS = [numpy_npz, python_csv, python_geojson, python_geojsonl, ogr_geojson, geos_wkt]
CHECKS += [python_svg, libxml_svg, librsvg_svg]
CHECKS += [python_obj, python_ply, assimp_meshes, vtk_meshes, vtk_xml_meshes]
CHECKS += CELLS_CHECKS + EDGES_CHECKS


class Scene:
    def __init__(self, sites, domain, periodic=None, outline=None, options=()):
        self.sites, self.domain, self.periodic, self.outline = sites, domain, periodic, outline
        self.options = ["--sites", sites, "--domain", outline or ",".join(map(str, domain)), *options]
        self.options += ["--periodic", periodic] if periodic else []


def scenes():
    with open("few.csv", "w") as file:
        file.write("x,y\n.2,.3\n.7,.3\n.2,.3\n.5,.8\n5,5\n.1,.9\n.9,.6\n-3,.5\n.35,.55\n.7,.3\n")
    with open("ring.wkt", "w") as file:
        file.write("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0), (.2 .2, .8 .2, .8 .8, .2 .8, .2 .2)),"
                   " ((.4 .4, .6 .4, .6 .6, .4 .6, .4 .4)))")
    unit = (0, 0, 1, 1)
    yield Scene("few.csv", (0, 0, 1, 0.95))
    yield Scene("random:400", unit)
    yield Scene("square:100", unit)
    yield Scene("random:300", (0.25, 0.5, 0.75, 0.625))
    yield Scene("random:300", unit, options=["--random-weights", "0,.01"])
    yield Scene("random:300", unit, periodic="xy")
    yield Scene("random:40", (0, 0, 1, 2), periodic="x", options=["--random-weights", "0,.01"])
    yield Scene("random:100", unit, outline="ring.wkt")
    yield Scene("random:2", unit, outline="ring.wkt")


def main():
    vorpipe = os.path.abspath(sys.argv[1])
    failures, skipped = 0, set()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for scene in scenes():
            outputs = [word for extension in FORMATS for word in ("-o", f"c.{extension}")]
            outputs += [word for extension in EDGES_FORMATS for word in ("--edges", f"e.{extension}")]
            command = [vorpipe, "cells", "--backend", "cpu", *scene.options, "--quiet", *outputs]
            subprocess.run(command, check=True)
            cells = Cells("c.npz", scene)
            for check in CHECKS:
                try:
                    missing = check(cells)
                    if missing:
                        skipped.add((check.__name__, f"there is no {missing}"))
                except Exception as error:  # whatever a reader throws
                    failures += 1
                    print(f"FAILED: {check.__name__} of {' '.join(scene.options)}: {error!r}"[:300])
        try:
            missing = check_attributes(vorpipe)
            skipped.update((name, f"there is no {program}") for name, program in missing if program)
        except Exception as error:
            failures += 1
            print(f"FAILED: check_attributes: {error!r}"[:300])
        os.chdir("/")
    for part, reason in sorted(skipped):
        report_skipped(part, reason)
    print(f"{failures} checks failed, {len(skipped)} of {len(CHECKS)} readers are missing")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
