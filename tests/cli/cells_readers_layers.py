"""GeoPackages of cells, and edges as lines, read by programs that are not ours."""

import csv
import json
import sqlite3
import struct

import numpy as np

from cells_readers_data import equal, near, program

WORDS = ["ok", "empty", "duplicate"]


def rows_of(path, table):
    with sqlite3.connect(path) as database:
        database.row_factory = sqlite3.Row
        assert database.execute("PRAGMA integrity_check").fetchone()[0] == "ok"
        assert database.execute("PRAGMA foreign_key_check").fetchall() == []
        assert database.execute("PRAGMA application_id").fetchone()[0] == int.from_bytes(b"GPKG", "big")
        assert database.execute("PRAGMA user_version").fetchone()[0] == 10300
        assert database.execute(f"SELECT rtreecheck('rtree_{table}_geom')").fetchone()[0] == "ok"
        contents = database.execute("SELECT * FROM gpkg_contents").fetchall()
        assert [(row["table_name"], row["data_type"], row["srs_id"]) for row in contents] == [(table, "features", -1)]
        systems = [row["srs_id"] for row in database.execute("SELECT * FROM gpkg_spatial_ref_sys ORDER BY srs_id")]
        assert systems == [-1, 0, 4326], systems
        rows = database.execute(f'SELECT * FROM "{table}" ORDER BY fid').fetchall()
        boxes = {row[0]: row[1:] for row in database.execute(f"SELECT * FROM rtree_{table}_geom")}
    bounds = [envelope(row["geom"]) for row in rows if row["geom"]]
    assert list(boxes) and len(boxes) == len(bounds)
    for row in rows:
        if row["geom"]:  # the index has floats, rounded outward
            xmin, xmax, ymin, ymax = envelope(row["geom"])
            box = boxes[row["fid"]]
            assert box[0] <= xmin and xmax <= box[1] and box[2] <= ymin and ymax <= box[3]
    mins, maxs = np.min(bounds, 0), np.max(bounds, 0)
    equal([contents[0][name] for name in ("min_x", "max_x", "min_y", "max_y")], [mins[0], maxs[1], mins[2], maxs[3]], "box")
    return rows


def envelope(blob):
    """The envelope of a geometry: it stands before the WKB."""
    assert blob[:4] == b"GP\0\3" and struct.unpack_from("<i", blob, 4) == (-1,)
    return struct.unpack_from("<4d", blob, 8)


def sqlite_gpkg(cells):
    try:
        import shapely.geometry
        import shapely.wkb
    except ImportError:
        return "Shapely"
    rows = rows_of("c.gpkg", "cells")
    equal([row["site"] for row in rows], range(cells.count), "site")
    equal([row["status"] for row in rows], [WORDS[status] for status in cells.status], "status")
    equal([row["owner"] for row in rows], cells.owners, "owner")
    equal([(row["x"], row["y"]) for row in rows], cells.sites, "x, y")
    equal([row["area"] for row in rows], cells.areas, "area")
    equal([row["perimeter"] for row in rows], cells.perimeters, "perimeter")
    equal([(row["centroid_x"], row["centroid_y"]) for row in rows], cells.centroids, "centroid")
    equal([row["vertices"] for row in rows], np.diff(cells.cell_offsets), "vertices")
    equal([int(word) for row in rows for word in row["neighbors"].split()], cells.neighbors, "neighbors")
    if hasattr(cells, "weights"):
        equal([row["weight"] for row in rows], cells.weights, "weight")
    for site, row in enumerate(rows):
        pieces = cells.pieces(site)
        if not pieces:
            assert row["geom"] is None
            continue
        shape = shapely.wkb.loads(row["geom"][40:])
        assert shape.geom_type == "MultiPolygon" and shape.is_valid
        expected = shapely.geometry.MultiPolygon([(piece[0], piece[1:]) for piece in pieces])
        assert shape.equals_exact(expected, 0), f"cell of site {site}"
        xmin, xmax, ymin, ymax = envelope(row["geom"])
        equal(shape.bounds, (xmin, ymin, xmax, ymax), "envelope")
    return None


