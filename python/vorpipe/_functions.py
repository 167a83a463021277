"""The functions of the package."""
from __future__ import annotations

from typing import Any, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union, Unpack, overload

from . import _arguments, _look, _scalars, _vorpipe
from ._arguments import Floats, PathLike
from ._diagram import Diagram
from ._names import renamed
from ._options import CellsOptions, PictureOptions, RelaxOptions, TransportOptions, taking
from ._picture import Picture
from ._points import Given, dimension_of, generated, given, read_points
from ._relaxed import Relaxed
from ._sessions import Session, taken_of
from ._shared import Device, Progress, backend_for, shared
from ._space import Diagram3, SpaceSites, read_in_space, sites_in_space
from ._transported import Transported

def _session(backend: str, device: Device, threads: Optional[int], points: Given, pixels: int = 0) -> Session:
    return Session._around(shared(backend_for(backend, device, len(points.taken), pixels), device, threads), threads)


@overload
def cells(points: SpaceSites, weights: Any = None,  # type: ignore # of all others than these a Diagram
          domain: Optional[Sequence[float]] = None, *, backend: str = 'auto', device: Device = None,
          threads: Optional[int] = None, **options: Unpack[CellsOptions]) -> Diagram3: ...


@overload
def cells(points: Any, weights: Any = None, domain: Any = None, *, backend: str = 'auto', device: Device = None,
          threads: Optional[int] = None, **options: Unpack[CellsOptions]) -> Diagram: ...


@taking(CellsOptions, 'periodic', 'density')
def cells(points: Any, weights: Any = None, domain: Any = None, *, backend: str = 'auto', device: Device = None,
          threads: Optional[int] = None, **options: Unpack[CellsOptions]) -> Union[Diagram, Diagram3]:
    """The cells of points: Voronoi cells (Thiessen polygons), with weights power (Laguerre) cells, in a domain.

    Args:
        points: array-like of shape (N, 2), N at least 1, finite. Of shape (N, 3) they are points in space, and the
            cells are a `Diagram3` in a box (xmin, ymin, zmin, xmax, ymax, zmax): what is of planes is not for them; an
            array of x, y and weight is cells(a[:, :2], a[:, 2]). So are atoms of ASE and structures of pymatgen, and a
            path of an extended xyz or of LAMMPS: the box is that of their cell, if it is upright. Or a table whose columns have names, as a DataFrame,
            which are known as those of files are; geometries of points, as a GeoDataFrame or a list of shapely's; or
            `Sites`, which `read` made, or a path for it. All other columns are attributes.
        weights: (N,), in squared units of the points: the cell of point i is where |x - p_i|^2 - w_i is least. A
            radius r is the weight r^2.
        domain: (xmin, ymin, xmax, ymax); "hull", the convex hull of the points; or an outline that cells are clipped
            to: a path, a polygon of shapely, a GeoDataFrame or what else has a __geo_interface__, GeoJSON, a ring
            (M, 2), a list of rings (a polygon, then its holes), or of such polygons. Polygons that touch or overlap are
            dissolved. None for the box of the points, grown on every side by 5 % of its longer side.
        periodic: "x", "y" or "xy" (or True): the axes along which the domain repeats itself; it must be named then. In
            space some of "xyz".
        density: (H, W), mass per unit of area, over the domain, row 0 at the top; or the path of a .png or .npy
            file, which a world file (.pgw, .tfw, .wld) or GDAL's .aux.xml beside it may place. Brings `mass` and
            `mass_centroids`.
        backend: "auto", "vulkan", "vulkan-compute", "vulkan-geometry", "opengl" or "cpu". The cells are the same from
            each. "auto" takes "cpu" for up to 100,000 points, beyond that the best.
        device: an index or a part of a name, as `devices` lists them; None for the best.
        threads: of the processor; None for all.
        check: verifies the cells, with nothing of what computes them.
        detail: "measures" (status, owners, areas, centroids, offsets, neighbors), "polygons" (and perimeters, second
            moments, vertices, edge lengths) or "all" (and triangles). What is not wanted costs no time.
        search: how the sites that may cut a cell are found: "grid", "flann" or "flann:K".
        progress: called with a stage's name and the part done, from 0 to 1; returning False stops the run.
        attributes: further columns, N values each, by their names: a dict or a DataFrame. They are kept for files
            and for `Diagram.to_geopandas`.
        project: points and domain are in degrees of longitude and latitude. Cells are those of an
            equal-area plane around (longitude, latitude), or with "auto" around their middle. Positions come back in
            degrees, areas and lengths in (square) kilometers.
        margin: by how much the box or the hull of the points is grown on every side: a length, or "10%" of the longer
            side.
        domain_layer: of a GeoPackage with several that have polygons.
        repair: mends rings of an outline that cross themselves, which are refused otherwise.
        crs: the coordinate reference system of the points, as "EPSG:4326"; that of `Sites` is known.
        density_box: (xmin, ymin, xmax, ymax), where the pixels of the density lie, in the unit of the domain, with
            `project` in kilometers of its plane; beyond it there is nothing.
        surface: "free" where air is around the cells: each ends at a disc around its point, whose squared radius is
            the weight. Arcs are lines, whose neighbor is `Wall.OUTLINE`; `Cell.border` has them. There are no
            triangles; outlines, periods, densities and `check` are not for it yet.
        globe: points are degrees of longitude and latitude, of any turn, and cells are those on the sphere: of the
            whole Earth, or of an outline or a box in degrees. Areas are square kilometers on the ellipsoid, lengths kilometers, weights
            squares of radii in kilometers. Brings `solid_angles`.
        lattice: of points in space, that repeat by three vectors: (3, 3), a row each; ASE's cell or pymatgen's lattice.
            There is no domain then. Brings `neighbor_shifts`, as `periodic` does.

    Ctrl-C stops it, other threads of Python go on meanwhile.

    Raises:
        InputError: an argument is wrong; the message begins with its name.
        DeviceError: no such device here, it failed, or there is not enough memory.
        CheckError: `check` found something. Cancelled: `progress` said stop.

    Warns:
        InputWarning: something was reinterpreted or changed: coordinates look like degrees, an outline was mended.
    """
    in_space = sites_in_space(points)
    if in_space is not None:
        if backend not in ('auto', 'cpu') or device is not None:
            raise _scalars.refuse('device' if device is not None else 'backend',
                                  'cells in space are found on the processor: name "cpu", or none')
        on_cpu = Session._around(shared('cpu', None, threads), threads)
        return on_cpu.cells(SpaceSites(in_space), weights, domain, **options)
    points = given(points)
    return _session(backend, device, threads, points).cells(points, weights, domain, **options)



