"""Pictures of the globe: the site of each pixel against all sites, shapes against cells, and files as GDAL reads them."""

import json
import re
import shutil
import subprocess

import numpy as np

NO_SITE = 2**32 - 1
RADIUS = 6371.0071809  # of the sphere with the area of WGS 84, in km
MAPS = (["--map", "plate-carree"], ["--map", "equal-earth"], ["--view-from", "-30,65"], ["--view-from", "0,-90"])


def spherical(longitude, latitude):
    x, y = np.radians(longitude), np.radians(latitude)
    return np.stack([np.cos(y) * np.cos(x), np.cos(y) * np.sin(x), np.sin(y)], -1)


def authalic(latitude):
    """Sines of authalic latitudes: Snyder 1987, (3-11), (3-12)."""
    e2 = 0.0066943799901413165
    q = lambda s: (1 - e2) * (s / (1 - e2 * s * s) + np.arctanh(np.sqrt(e2) * s) / np.sqrt(e2))
    return q(np.sin(np.radians(latitude))) / q(1)


def equal_earth(longitude, latitude):
    """Meters: Savric, Patterson and Jenny 2018."""
    a = np.array([1.340264, -0.081106, 0.000893, 0.003796])
    t = np.arcsin(np.sqrt(3) / 2 * authalic(latitude))
    y = a[0] * t + a[1] * t**3 + a[2] * t**7 + a[3] * t**9
    slope = a[0] + 3 * a[1] * t**2 + 7 * a[2] * t**6 + 9 * a[3] * t**8
    x = 2 * np.sqrt(3) * np.radians(longitude) * np.cos(t) / (3 * slope)
    return 1000 * RADIUS * x, 1000 * RADIUS * y


def directions(options, width, height):
    """The directions of the centers of pixels that fill a picture, NaN beside the map."""
    right, up = (2 * np.arange(width) + 1) / width - 1, 1 - (2 * np.arange(height) + 1) / height
    right, up = np.meshgrid(right, up)
    if options[0] == "--view-from":
        longitude, latitude = (float(text) for text in options[1].split(","))
        toward, east = spherical(longitude, latitude), spherical(longitude + 90, 0)
        squared = right**2 + up**2
        toward = toward * np.sqrt(np.where(squared > 1, np.nan, 1 - squared))[..., None]
        return toward + right[..., None] * east + up[..., None] * np.cross(spherical(longitude, latitude), east)
    if options[1] == "plate-carree":
        return spherical(180 * right, 90 * up)
    latitudes = np.linspace(-90, 90, 400001)  # 50 m apart
    widths, ys = equal_earth(180, latitudes)
    latitude = np.interp(up * ys[-1], ys, latitudes)
    longitude = 180 * right * widths.max() / np.interp(latitude, latitudes, widths)
    return spherical(np.where(np.abs(longitude) > 180, np.nan, longitude), latitude)


def vectors_of(sites):
    """Unit vectors, times 1 / cos(r) with weights."""
    vectors = spherical(sites[:, 0], sites[:, 1])
    if sites.shape[1] == 2:
        return vectors
    radius = np.sqrt(np.abs(sites[:, 2])) / RADIUS
    return vectors * np.where(sites[:, 2] < 0, 1 / np.cosh(radius), 1 / np.cos(radius))[:, None]


def inputs():
    """Names and sites."""
    random = np.random.default_rng(49)
    spread = lambda n: np.stack([random.uniform(-180, 180, n), np.degrees(np.arcsin(random.uniform(-1, 1, n)))], -1)
    yield "random", spread(400)
    polar = np.stack([random.uniform(-180, 180, 200), 90 - np.abs(random.normal(0, 3, 200))], -1)
    yield "polar", np.concatenate([polar, spread(10), [[0, 90], [17, -90]]])
    yield "weighted", np.column_stack([spread(300), random.uniform(-1e6, 2.5e6, 300)])
    longitude, latitude = np.meshgrid(np.arange(-175, 180, 10), np.arange(-85, 90, 10))
    yield "lattice", np.stack([longitude.ravel(), latitude.ravel()], -1).astype(float)
    yield "meridians", np.array([[0, 0], [90, 0], [180, 0], [-90, 0]], float)
    yield "two", np.array([[0, 0], [120, 30]], float)
    yield "poles", np.array([[0, 90], [0, -90]], float)
    yield "one", np.array([[10, 20]], float)


def write_sites(sites):
    with open("globe.csv", "w", encoding="utf-8") as file:
        file.write("lon,lat" + ",weight" * (sites.shape[1] - 2) + "\n")
        file.writelines(",".join(repr(float(number)) for number in row) + "\n" for row in sites)


