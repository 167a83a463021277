"""What `cells` promises, from every backend."""
import numpy as np
import pytest

import vorpipe
from vorpipe import Status, Wall

UNIT = (0, 0, 1, 1)


def shoelace(polygon):
    x, y = polygon.T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def test_two_points_share_the_domain_in_halves():
    diagram = vorpipe.cells([[0.25, 0.5], [0.75, 0.5]], domain=UNIT)
    assert diagram.areas.tolist() == [0.5, 0.5]
    assert diagram.neighbor_pairs().tolist() == [[0, 1]]
    assert set(diagram[0].neighbors) == {1, Wall.XMIN, Wall.YMIN, Wall.YMAX}


def test_cells_tile_the_domain_on_every_backend(backend, random):
    points = random.random((2000, 2))
    with vorpipe.Session(backend, validate=True) as session:
        diagram = session.cells(points, domain=UNIT, check=True)
    assert diagram.report.backend == backend
    assert diagram.report.validation_messages == []
    assert diagram.area_sum() == pytest.approx(1, abs=1e-12)
    assert vorpipe.compare(diagram, vorpipe.cells(points, domain=UNIT, backend='cpu')).agree


def test_without_a_domain_it_is_the_box_of_the_points_with_a_margin():
    diagram = vorpipe.cells([[0, 0], [2, 1]])
    assert np.allclose(diagram.domain, (-0.1, -0.1, 2.1, 1.1), rtol=0, atol=1e-15)


def test_every_cell_is_a_part_of_the_arrays(random):
    diagram = vorpipe.cells(random.random((50, 2)), domain=UNIT)
    assert len(diagram) == 50 and len(list(diagram)) == 50
    for site, (cell, polygon) in enumerate(zip(diagram, diagram.polygons())):
        assert cell.site == site and cell.status is Status.OK and cell.owner == site
        assert np.array_equal(cell.vertices, polygon)
        assert cell.area == pytest.approx(shoelace(polygon), rel=1e-9)
        assert len(cell) == len(cell.neighbors) == len(cell.edge_lengths) == len(polygon)
        sides = np.linalg.norm(polygon - np.roll(polygon, -1, axis=0), axis=1)
        assert np.allclose(cell.edge_lengths, sides)
        assert cell.perimeter == pytest.approx(sides.sum())
        assert [ring.tolist() for ring in cell.rings()] == [polygon.tolist()]
    assert diagram[-1].site == 49
    with pytest.raises(IndexError, match='there is no cell 50'):
        diagram[50]


def test_neighbor_pairs_are_the_edges_of_the_triangulation(random):
    diagram = vorpipe.cells(random.random((300, 2)), domain=(-1e3, -1e3, 1e3, 1e3))
    edges = diagram.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    inside = {tuple(pair) for pair in diagram.neighbor_pairs().tolist()}
    edges = {tuple(edge) for edge in np.sort(edges, axis=1).tolist()}
    # Ridges of points on the hull may begin beyond the domain.
    assert inside <= edges and len(edges - inside) < 10


def test_a_heavy_point_hides_a_light_one():
    diagram = vorpipe.cells([[0.5, 0.5], [0.51, 0.5]], weights=[1, 0], domain=UNIT)
    assert diagram.status.tolist() == [Status.OK, Status.EMPTY]
    assert diagram.areas.tolist() == [1, 0]
    assert diagram.report.hidden == 1
    assert diagram.weights.tolist() == [1, 0]


def test_a_number_added_to_all_weights_changes_nothing(random):
    points, weights = random.random((200, 2)), random.random(200) / 100
    a = vorpipe.cells(points, weights, domain=UNIT, check=True)
    b = vorpipe.cells(points, weights + 1, domain=UNIT, check=True)
    assert np.allclose(a.areas, b.areas)


def test_duplicates_have_an_owner_and_no_cell():
    diagram = vorpipe.cells([[0.2, 0.2], [0.7, 0.7], [0.2, 0.2]], domain=UNIT)
    assert diagram.status.tolist() == [Status.OK, Status.OK, Status.DUPLICATE]
    assert diagram.owners.tolist() == [0, 1, 0]
    with pytest.warns(DeprecationWarning, match='Diagram.owner is owners now'):
        assert diagram.owner.tolist() == [0, 1, 0]
    assert diagram[2].vertices.shape == (0, 2) and diagram.polygons()[2].shape == (0, 2)


@pytest.mark.parametrize('periodic', ['x', 'y', 'xy', True])
def test_a_periodic_domain_has_no_walls_along_its_axes(periodic, random):
    diagram = vorpipe.cells(random.random((100, 2)), domain=UNIT, periodic=periodic, check=True)
    axes = 'xy' if periodic is True else periodic
    walls = {Wall(wall).name[0].lower() for wall in diagram.neighbors[diagram.neighbors < 0].tolist()}
    assert walls == set('xy') - set(axes)
    assert diagram.periodic == axes
    assert diagram.neighbor_shifts.shape == (len(diagram.neighbors), 2)
    assert diagram.area_sum() == pytest.approx(1, abs=1e-12)