@taking(PictureOptions, 'size', 'color')
def render(points: Any, weights: Any = None, domain: Any = None, *, backend: str = 'auto', device: Device = None,
           threads: Optional[int] = None, **options: Unpack[PictureOptions]) -> Picture:
    """A picture of the cells, and whose cell each pixel is in.

    Args:
        size: (width, height) in pixels, up to 32768 each, or the longer side, in the shape of the domain or the view;
            None for 1000.
        color: by "site", "area", "neighbors", "weight" or "distinct", so that cells with a common edge differ; by
            "@name", an attribute of the points; by a number or a text for each point, None for what is missing; or the
            path of a photograph, .png or .jpg, over the domain or where a world file beside it says: cells have the
            mean color of its pixels.
        colormap: one of `colormaps()`, or a list of colors, as ["#003366", "white"]; None for "viridis", for texts
            and distinct cells for colors that color-blind people tell apart.
        edges: darkens pixels beside which another cell begins.
        show_sites: a dot at each site.
        color_scale: how values become colors: "linear", "log" or "quantile", by rank; None for quantile by area and
            weight, linear by neighbors.
        color_range: (low, high), the values of the first and the last color; else those of all cells.
        legend: draws what the colors stand for: "inside" or True, in the lower left corner, or "beside" the picture
            where it is saved; `Picture.key` says it.
        edge_width: of `edges` and `dual`, 1 to 100 pixels; without `antialias` edges have a whole number of them.
        dot_size: of `show_sites`, 1 to 100 pixels across; None for one by the spacing of the points that show.
        fit: what a domain does in a picture of another aspect: "stretch" fills it, "letterbox" keeps the domain's
            aspect, with NO_SITE beside it. None for "letterbox" of `Sites` from a file, "stretch" of arrays.
        antialias: each pixel has the mean color of as many rows and columns of places, 1 to 8; ids stay those of the
            pixels' centers.
        dual: lines between points whose cells have a common edge in the domain: of the Delaunay triangulation, what
            does not meet beyond; a larger `margin` has more of it, `Diagram.triangles` all.
        labels: the index of each point, "@name", an attribute of it, or a text for each, in its cell where it has
            room.
        label_size: how high digits and capital letters are, 5 to 200 pixels.
        fill: cells have colors; else they are white, or show the background.
        edge_color: of `edges`: "#rgb", "#rrggbb" or a name of CSS, as "white"; None for "#181818".
        background: the color of what is no cell, as "#rrggbbaa" with an opacity; None for transparent.
        view: (xmin, ymin, xmax, ymax), what the picture shows; None for the domain. It changes no color.
        title: above the picture where it is saved, which is higher then.
        legend_title: above the legend, as "rain, mm"; None for what `color` shows.
        globe: as in `cells`; the picture is of a map, which keeps its aspect, and `view` is in its unit.
        map: of the globe: "plate-carree", where x and y are degrees, or "equal-earth", where areas are true.
        view_from: (longitude, latitude) of a place from far above which the globe is seen, in place of a map.
        graticule: degrees between meridians, and between parallels, that are drawn on the globe; 0: none.

    With `project`, the picture is of the plane. All others are as in `cells`; "auto" takes "cpu" for up to 100,000
    points and 4 million pixels.
    """
    points, pixels = given(points), _arguments.most_pixels(_arguments.size_of(options['size']))
    return _session(backend, device, threads, points, pixels).render(points, weights, domain, **options)



