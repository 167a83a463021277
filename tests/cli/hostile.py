"""Writes files that are made to crash, to hang or to take memory, into the folder of the first argument; with a second
argument, a number of megabytes, lines and packed files are that long. Usage: hostile.py FOLDER [MEGABYTES]"""
import gzip
import io
import os
import random
import sqlite3
import struct
import sys
import zipfile
import zlib

import numpy

folder = sys.argv[1]
megabytes = int(sys.argv[2]) if len(sys.argv) > 2 else 64
noise = random.Random(1).randbytes(100_000)


def write(name, content):
    with open(os.path.join(folder, name), "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode("latin-1"))


def write_long(name, begin, byte=b"0"):
    """Its size is that of a line without an end; of zeros it takes no room on the disk."""
    with open(os.path.join(folder, name), "wb") as file:
        file.write(begin)
        if byte == b"\0":
            file.truncate(megabytes << 20)
        else:
            for _ in range(megabytes):
                file.write(byte * (1 << 20))


def write_packed(name, begin):
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    packed = packer.compress(begin)
    for _ in range(megabytes):
        packed += packer.compress(b"0" * (1 << 20))
    write(name, packed + packer.flush())


def array(shape, data=b"", kind="'<f8'", fortran=False):
    header = f"{{'descr': {kind}, 'fortran_order': {fortran}, 'shape': {shape}, }}".encode()
    header += b" " * (63 - (10 + len(header)) % 64) + b"\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header + data


def texts():
    for kind in "csv tsv txt npy npz geojson geojsonl wkt gpkg png jpg csv.gz".split():
        write("noise." + kind, noise)
    write("thousands.csv", 'x,y\n"1,234.5",2\n"2,345.5",3\n')
    write("blanks.csv", "x,y\n1 234.5,2\n3,3\n")
    for name, number in {"1e999": "1e999", "hex": "0x1p3", "inf": "inf", "nan": "nan", "digits": "1" * 4000,
                         "nul": "1\0"}.items():
        write(f"{name}.csv", f"x,y\n0,0\n1,{number}\n")
    write("utf16.csv", "\ufeffx,y\n0,0\n".encode("utf-16-le"))
    write("latin1.csv", "x,y,name\n0,0,Z\xfcrich\n1,1,Gen\xe8ve\n2,0.5,Bern\n")
    write("cr.csv", "x,y\r0,0\r1,1\r2,0\r")
    write("tiny.csv", "x,y\n0,1e-400\n1,0.5\n2,0." + "3" * 4000 + "\n")
    write("far.csv", "x,y\n1e308,1e308\n-1e308,-1e308\n")
    write("subnormal.csv", "x,y\n5e-324,0\n0,1e-310\n1e-320,1e-320\n")
    write("columns.csv", "x,y" + ",a" * 50_000 + "\n" + "".join(f"{k},{k * k}" + "," * 50_000 + "\n" for k in range(3)))
    write("duplicates.csv", "x,y\n" + "1,1\n" * 1_000_000)
    for kind, begin in {"csv": b"x,y\n0,", "txt": b"0 ", "wkt": b"POINT(", "geojson": b'{"a":"',
                        "geojsonl": b'{"a":"'}.items():
        write_long("line." + kind, begin)
        write_packed(f"packed.{kind}.gz", begin)
        write_long("zeros." + kind, begin, b"\0")


def tangles():
    places = [f"{x} {y}" for x, y in numpy.random.default_rng(2).integers(0, 10_000, (2000, 2))]
    write("tangle.wkt", f"POLYGON (({', '.join(places + places[:1])}))")


def json():
    deep = "[" * 100_000
    point = '{"type":"Feature","geometry":{"type":"Point","coordinates":[1,2]},"properties":'
    features = '{"type":"FeatureCollection","features":['
    write("deep.geojson", deep)
    write("deep.geojsonl", deep + "]" * 100_000 + "\n")
    write("deep_property.geojson", features + point + '{"a":' + deep + "]" * 100_000 + "}}]}")
    write("deep_geometry.geojson", features + '{"type":"Feature","properties":null,"geometry":'
          + '{"type":"GeometryCollection","geometries":[' * 100_000)
    write("members.geojson", features + point + "{" + ",".join(f'"k{k}":1' for k in range(100_000)) + "}}]}")
    write("siblings.geojson", features + point + '{"a":[' + ",".join(["{}"] * 300_000) + "]}}]}")
    write("attributes.geojson", features
          + ",".join(point + f'{{"p{k}":1}}}}' for k in range(3000)) + "]}")
    write("1e999.geojson", '{"type":"Point","coordinates":[1e999,2]}')
    write("surrogate.geojson", features + point + '{"a":"\\ud800"}}]}')


def arrays():
    write("more.npy", array("(1000000000, 2)", b"\0" * 160))
    write("less.npy", array("(2, 2)", b"\0" * 1600))
    write("huge.npy", array("(9223372036854775808, 2)", b"\0" * 160))
    write("wrapped.npy", array("(4611686018427387905, 4)", b"\0" * 32))
    write("negative.npy", array("(-1, 2)", b"\0" * 160))
    write("object.npy", array("(3, 2)", b"\0" * 48, "'|O'"))
    write("structured.npy", array("(3,)", b"\0" * 48, "[('x', '<f8'), ('y', '<f8')]"))
    write("axes.npy", array("(" + "1," * 20_000 + ")", b"\0" * 8))
    write("header.npy", b"\x93NUMPY\2\0" + struct.pack("<I", 0xFFFFFFFF) + b"{" * 100)
    write("nan.npy", array("(2, 2)", struct.pack("<4d", 0, 1, float("nan"), 2)))
    write("fortran.npy", array("(3, 2)", numpy.array([0, 1, 2, 0, 5, 1.0]).tobytes(), fortran=True))
    write("more.npy.gz", gzip.compress(array("(1000000000, 3)", b"\0" * 240)))
    write("packed.npy", gzip.compress(array("(1048576, 1048576)", b"\0" * 160)))
    stored = io.BytesIO()
    numpy.savez(stored, sites=numpy.zeros((9, 2)), domain=numpy.array([0, 0, 1, 1.0]))
    stored = stored.getvalue()
    nine = numpy.random.default_rng(1).random((9, 2))
    for name, more in {"time": {"time": numpy.nan}, "length": {"length": numpy.inf}, "box": {"domain": numpy.zeros(4)},
                       "gravity": {"gravity": [1, 2.0, 3]}, "tolerance": {"tolerance": numpy.inf}}.items():
        checkpoint = {"sites": nine, "domain": [0, 0, 1, 1.0]} | more
        numpy.savez(os.path.join(folder, name + ".npz"), **{k: numpy.atleast_1d(v) for k, v in checkpoint.items()})
    with zipfile.ZipFile(os.path.join(folder, "shape.npz"), "w") as archive:
        archive.writestr("sites.npy", array("(9, 99)", b"\0" * 144))
        archive.writestr("domain.npy", array("(4,)", struct.pack("<4d", 0, 0, 1, 1)))
    numpy.savez(os.path.join(folder, "columns.npz"), sites=numpy.zeros((9, 3)), domain=[0, 0, 1, 1])
    numpy.savez(os.path.join(folder, "other.npz"), sites=nine, domain=[0, 0, 1, 1], velocities=nine)
    write("bit.npz", stored.replace(struct.pack("<d", 1), struct.pack("<d", 2), 1))
    write("cut.npz", stored[: len(stored) // 2])
    deflated = io.BytesIO()
    with zipfile.ZipFile(deflated, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("sites.npy", array("(100000000, 2)") + b"\0" * 10_000_000)
    write("deflated.npz", deflated.getvalue())


def pictures():
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    def png(name, side, depth, color, rows, interlaced=0, more=b""):
        header = struct.pack(">IIBBBBB", side, side, depth, color, 0, 0, interlaced)
        write(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + more
              + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))

    header = struct.pack(">IIBBBBB", 65535, 65535, 1, 0, 0, 0, 0)
    write("picture.png", gzip.compress(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                                       + chunk(b"IDAT", zlib.compress(b"\0"))))
    png("bomb.png", 65535, 1, 0, b"\0" * 1_000_000)
    png("bomb16.png", 65535, 16, 6, b"\0" * 1_000_000)
    png("interlaced.png", 65535, 16, 6, b"\0" * 1_000_000, 1)
    png("short.png", 100, 8, 0, b"\0" * 50)
    text = b"".join(chunk(b"zTXt", b"k\0\0" + zlib.compress(b"a" * 7_000_000, 9)) for _ in range(20))
    png("text.png", 4, 8, 0, b"\0\x10\x80\xff\x7f" * 4, 0, text)

    def jpeg(name, frame, side, bits):
        """Gray and flat: a code of one bit says that a block goes on like the one before it."""
        def segment(kind, content):
            return b"\xff" + bytes([kind]) + struct.pack(">H", len(content) + 2) + content
        code = b"\1" + bytes(15) + b"\0"
        tables = segment(0xDB, b"\0" + b"\1" * 64) + segment(0xC4, b"\0" + code + b"\x10" + code)
        scan = segment(0xDA, bytes([1, 1, 0, 0, 63 if frame == 0xC0 else 0, 0]))
        write(name, b"\xff\xd8" + tables + segment(frame, struct.pack(">BHHBBBB", 8, side, side, 1, 1, 0x11, 0))
              + scan + bytes(bits // 8) + b"\xff\xd9")

    jpeg("bomb.jpg", 0xC0, 65500, 64)
    jpeg("bomb_progressive.jpg", 0xC2, 20000, 64)
    jpeg("short.jpg", 0xC0, 200, 64)
    jpeg("flat.jpg", 0xC2, 800, 100 * 100)


def geopackages():
    tables = """CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INTEGER, organization TEXT,
      organization_coordsys_id INTEGER, definition TEXT);
    CREATE TABLE gpkg_contents(table_name TEXT, data_type TEXT, srs_id INTEGER);
    CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, geometry_type_name TEXT, srs_id INTEGER);
    INSERT INTO gpkg_contents VALUES('t', 'features', -1);
    INSERT INTO gpkg_geometry_columns VALUES('t', 'geom', 'POINT', -1);"""
    endless = "WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c) SELECT n, x'00' AS geom FROM c"

    def make(name, script, rows=0):
        path = os.path.join(folder, name)
        database = sqlite3.connect(path)
        database.executescript(tables + script)
        for k in range(rows):
            geometry = b"GP\0\1" + struct.pack("<i", -1) + b"\1" + struct.pack("<Idd", 1, k, k * k % 7)
            database.execute("INSERT INTO t(geom, name) VALUES(?, ?)", (geometry, "n" * 50))
        database.commit()
        database.close()
        with open(path, "rb") as file:
            return bytearray(file.read())

    table = "CREATE TABLE t(fid INTEGER PRIMARY KEY, geom POINT, name TEXT);"
    whole = make("triggers.gpkg", table + "CREATE TRIGGER a AFTER INSERT ON t BEGIN DELETE FROM t WHERE 0; END;", 500)
    write("cut.gpkg", bytes(whole[: len(whole) // 2]))
    page = whole[:]
    page[3 * 4096 : 3 * 4096 + 200] = noise[:200]
    page[6 * 4096 : 6 * 4096 + 200] = noise[:200]
    write("page.gpkg", bytes(page))
    write("wal.gpkg", bytes(whole))
    write("wal.gpkg-wal", noise)
    make("endless.gpkg", f"CREATE VIEW t AS {endless} WHERE n < 0;")
    make("blob.gpkg", "CREATE VIEW t AS SELECT zeroblob(1000000000) AS geom;")
    numbers = "CREATE TABLE r(n); INSERT INTO r WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c " \
              "LIMIT 500) SELECT n FROM c;"
    make("join.gpkg", f"{numbers} CREATE VIEW t AS SELECT x'00' AS geom FROM r a, r b, r c ORDER BY a.n + b.n;")
    doubled = "".join(f"CREATE VIEW v{k} AS SELECT n, n AS geom FROM v{k - 1} UNION ALL SELECT n, 2 FROM v{k - 1} "
                      "LIMIT 9;" for k in range(1, 20))
    make("views.gpkg", f"{numbers} CREATE VIEW v0 AS SELECT n, n AS geom FROM r; {doubled}"
                       "CREATE VIEW t AS SELECT * FROM v19;")


texts()
tangles()
json()
arrays()
pictures()
geopackages()