def ogr_gpkg(cells):
    text = program("ogrinfo", "-al", "-so", "c.gpkg")
    if text is None:
        return "ogrinfo"
    assert f"Feature Count: {cells.count}" in text and "Geometry: Multi Polygon" in text, text
    query = "SELECT site, area, ST_Area(geom) AS measured FROM cells"
    rows = list(csv.DictReader(program("ogr2ogr", "-f", "CSV", "/vsistdout/", "c.gpkg", "-sql", query).splitlines()))
    assert len(rows) == cells.count
    for row in rows:
        near(float(row["measured"] or 0), float(row["area"]), f"area of site {row['site']}", 1e-6)
    return None


def geopandas_gpkg(cells):
    try:
        import geopandas
    except ImportError:
        return "GeoPandas"
    frame = geopandas.read_file("c.gpkg", layer="cells")
    equal(frame["site"], range(cells.count), "site")
    areas = frame.geometry.area.fillna(0)
    assert np.allclose(areas, cells.areas, rtol=1e-9, atol=1e-15), "areas"
    return None


def lines_of(cells):
    """The edges as the .npz has them: for each entry its cell, its neighbor, where it begins and ends, its length."""
    lines = []
    for site in range(cells.count):
        at = cells.cell_offsets[site]
        for ring in cells.rings(site):
            for begin, end in zip(ring, np.roll(ring, -1, 0)):
                lines.append((site, cells.neighbors[at], *begin, *end, cells.edge_lengths[at]))
                at += 1
    return lines


def python_edges(cells):
    """Every edge is there once, with the coordinates of the first cell that has it."""
    with open("e.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    equal([int(row["edge"]) for row in rows], range(len(rows)), "edge")
    names = ["site_a", "site_b", "x1", "y1", "x2", "y2", "length"]
    found = [tuple(float(row[name]) for name in names) for row in rows]
    lines = lines_of(cells)
    assert set(found) <= set(lines), "edges that no cell has"
    at_walls = int((cells.neighbors < 0).sum())
    assert 2 * len(found) - at_walls == len(lines), f"{len(found)} edges"
    total = sum(line[6] * (2 if line[1] >= 0 else 1) for line in found)
    near(total, cells.edge_lengths.sum(), "sum of lengths")
    for path in "e.geojson", "e.geojsonl":
        with open(path) as file:
            features = json.load(file)["features"] if path == "e.geojson" else [json.loads(line) for line in file]
        of_features = []
        for feature in features:
            properties, (begin, end) = feature["properties"], feature["geometry"]["coordinates"]
            of_features.append((properties["site_a"], properties["site_b"], *begin, *end, properties["length"]))
        equal(of_features, found, path)
    cells.edges = found


def sqlite_edges(cells):
    rows = rows_of("e.gpkg", "edges")
    found = []
    for row in rows:
        order, kind, count, *ends = struct.unpack_from("<BII4d", row["geom"], 40)
        assert (order, kind, count) == (1, 2, 2)
        found.append((row["site_a"], row["site_b"], *ends, row["length"]))
    equal(found, cells.edges, "edges")


def geos_edges(cells):
    try:
        import shapely.wkt
    except ImportError:
        return "Shapely"
    with open("e.wkt") as file:
        lines = list(shapely.wkt.loads(file.read()).geoms)
    equal([np.ravel(line.coords) for line in lines], [line[2:6] for line in cells.edges], "lines")
    return None


def vtk_edges(cells):
    try:
        import vtkmodules.util.numpy_support as support
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    except ImportError:
        return "VTK"
    reader = vtkXMLPolyDataReader()
    reader.SetFileName("e.vtp")
    reader.Update()
    mesh = reader.GetOutput()
    lines = mesh.GetLines()
    equal(support.vtk_to_numpy(lines.GetOffsetsArray()), range(0, 2 * len(cells.edges) + 1, 2), "offsets")
    points = support.vtk_to_numpy(mesh.GetPoints().GetData())
    ends = points[support.vtk_to_numpy(lines.GetConnectivityArray())][:, :2].reshape(-1, 4)
    expected = np.array(cells.edges)
    equal(ends, expected[:, 2:6], "ends")
    for name, values in (("site_a", expected[:, 0]), ("site_b", expected[:, 1]), ("length", expected[:, 6])):
        equal(support.vtk_to_numpy(mesh.GetCellData().GetArray(name)), values, name)
    return None


CELLS_CHECKS = [sqlite_gpkg, ogr_gpkg, geopandas_gpkg]
EDGES_CHECKS = [python_edges, sqlite_edges, geos_edges, vtk_edges]
EDGES_FORMATS = ["csv", "geojson", "geojsonl", "gpkg", "wkt", "vtp"]