@taking(PictureOptions, 'size', 'color')
def draw(points: Any, path: PathLike, weights: Any = None, domain: Any = None, *, backend: str = 'auto',
         device: Device = None, threads: Optional[int] = None, **options: Unpack[PictureOptions]) -> Diagram:
    """Draws the cells as shapes, into a file: .svg or .pdf. Returns the cells, with detail="polygons".

    All arguments are as in `render`; the picture looks the same.
    """
    points = given(points)
    return _session(backend, device, threads, points).draw(points, path, weights, domain, **options)



@taking(RelaxOptions, 'periodic', 'density')
def relax(points: Any, weights: Any = None, domain: Any = None, *, backend: str = 'auto', device: Device = None,
          threads: Optional[int] = None, **options: Unpack[RelaxOptions]) -> Relaxed:
    """Moves points until each is the centroid of its cell: cells become alike, and nearly regular hexagons.

    Args:
        density: as in `cells`: points gather where it is high.
        method: "lbfgs", which comes as far in 30 diagrams as Lloyd's steps in 200; or "lloyd", each point to its
            centroid.
        iterations: the most diagrams after the first.
        tolerance: ends when no point would move by this part of the spacing; 0: never.
        equal_masses: relaxes under the square of the density: then cells come to have equal masses, as stippling
            wants it. Else points are as dense as the square root of the density.
        progress: called with "relax" and the part done; returning False stops it, and what was reached is lost.

    Points stay in the domain; one at the place of another is set beside it. With `globe=True` they move on the sphere,
    all over the Earth. All others are as in `cells`.
    """
    points = given(points)
    return _session(backend, device, threads, points).relax(points, weights, domain, **options)



@taking(TransportOptions)
def transport(points: Any, masses: Any = None, density: Any = None, domain: Any = None, weights: Any = None, *,
              backend: str = 'auto', device: Device = None, threads: Optional[int] = None,
              **options: Unpack[TransportOptions]) -> Transported:
    """The weights that give each cell its mass: semi-discrete optimal transport.

    Args:
        masses: (N,), each more than 0; None for equal ones. They are areas, or what a density has in the cells, and
            add up to what the domain has.
        density: as in `cells`.
        weights: where to begin, if all cells have some mass then; such as those of another transport.
        tolerance: ends when no cell differs from its mass by more than this part of it.
        diagrams: the most that are computed.
        normalize: scales the masses so that they add up to what the domain has.
        surface: "free" where air is around the cells: each ends at a disc around its point, whose squared radius is
            the weight, and masses may add up to less than the domain has.
        fill: a free surface, and this part of what the domain has for all cells together: masses are scaled to it.
        callback: called with each step, as `Transported.trace` has them; returning False ends the transport with what
            was reached.
        progress: called with "transport" and the part done; returning False stops it, and what was reached is lost.
        skip_zero: leaves out points whose mass is 0, which can have no cell, and warns of how many: the arrays of
            `Transported` are as long as there are others.

    `Transported.end` says whether the tolerance was reached. All others are as in `cells`.
    """
    points = given(points)
    return _session(backend, device, threads, points).transport(points, masses, density, domain, weights, **options)