def test_one_point_of_a_torus_is_its_own_neighbor():
    diagram = vorpipe.cells([[0.5, 0.5]], domain=UNIT, periodic='xy')
    assert diagram.neighbor_pairs().tolist() == [[0, 0]]
    assert diagram[0].area == 1


def test_the_mass_of_all_cells_is_that_of_the_density(random):
    density = random.random((30, 40))
    diagram = vorpipe.cells(random.random((100, 2)), domain=(0, 0, 4, 3), density=density, check=True)
    assert diagram.mass.sum() == pytest.approx(density.mean() * 12)
    assert diagram.mass_centroids.shape == (100, 2)
    assert diagram[3].mass == diagram.mass[3]


def test_a_density_lies_where_its_box_says(random, tmp_path):
    points, density = random.random((100, 2)) * (4, 2), random.random((2, 4))
    with pytest.warns(vorpipe.InputWarning, match='cover 50 % of the domain'):
        half = vorpipe.cells(points, domain=(0, 0, 4, 2), density=density, density_box=(2, 0, 6, 2), check=True)
    assert half.mass.sum() == pytest.approx(density[:, :2].sum())
    np.save(tmp_path / 'a.npy', density)
    with pytest.warns(vorpipe.InputWarning, match='a.npy: its 4 x 2 pixels are stretched .* density_box='):
        vorpipe.cells(points, domain=(0, 0, 2, 2), density=tmp_path / 'a.npy')
    with pytest.warns(vorpipe.InputWarning, match='^density: its 4 x 2 pixels are stretched .* density_box='):
        vorpipe.cells(points, domain=(0, 0, 2, 2), density=density)
    with pytest.raises(vorpipe.InputError, match='^density: its pixels lie in 5,5,6,6, and nothing of the domain'):
        vorpipe.transport(points, domain=(0, 0, 2, 2), density=density, density_box=(5, 5, 6, 6))
    (tmp_path / 'a.wld').write_text('1\n')
    whole = vorpipe.cells(points, domain=(0, 0, 4, 2), density=tmp_path / 'a.npy', density_box=(0, 0, 4, 2))
    assert whole.mass.sum() == pytest.approx(density.sum())
    (tmp_path / 'a.wld').write_text('1\n0\n0\n-1\n1.5\n1.5\n')
    placed = vorpipe.cells(points, domain=(1, 0, 3, 2), density=tmp_path / 'a.npy')
    assert placed.mass.sum() == pytest.approx(density[:, :2].sum())
    drawn = vorpipe.drawn_points(tmp_path / 'a.npy', 50)
    assert drawn.min() >= 0 and drawn[:, 0].min() >= 1 and drawn[:, 0].max() <= 5
    with pytest.raises(vorpipe.InputError, match='^density_box: '):
        vorpipe.cells(points, density_box=(0, 0, 1, 1))
    with pytest.raises(vorpipe.InputError, match='^density: has a place'):
        vorpipe.cells(points, domain=(0, 0, 4, 2), periodic='x', density=density, density_box=(0, 0, 4, 2))


def test_row_0_of_a_density_is_the_top():
    diagram = vorpipe.cells([[0.5, 0.25], [0.5, 0.75]], domain=UNIT, density=[[1], [0]])
    assert diagram.mass.tolist() == [0, 0.5]


RING = [(0, 0), (4, 0), (4, 3), (0, 3)]
HOLE = [(1, 1), (1, 2), (3, 2), (3, 1)]


@pytest.mark.parametrize('outline', [
    np.array(RING), RING + RING[:1], [RING], [[RING]], {'type': 'Polygon', 'coordinates': [RING + RING[:1]]},
    {'type': 'Feature', 'geometry': {'type': 'MultiPolygon', 'coordinates': [[RING]]}}])
def test_an_outline_is_taken_in_many_forms(outline):
    diagram = vorpipe.cells([[1, 1], [3, 1]], domain=outline)
    assert diagram.domain == (0, 0, 4, 3)
    assert diagram.areas.tolist() == [6, 6]


def test_cells_in_an_outline_have_rings_and_holes():
    diagram = vorpipe.cells([[2, 1.5]], domain=[RING, HOLE], check=True)
    assert [len(ring) for ring in diagram[0].rings()] == [4, 4]
    (outer, holes), = diagram[0].polygons()
    assert shoelace(outer) == 12 and [shoelace(hole) for hole in holes] == [-2]
    assert diagram.rings()[0][1].tolist() == diagram[0].rings()[1].tolist()
    with pytest.raises(vorpipe.InputError, match='outline: some cells have several rings'):
        diagram.polygons()