SITES = ["--globe", "--sites", "globe.csv"]


def pixels_have_their_sites(maps):
    for name, sites in inputs():
        write_sites(sites)
        vectors = vectors_of(sites)
        for options in MAPS:
            width, height = (301, 301) if options[0] == "--view-from" else (360, 180)
            maps.render(*SITES, *options, "--size", f"{width}x{height}", "--ids", "p.npy", "--check")
            ids = np.load("p.npy")
            if options[1] == "equal-earth":  # the map is 2.0546 times as wide as high
                empty = (ids == NO_SITE).all(1)
                ids = ids[~empty]
                height = len(ids)
                assert abs(height - width / 2.0546) < 1, f"{name}: the map has {height} rows"
            at = directions(options, width, height)
            beside = np.isnan(at).any(-1)
            assert ((ids == NO_SITE) == beside).mean() > 0.999, f"{name}, {options}: another border"
            both = ~beside & (ids != NO_SITE)
            products = at[both] @ vectors.T
            lack = products.max(1) - products[np.arange(len(products)), ids[both]]
            # Rows of Equal Earth are found between latitudes here.
            slack = 1e-9 if options[1] == "equal-earth" else 1e-14
            assert lack.max() <= slack, f"{name}, {options}: {lack.max()}"
            assert ids[both].max() < len(sites)
    maps.render(*SITES, "--size", "300x200", "--view-from", "100,-40", "--ids", "p.npy")
    ids = np.load("p.npy")
    assert (ids[:, :50] == NO_SITE).all() and (ids[:, 250:] == NO_SITE).all(), "beside the globe"


def middle_is_the_nearest(maps):
    random = np.random.default_rng(7)
    sites = next(sites for name, sites in inputs() if name == "random")
    write_sites(sites)
    for _ in range(8):
        longitude, latitude = random.uniform(-180, 180), random.uniform(-90, 90)
        maps.render(*SITES, f"--view-from={longitude},{latitude}", "--size", "41x41", "--ids", "p.npy")
        nearest = int(np.argmax(vectors_of(sites) @ spherical(longitude, latitude)))
        assert np.load("p.npy")[20, 20] == nearest, f"above {longitude}, {latitude}"


def rings_of(path):
    """By site: the rings of its cell in pixels."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    cells = {}
    for site, data in re.findall(r'<path id="cell-(\d+)"[^>]* d="M([^"]*)Z"', text):
        cells[int(site)] = [np.array(ring.split(), float).reshape(-1, 2) for ring in data.split("ZM")]
    return cells


def area_of(ring):
    x, y = ring.T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def shapes_are_cells(maps):
    """Of Equal Earth the areas are true; on others shapes cover the map, and have the sites of pixels."""
    for name, sites in inputs():
        write_sites(sites)
        maps.run("cells", *SITES, "-o", "c.npz")
        areas = np.load("c.npz")["areas"]
        for options in MAPS:
            maps.render(*SITES, *options, "--size", "1000", "--edges", "--show-sites", "-o", "p.svg", "-o", "p.png", "-o",
                        "p.pdf")
            assert shutil.which("xmllint") is None or not subprocess.run(["xmllint", "--noout", "p.svg"], check=True,
                                                                         capture_output=True).stderr
            cells = {site: sum(area_of(ring) for ring in rings) for site, rings in rings_of("p.svg").items()}
            height, width = maps.read_png("p.png").shape[:2]
            scale = {"plate-carree": width * height}.get(options[1], np.pi * 500**2)
            if options[1] == "equal-earth":
                x, y = equal_earth(180, 0)[0], equal_earth(0, 90)[1]
                scale = np.pi * width * height * (1000 * RADIUS) ** 2 / (x * y)
                found = np.array([cells.get(site, 0) for site in range(len(sites))]) / scale * 4 * np.pi * RADIUS**2
                off = np.abs(found - areas).max() / (4 * np.pi * RADIUS**2)
                assert off < 1e-5, f"{name}: an area is off by {off} of the Earth"
            assert abs(sum(cells.values()) / scale - 1) < 1e-4, f"{name}, {options}: {sum(cells.values()) / scale}"


def shapes_are_pixels(maps):
    """What rsvg makes of shapes is the picture of pixels, but for the map's border, where it clips sharply."""
    if shutil.which("rsvg-convert") is None:
        return
    for name, sites in inputs():
        write_sites(sites)
        for options in MAPS:
            maps.render(*SITES, *options, "--size", "300", "--edges", "--antialias", "4", "--background", "white", "-o", "p.svg",
                        "-o", "p.png", "--ids", "p.npy")
            subprocess.run(["rsvg-convert", "-o", "q.png", "p.svg"], check=True)
            off = np.abs(maps.read_png("p.png") - maps.read_png("q.png")).max(-1) > 40
            inside = np.pad(np.load("p.npy") != NO_SITE, 2)
            height, width = off.shape
            inside = np.min([inside[y : y + height, x : x + width] for y in range(5) for x in range(5)], 0)
            assert off[inside].mean() < 0.002, f"{name}, {options}: {off[inside].mean()} of the pixels differ"