def voronoi_polygons(points: Any, domain: Any = None, *, extend_to: Any = None, only_edges: bool = False,
                     by: Optional[str] = None, **options: Any) -> Any:
    """A GeoDataFrame or GeoSeries of points with their cells in place of the points.

    As the method of GeoPandas of this name, but each row keeps its cell, its label, its other columns and the
    coordinate reference system. A point without a cell has an empty polygon; of a row with several points each has one.
    A row without a geometry stays without one, with a warning.

    Args:
        points: a GeoDataFrame or a GeoSeries.
        domain: what cells are clipped to, as in `cells`: a box, "hull", or an outline, as a GeoDataFrame in the same
            system.
        extend_to: a geometry or a box that the box around the points is to hold as well, where there is no domain.
        only_edges: a GeoSeries of lines instead, each edge of the cells once.
        by: a column of the domain, a GeoDataFrame or a file, that names its features: cells in each feature by itself,
            as `cells --by` of the command line has them. A row is a feature and a point whose cell meets it, with the
            feature's name, and the "share" of it. Features of one name are one.
        options: as in `cells`. Of points in degrees project="auto" makes cells in an equal-area plane; without it
            degrees are taken as a plane, with a warning.
    """
    from ._shapes import each_row, extended_box, with_cells, with_pieces
    if not (hasattr(points, 'geometry') and hasattr(points, 'index') and hasattr(points, 'crs')):
        raise _scalars.refuse('points', f'a {type(points).__name__} is neither a GeoDataFrame nor a GeoSeries')
    if by is not None:
        if extend_to is not None or only_edges:
            raise _scalars.refuse('by', 'is for polygons in features of a domain')
        return with_pieces(points, domain, _scalars.text_of('by', by), options)
    if extend_to is not None and domain is not None:
        raise _scalars.refuse('extend_to', 'is for a box around the points, and a domain is given')

    def made(points: Any, options: Any) -> Any:
        box = domain if extend_to is None else extended_box(given(points), extend_to)
        return with_cells(points, cells(points, domain=box, detail='polygons', **options), only_edges)

    return each_row(points, made, options, only_edges)


def drawn_points(density: Any, n: int, domain: Optional[Sequence[float]] = None, seed: int = 1,
                 density_box: Optional[Sequence[float]] = None) -> Floats:
    """n points drawn from a density, (n, 2): as many to a part of the domain as it has of the mass.

    Without a domain that is the box of the density's pixels: where a world file or `density_box` has them, else
    (0, 0, W, H). Those of the command line's --sites density:N.
    """
    given = _arguments.density_of(density, density_box)
    if given is None:
        raise _scalars.refuse('density', 'there is none')
    values, place, _, _ = given
    box = _arguments.box_of(domain) or place or (0.0, 0.0, float(values.shape[1]), float(values.shape[0]))
    return _vorpipe.drawn_points(given, box, _scalars.whole_of('n', n), _scalars.seed_of(seed))


def check(result: Union[Diagram, Picture], threads: Optional[int] = None) -> List[str]:
    """Verifies what is promised about a result, with nothing of what computes it.

    Returns a line for each promise that is broken; none is as it should be.
    """
    if not isinstance(result, (Diagram, Picture)):
        raise _scalars.refuse('result', f'a {type(result).__name__} is neither a Diagram nor a Picture')
    return result.check(threads)


@overload
def compare(a: Diagram, b: Diagram) -> _vorpipe.CellsDiff: ...


@overload
def compare(a: Diagram3, b: Diagram3) -> _vorpipe.SpaceDiff: ...


@overload
def compare(a: Picture, b: Picture) -> _vorpipe.IdDiff: ...


def compare(a: Union[Diagram, Diagram3, Picture],
            b: Union[Diagram, Diagram3, Picture]) -> Union[_vorpipe.CellsDiff, _vorpipe.SpaceDiff, _vorpipe.IdDiff]:
    """How two diagrams, or two pictures, of the same points differ; `agree` is True where rounding explains it.

    Of diagrams: the status and owner of each site, its neighbors, and its area or volume. Of pictures: the site of each
    pixel.
    """
    if isinstance(a, Diagram) and isinstance(b, Diagram):
        return _vorpipe.diff_cells(a._cells, b._cells)
    if isinstance(a, Diagram3) and isinstance(b, Diagram3):
        return _vorpipe.diff_space(a._cells, b._cells)
    if isinstance(a, Picture) and isinstance(b, Picture):
        return _vorpipe.diff_pictures(a._picture, b._picture)
    raise _scalars.refuse('b', f'a {type(b).__name__} cannot be compared with a {type(a).__name__}')


