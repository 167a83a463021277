"""What an input says of its sites, through vorpipe and out again, read by programs that are not ours."""

import csv
import json
import sqlite3
import subprocess

from cells_readers_data import program

# As they go in, and the names under which they come out.
CITIES = [
    {"name": "Köln, \"am Rhein\"", "people": 1084831, "Area": 405.01, "twin": True, "names": ["Cologne", "Colonia"]},
    {"name": "Bonn", "people": 9007199254740993, "Area": None, "twin": False, "names": {"la": "Bonna"}},
    {"name": None, "people": None, "Area": 117.06, "twin": None, "names": None},
    {"name": "two\nlines\t;", "people": -1, "Area": 1e-7, "twin": True, "names": []},
]
PLACES = [(6.95, 50.94), (7.1, 50.73), (6.64, 49.75), (7.59, 50.35)]
NAMES = {"name": "name", "people": "people", "Area": "input_Area", "twin": "twin", "names": "names"}


def write_cities(path):
    features = [{"type": "Feature", "properties": city, "geometry": {"type": "Point", "coordinates": place}}
                for city, place in zip(CITIES, PLACES)]
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"type": "FeatureCollection", "features": features}, file, ensure_ascii=False)


def attributes_in_csv():
    with open("cities.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0])[-5:] == list(NAMES.values()), rows[0]
    for city, row in zip(CITIES, rows, strict=True):
        for name, value in city.items():
            text = row[NAMES[name]]
            if value is None or isinstance(value, str):
                assert text == (value or ""), (name, text)
            else:
                assert json.loads(text) == value, (name, text)


def attributes_in_geojson():
    with open("cities.geojson", encoding="utf-8") as file:
        features = json.load(file)["features"]
    for city, feature in zip(CITIES, features, strict=True):
        found = feature["properties"]
        assert {name: found[NAMES[name]] for name in city} == city, found
        assert found["area"] > 0 and feature["geometry"]["type"] == "Polygon"


def attributes_in_gpkg():
    with sqlite3.connect("cities.gpkg") as database:
        database.row_factory = sqlite3.Row
        rows = database.execute("SELECT * FROM cells ORDER BY fid").fetchall()
        types = {row["name"]: row["type"] for row in database.execute("PRAGMA table_info(cells)")}
        assert database.execute("SELECT srs_id FROM gpkg_geometry_columns").fetchone()[0] == 4326
    expected = {"name": "TEXT", "people": "INTEGER", "Area": "DOUBLE", "twin": "BOOLEAN", "names": "TEXT"}
    assert {name: types[NAMES[name]] for name in expected} == expected, types
    for city, row in zip(CITIES, rows, strict=True):
        for name, value in city.items():
            found = row[NAMES[name]]
            if name == "names" and value is not None:
                found = json.loads(found)
            assert found == value, (name, found)


def attributes_in_geopandas():
    try:
        import geopandas
    except ImportError:
        return "GeoPandas"
    for path in "cities.gpkg", "cities.geojson":
        frame = geopandas.read_file(path)
        assert frame.crs.to_epsg() == 4326 and frame.geometry.is_valid.all()
        names = [name if isinstance(name, str) else None for name in frame["name"]]
        assert names == [city["name"] for city in CITIES], names
    return None


def attributes_in_ogr():
    text = program("ogrinfo", "-al", "-so", "cities.gpkg")
    if text is None:
        return "ogrinfo"
    assert "people: Integer64" in text and "twin: Integer(Boolean)" in text and 'ID["EPSG",4326]' in text, text
    return None


CHECKS = [attributes_in_csv, attributes_in_geojson, attributes_in_gpkg, attributes_in_geopandas, attributes_in_ogr]


def check_attributes(vorpipe):
    """For each check its name, and what it lacks; one that fails throws."""
    write_cities("cities.in.geojson")
    outputs = [word for kind in ("csv", "geojson", "gpkg") for word in ("-o", f"cities.{kind}")]
    command = [vorpipe, "cells", "--backend", "cpu", "--sites", "cities.in.geojson", *outputs]
    done = subprocess.run(command, check=True, capture_output=True, encoding="utf-8")
    assert '"Area" to "input_Area"' in done.stderr, done.stderr
    return [(check.__name__, check()) for check in CHECKS]