def test_less_detail_takes_less_and_says_what_is_missing():
    diagram = vorpipe.cells([[0.2, 0.2], [0.7, 0.7]], domain=UNIT, detail='measures')
    assert diagram.detail == 'measures' and np.allclose(diagram.areas, [0.405, 0.595])
    for name in ('cell_vertices', 'perimeters', 'edge_lengths', 'second_moments', 'triangles'):
        with pytest.raises(vorpipe.InputError, match=f'detail: {name} takes detail='):
            getattr(diagram, name)


def test_the_same_cells_are_found_by_lists(random):
    points = random.random((500, 2))
    by_lists = vorpipe.cells(points, domain=UNIT, search='flann:20')
    assert vorpipe.compare(by_lists, vorpipe.cells(points, domain=UNIT)).agree


def test_compare_names_the_cells_that_differ():
    a = vorpipe.cells([[0.2, 0.2], [0.7, 0.7]], domain=UNIT)
    b = vorpipe.cells([[0.2, 0.2], [0.7, 0.7]], domain=(0, 0, 2, 1))
    diff = vorpipe.compare(a, b)
    assert not diff.agree and diff.areas == 1 and diff.worst_site == 1
    assert diff.first[0].area_a == a.areas[1] and diff.first[0].area_b == b.areas[1]
    with pytest.raises(vorpipe.InputError, match='b: its points or weights are not those of a'):
        vorpipe.compare(a, vorpipe.cells([[0.2, 0.2], [0.7, 0.8]], domain=UNIT))


def test_check_finds_nothing(random):
    assert vorpipe.check(vorpipe.cells(random.random((100, 2)))) == []


def test_generators_are_those_of_the_command_line():
    points = vorpipe.generate('jitter', 100, seed=7)
    assert points.shape == (100, 2) and 0 <= points.min() and points.max() < 1
    assert np.array_equal(points, vorpipe.generate('jitter', 100, seed=7))
    assert vorpipe.random_weights(1, 2, 10).min() >= 1
    with pytest.raises(vorpipe.InputError, match='spirals'):
        vorpipe.generate('spirals', 10)


def test_points_are_read_from_files(tmp_path):
    (tmp_path / 'sites.csv').write_text('x,y,weight\n1,2,3\n4,5,6\n')
    points, weights = vorpipe.read_sites(tmp_path / 'sites.csv')
    assert points.tolist() == [[1, 2], [4, 5]] and weights.tolist() == [3, 6]
    (tmp_path / 'plain.csv').write_text('x,y\n1,2\n')
    assert vorpipe.read_sites(str(tmp_path / 'plain.csv'))[1] is None


def test_the_forecast_is_told_before():
    told = vorpipe.forecast(vorpipe.generate('random', 10_000))
    assert 0 < told.bytes == sum(size for _, size in told.parts)
    assert told.fits and told.available > told.bytes and told.limited_by
    plain = vorpipe.forecast([[0, 0]], picture=True, size=(4000, 4000)).bytes
    assert plain > 4000 * 4000 * 8
    # The places of a small picture are in memory all at once, those of a large one in parts.
    rough = vorpipe.forecast([[0, 0]], picture=True, size=(500, 500)).bytes
    assert vorpipe.forecast([[0, 0]], picture=True, size=(500, 500), antialias=4).bytes > 4 * rough


@pytest.mark.parametrize('extension', 'csv npz geojson geojsonl gpkg svg obj ply vtk vtp vtu wkt'.split())
def test_cells_are_saved_as_every_kind_of_file(extension, tmp_path):
    path = tmp_path / f'cells.{extension}'
    vorpipe.cells([[0.2, 0.2], [0.7, 0.7]], domain=UNIT).save(path)
    assert path.stat().st_size > 100


def test_arrays_of_npz_files_are_those_of_the_diagram(tmp_path, random):
    points = random.random((100, 2))
    diagram = vorpipe.cells(points, 0.001 * random.random(100), (0, 0, 1, 1), periodic='x', density=np.ones((2, 2)))
    for result in (diagram, vorpipe.cells(points, domain=[(0, 0), (1, 0), (1, 1)])):
        result.save(tmp_path / 'cells.npz')
        with np.load(tmp_path / 'cells.npz') as file:
            for name in file.files:
                array = getattr(result, name)
                # Files have indices without a sign.
                assert np.array_equal(file[name], array) and file[name].dtype in (array.dtype, np.uint32), name


def test_files_take_the_detail_that_they_write(tmp_path):
    diagram = vorpipe.cells([[0, 0], [1, 1]], detail='measures')
    with pytest.raises(vorpipe.InputError, match="detail: .wkt takes cells that were computed with detail='polygons'"):
        diagram.save(tmp_path / 'cells.wkt')
    with pytest.raises(vorpipe.InputError, match='unknown kind of file for cells'):
        diagram.save(tmp_path / 'cells.doc')


@pytest.mark.parametrize('site', range(5))
def test_a_cell_knows_its_second_moments(site, random):
    diagram = vorpipe.cells(random.random((5, 2)), domain=UNIT)
    xx, xy, yy = diagram[site].second_moments
    assert xx > 0 and yy > 0 and xx * yy > xy * xy