def systems_are_those_of_maps(maps):
    write_sites(next(inputs())[1])
    for options, system, box in (([], 4326, (-180, 90)), (["--map", "equal-earth"], 8857, (-17243959.06, 8392927.6))):
        maps.render(*SITES, *options, "--size", "400", "--ids", "p.tif", "-o", "p.pgw")
        if shutil.which("gdalinfo") is not None:
            said = json.loads(subprocess.run(["gdalinfo", "-json", "p.tif"], check=True, capture_output=True).stdout)
            assert said["stac"]["proj:epsg"] == system if "stac" in said else str(system) in said["coordinateSystem"]["wkt"]
            assert np.allclose(said["geoTransform"][0::3], box, rtol=1e-6), said["geoTransform"]
    said = maps.render(*SITES, "--view-from", "0,0", "--ids", "p.tif", code=2)
    assert "--ids: .tif has coordinates of a map" in said, said
    said = maps.render(*SITES, "--view-from", "0,0", "-o", "p.pgw", code=2)
    assert "-o: .pgw has coordinates of a map" in said, said


def refused(maps):
    write_sites(next(inputs())[1])
    for options, wanted in (
        (["--view", "0,0,0,1"], "--view: xmin 0 is not below xmax 0"),
        (["--fit", "stretch"], "--fit: is for a plane"),
        (["--domain", "-180,-90,180,0"], "--domain: polygon 0 reaches"),
        (["--graticule", "0.01"], "--graticule: 0.01 is not a number of degrees"),
        (["--project", "auto"], "--globe"),
        (["--search", "flann"], "--search: FLANN"),
        (["--map", "mercator"], "--map: \"mercator\" is not plate-carree or equal-earth"),
        (["--map", "equal-earth", "--view-from", "0,0"], "--map: --view-from is a map of its own"),
        (["--view-from", "0,91"], "--view-from: the center 0, 91 is no place"),
        (["--view-from", "12"], "--view-from: \"12\" is not LON,LAT"),
        (["--surface", "free"], "--surface: is for a plane"),
    ):
        said = maps.render(*SITES, *options, "-o", "refused.png", code=2)
        assert wanted in said and said.count("\n") == 1, f"{options}: {said}"
    for option in (["--map", "equal-earth"], ["--view-from", "0,0"], ["--graticule", "30"]):
        said = maps.render("--sites", "globe.csv", *option, "-o", "refused.png", code=2)
        assert f"{option[0]}: is for --globe" in said, said