@renamed(disabled='disable', limits='limit')
def devices(*, disable: Sequence[str] = (), limit: Optional[Mapping[str, int]] = None) -> List[_vorpipe.DeviceInfo]:
    """Every backend with its devices, usable or not; with `reason` where not."""
    return _vorpipe.devices(_arguments.mask_of(disable, limit))


@renamed(disabled='disable', limits='limit')
def selftest(backend: Optional[str] = None, device: Device = None, quick: bool = False, seed: int = 1,
             threads: Optional[int] = None, *, disable: Sequence[str] = (), limit: Optional[Mapping[str, int]] = None,
             progress: Optional[Progress] = None) -> _vorpipe.SelftestReport:
    """Runs scenes of its own on each backend and device, and compares what they answer with the processor."""
    return _vorpipe.selftest(_scalars.text_or_none('backend', backend) or '', '' if device is None else str(device),
                             _scalars.flag_of('quick', quick), _scalars.seed_of(seed), _arguments.threads_of(threads),
                             _arguments.mask_of(disable, limit), _scalars.call_of('progress', progress))


class Forecast(NamedTuple):
    """How much memory a run takes, told before it begins."""

    bytes: int  #: at the peak
    parts: List[Tuple[str, int]]  #: what they are, the largest first
    available: int  #: how many bytes there are
    limited_by: str  #: what sets that

    @property
    def fits(self) -> bool:
        return self.bytes <= self.available


@taking(PictureOptions, 'periodic', 'density')
def forecast(points: Any, weights: Any = None, domain: Any = None, *, density: Any = None, detail: str = 'all',
             picture: bool = False, backend: str = 'auto', device: Device = None, threads: Optional[int] = None,
             **options: Unpack[PictureOptions]) -> Forecast:
    """How much memory `cells` takes with these arguments, or with `picture=True` `render`; Python's own not counted."""
    points, pixels = given(points), _arguments.most_pixels(_arguments.size_of(options['size']))
    session = _session(backend, device, threads, points, pixels)._session
    _, taken = taken_of(points, weights, domain, {**options, 'density': None if picture else density})
    count, flag = _arguments.threads_of(threads), _scalars.flag_of('check', options['check'])
    if picture:
        return Forecast(*_vorpipe.forecast_picture(session, taken, _look.look_of(len(taken), options), flag, count))
    return Forecast(*_vorpipe.forecast_cells(session, taken, _arguments.detail_of(detail), flag, count))


def generate(pattern: str, n: int, seed: int = 1, domain: Optional[Sequence[float]] = None, *,
             dim: Optional[int] = None) -> Floats:
    """About n points all over the domain, (n, 2): "random", "square", "hex", "jitter", "clusters" or "circle".

    In space, (n, 3): "random", "jitter" and "clusters" with `dim=3`, or "sphere", "cubic", "bcc", "fcc", "hcp",
    "diamond" or "a15". `domain` is (xmin, ymin, xmax, ymax), in space six numbers, None for the unit square or cube.
    The same seed gives the same points on every platform, and those of the command line.
    """
    spec = f'{_scalars.text_of("pattern", pattern)}:{_scalars.whole_of("n", n)}'
    in_space = _vorpipe.is_of_space(spec) or (domain is not None and len(domain) == 6)
    if dimension_of(dim, 3 if in_space else 2) == 3:
        return read_in_space(spec, [], '', False, seed, domain).points
    return generated(pattern, n, seed, domain)


def random_weights(low: float, high: float, n: int, seed: int = 1) -> Floats:
    """n weights, evenly distributed; those of the command line's --random-weights."""
    return _vorpipe.random_weights(_scalars.number_of('low', low), _scalars.number_of('high', high),
                                   _scalars.whole_of('n', n), _scalars.seed_of(seed))


def read_sites(path: PathLike) -> Tuple[Floats, Optional[Floats]]:
    """The points (N, 2) of a file, and their weights (N,); None where it has none. `read` has more of it."""
    table = read_points(path)
    return table.points, table.weights


def read_weights(path: PathLike, n: int) -> Floats:
    """The weights (n,) of a .txt, .csv or .npy file."""
    return _vorpipe.read_weights(_scalars.path_of(path), _scalars.whole_of('n', n))


def backends() -> List[str]:
    """The names that `backend` takes."""
    return _vorpipe.backend_names()


def colormaps() -> List[str]:
    """The names that `colormap` takes."""
    return _vorpipe.colormaps()