def same_for_all(maps):
    """The same bytes for any number of threads, again by rerun, and on every backend."""
    write_sites(next(inputs())[1])
    options = [*SITES, "--view-from", "20,40", "--size", "200", "--edges", "--show-sites", "--color", "area", "--legend",
               "--antialias", "2"]
    maps.render(*options, "--threads", "1", "-o", "a.png", "-o", "a.svg", "--stats", "a.json")
    first = {name: open(name, "rb").read() for name in ("a.png", "a.svg")}
    maps.render(*options, "--threads", "3", "-o", "b.png", "-o", "b.svg")
    assert first == {name: open(name.replace("a.", "b."), "rb").read() for name in first}, "threads"
    subprocess.run([maps.vorpipe, "rerun", "a.json", "--quiet"], check=True)
    assert first == {name: open(name, "rb").read() for name in first}, "rerun"
    listed = json.loads(subprocess.run([maps.vorpipe, "devices", "--json"], check=True, capture_output=True).stdout)
    backends = ["cpu", *sorted({device["backend"] for device in listed if device.get("usable", True)} - {"cpu"})]
    for backend in backends[1:]:
        subprocess.run([maps.vorpipe, "render", *options, "--backend", backend, "-o", "b.png", "-o", "b.svg", "--quiet"],
                       check=True)
        assert first == {name: open(name.replace("a.", "b."), "rb").read() for name in first}, backend
    if len(backends) > 1:
        done = subprocess.run([maps.vorpipe, "compare", "--backends", ",".join(backends), *SITES, "--map", "equal-earth", "--size",
                               "200", "--check", "--report", "-"], check=False, capture_output=True, encoding="utf-8")
        assert done.returncode == 0, done.stderr
        assert all(pair["equal"] == 200 * 97 for pair in json.loads(done.stdout)["pairs"]), done.stdout
    maps.render(*SITES, "--ids", "a.npy")
    maps.render(*SITES, "--ids", "b.npy")
    done = subprocess.run([maps.vorpipe, "diff", "a.npy", "b.npy", *SITES], check=False, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    for option, wanted in ((["--globe"], "--sites"), (["--map", "equal-earth"], "--map: is for --globe")):
        done = subprocess.run([maps.vorpipe, "diff", "a.npy", "b.npy", *option], check=False, capture_output=True, encoding="utf-8")
        assert done.returncode == 2 and wanted in done.stderr, done.stderr


def write_outline():
    """What 180 degrees cuts, a square with a hole, and what lies around a pole. Returns whether it has places."""
    box = lambda west, south, east, north: [[west, south], [east, south], [east, north], [west, north], [west, south]]
    polygons = [[box(170, -20, 180, -5)], [box(-180, -20, -170, -5)], [box(10, 10, 40, 35), box(20, 20, 25, 25)[::-1]],
                [box(-180, 70, 180, 90)]]
    with open("outline.geojson", "w", encoding="utf-8") as file:
        json.dump({"type": "MultiPolygon", "coordinates": polygons}, file)

    def inside(longitude, latitude):
        within = lambda west, south, east, north: ((west < longitude) & (longitude < east) & (south < latitude) & (latitude < north))
        islands = (np.abs(longitude) > 170) & (-20 < latitude) & (latitude < -5)
        return islands | (within(10, 10, 40, 35) & ~within(20, 20, 25, 25)) | (latitude > 70)

    return inside


def outlines_are_masks(maps):
    """Pixels have a site inside alone, and that which is nearest; what a picture shows is the outline."""
    inside = write_outline()
    sites = next(inputs())[1]
    write_sites(sites)
    vectors, domain = vectors_of(sites), ["--domain", "outline.geojson", "--repair"]
    x, y = equal_earth(180, 0)[0], equal_earth(0, 90)[1]
    for options in MAPS:
        width, height = (301, 301) if options[0] == "--view-from" else (360, 180) if options[1] == "plate-carree" else (360, 175)
        view = {"plate-carree": [-180, -90, 180, 90], "equal-earth": [-x, -y, x, y]}.get(options[1], [-1, -1, 1, 1])
        maps.render(*SITES, *domain, *options, "--view=" + ",".join(map(str, view)), "--size", f"{width}x{height}", "--ids", "p.npy",
                    "--check")
        ids = np.load("p.npy")
        at = directions(options, width, height)
        shown = ~np.isnan(at).any(-1)
        longitude, latitude = np.degrees(np.arctan2(at[..., 1], at[..., 0])), np.degrees(np.arcsin(np.clip(at[..., 2], -1, 1)))
        near = [inside(longitude + right, latitude + up) for right in (-0.01, 0.01) for up in (-0.01, 0.01)]
        for is_inside, sure in ((True, np.all(near, 0) & shown), (False, ~np.any(near, 0) | ~shown)):
            assert ((ids != NO_SITE)[sure] == is_inside).all(), f"{options}: pixels are not {is_inside}"
            assert sure.any(), f"{options}: no pixel is {is_inside}"
        products = at[ids != NO_SITE] @ vectors.T
        lack = products.max(1) - products[np.arange(len(products)), ids[ids != NO_SITE]]
        assert lack.max() < 1e-9, f"{options}: {lack.max()}"
    maps.render(*SITES, *domain, "--size", "100", "--ids", "p.npy")
    assert np.load("p.npy").shape == (50, 100), "an outline all over the Earth is not on the whole map"
    maps.render(*SITES, "--domain", "10,-20,40,35", "-o", "p.png", "-o", "p.pgw")
    with open("p.pgw", encoding="ascii") as file:
        across, _, _, down, left, top = (float(line) for line in file)
    rows, columns = maps.read_png("p.png").shape[:2]
    box = [left - across / 2, top + down * (rows - 0.5), left + across * (columns - 0.5), top - down / 2]
    # Sides along parallels are great circles of a degree or so, which lie beyond them by a few meters.
    assert np.allclose(box, [10, -20, 40, 35], atol=5e-4), f"the picture shows {box}"


def outlined_shapes_are_cells(maps):
    """Of Equal Earth the areas are true; shapes seen from above are the pixels that have a site."""
    write_outline()
    write_sites(next(inputs())[1])
    domain = ["--domain", "outline.geojson", "--repair"]
    maps.run("cells", *SITES, *domain, "-o", "c.npz")
    areas = np.load("c.npz")["areas"]
    for options in MAPS:
        maps.render(*SITES, *domain, *options, "--size", "1000", "--edges", "--show-sites", "-o", "p.svg", "-o", "p.png", "-o", "p.pgw"
                    if options[0] == "--map" else "p.pdf", "--ids", "p.npy")
        cells = {site: abs(sum(signed(ring) for ring in rings)) for site, rings in rings_of("p.svg").items()}
        pixels = (np.load("p.npy") != NO_SITE).sum()
        # Of the cap's last row of pixels all are inside, or none is.
        assert abs(sum(cells.values()) / pixels - 1) < 0.02, f"{options}: {sum(cells.values())} of {pixels} pixels"
        if options[1] == "equal-earth":
            with open("p.pgw", encoding="ascii") as file:
                sides = [float(line) / 1000 for line in file][:4]
            found = np.array([cells.get(site, 0) for site in range(len(areas))]) * sides[0] * -sides[3]
            assert np.abs(found - areas).max() < 2e-5 * areas.sum(), np.abs(found - areas).max()


def signed(ring):
    x, y = ring.T
    return (np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def graticules_are_meridians_and_parallels(maps):
    """What a graticule changes of a picture are pixels on its lines, and on the border of the map."""
    write_sites(next(inputs())[1])
    for options in MAPS:
        size = ["--size", "300", "--background", "white"]
        maps.render(*SITES, *options, *size, "-o", "p.png")
        maps.render(*SITES, *options, *size, "--graticule", "45", "-o", "q.png", "-o", "q.svg", "-o", "q.pdf")
        changed = (maps.read_png("p.png") != maps.read_png("q.png")).any(-1)
        height, width = changed.shape
        line, fine = np.arange(-180, 181, 45), np.linspace(-1, 1, 4001)
        longitude = np.concatenate([np.repeat(line, len(fine)), np.tile(180 * fine, 5)])
        latitude = np.concatenate([np.tile(90 * fine, len(line)), np.repeat([-90, -45, 0, 45, 90], len(fine))])
        if options[0] == "--view-from":
            above = [float(text) for text in options[1].split(",")]
            toward, east = spherical(*above), spherical(above[0] + 90, 0)
            at = spherical(longitude, latitude)
            at = at[at @ toward > 0]
            turn = np.linspace(0, 2 * np.pi, 4001)
            right = np.concatenate([at @ east, np.cos(turn)])
            up = np.concatenate([at @ np.cross(toward, east), np.sin(turn)])
        else:
            project = equal_earth if options[1] == "equal-earth" else lambda x, y: (x, y)
            right, up = project(longitude, latitude)
            right, up = right / project(180, 0)[0], up / project(0, 90)[1]
        drawn = np.zeros_like(changed)
        row, column = ((1 - up) / 2 * height).astype(int), ((1 + right) / 2 * width).astype(int)
        drawn[row.clip(0, height - 1), column.clip(0, width - 1)] = True
        wider = lambda mask: np.max([np.roll(mask, (down, right), (0, 1)) for down in (-1, 0, 1) for right in (-1, 0, 1)], 0)
        assert not (changed & ~wider(drawn)).any(), f"{options}: {(changed & ~wider(drawn)).sum()} pixels beside lines differ"
        assert not (drawn & ~wider(changed)).any(), f"{options}: {(drawn & ~wider(changed)).sum()} pixels of lines do not differ"
        if shutil.which("rsvg-convert") is not None:
            subprocess.run(["rsvg-convert", "-o", "r.png", "q.svg"], check=True)
            off = np.abs(maps.read_png("q.png") - maps.read_png("r.png")).max(-1) > 60
            assert (off & wider(drawn)).sum() < 0.2 * drawn.sum(), f"{options}: {off.sum()} pixels of the shapes differ"


GLOBE_CHECKS = [outlines_are_masks, outlined_shapes_are_cells, graticules_are_meridians_and_parallels, pixels_have_their_sites, middle_is_the_nearest, shapes_are_cells, shapes_are_pixels, systems_are_those_of_maps,
                refused, same_for_all]

