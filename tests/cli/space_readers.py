"""Cells in space, read back from all of their files.

Usage: space_readers.py STEM, of which .npz, .csv, .vtu, .obj and .ply are the cells of random sites in the unit cube, which may
repeat along all axes.
"""

import csv
import sys

import numpy as np

stem = sys.argv[1]
cells = np.load(stem + ".npz")
offsets, neighbors = cells["neighbor_offsets"], cells["neighbors"]
rings, corners, vertices = cells["face_vertex_offsets"], cells["face_vertices"], cells["vertices"]
count = len(cells["status"])
#: The sites with a polyhedron; others have none of any other file either.
shown = np.flatnonzero(np.diff(offsets) >= 4)
#: By face, of sites that repeat.
shifts = cells["neighbor_shifts"] if "neighbor_shifts" in cells else np.zeros((len(neighbors), 3), int)
images = np.array([[0, 0, 0]] if "neighbor_shifts" not in cells else list(np.ndindex(3, 3, 3))) % 3
images[images == 2] = -1
weights = cells["weights"] if "weights" in cells else np.zeros(count)


def faces_of(site):
    return [corners[rings[face]:rings[face + 1]] for face in range(offsets[site], offsets[site + 1])]


def volume(points, faces):
    """Of a polyhedron whose faces are counter-clockwise from outside: by the divergence theorem."""
    total = 0.0
    for face in faces:
        a = points[face[0]]
        for b, c in zip(face[1:-1], face[2:]):
            total += np.linalg.det([a, points[b], points[c]]) / 6
    return total


def check_arrays():
    assert offsets[-1] == len(neighbors) == len(cells["face_areas"]) == len(rings) - 1
    assert abs(cells["volumes"].sum() - 1) < 1e-12
    for site in range(count):
        assert abs(volume(vertices, faces_of(site)) - cells["volumes"][site]) < 1e-12, site
        assert cells["face_areas"][offsets[site]:offsets[site + 1]].sum() - cells["areas"][site] < 1e-12
    meeting = np.split(cells["vertex_sites"], cells["vertex_site_offsets"][1:-1])
    for vertex, sites in zip(vertices, meeting):
        powers = ((cells["sites"] + images[:, None, :] - vertex) ** 2).sum(axis=2).min(axis=0) - weights
        around = powers[sites[sites >= 0]]
        assert len(sites) >= 4 and np.ptp(around) < 1e-9
        assert powers.min() > around.min() - 1e-9


def check_csv():
    with open(stem + ".csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["volume"]) for row in rows] == list(cells["volumes"])
    assert [float(row["centroid_z"]) for row in rows] == list(cells["centroids"][:, 2])
    assert [int(n) for row in rows for n in row["neighbors"].split()] == list(neighbors)
    assert [int(row["faces"]) for row in rows] == list(np.diff(offsets))
    if "neighbor_shifts" in cells:
        assert [tuple(map(int, shift.split(":"))) for row in rows for shift in row["neighbor_shifts"].split()] == [
            tuple(shift) for shift in shifts.tolist()]


def check_obj():
    points, objects = [], {}
    with open(stem + ".obj") as file:
        for words in map(str.split, file):
            if words[0] == "v":
                points.append([float(word) for word in words[1:]])
            elif words[0] == "o":
                here = objects.setdefault(int(words[1].removeprefix("cell_")), [])
            elif words[0] == "f":
                here.append([int(word) - 1 for word in words[1:]])
    assert np.array_equal(points, vertices) and list(objects) == list(shown)
    for site, faces in objects.items():
        assert [list(face) for face in faces_of(site)] == faces


def check_ply():
    with open(stem + ".ply", "rb") as file:
        lines = iter(file.readline, b"end_header\n")
        counts = [int(line.split()[2]) for line in lines if line.startswith(b"element")]
        points = np.frombuffer(file.read(24 * counts[0]), "<f8").reshape(-1, 3)
        assert np.array_equal(points, vertices)
        areas = np.zeros(count)
        for _ in range(counts[1]):
            size = np.frombuffer(file.read(4), "<u4")[0]
            ring = np.frombuffer(file.read(4 * size), "<i4")
            site, neighbor = np.frombuffer(file.read(8), "<i4")
            area = np.frombuffer(file.read(8), "<f8")[0]
            face, = (face for face in range(offsets[site], offsets[site + 1])
                     if neighbors[face] == neighbor and np.array_equal(ring, corners[rings[face]:rings[face + 1]]))
            is_image = shifts[face].any()
            assert neighbor < 0 or neighbor > site or is_image
            areas[site] += area
            if neighbor >= 0 and not is_image:
                areas[neighbor] += area
        assert not file.read()
    assert np.allclose(areas, cells["areas"], rtol=1e-9)


def check_vtu():
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    except ImportError:
        print("SKIPPED")
        return
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(stem + ".vtu")
    reader.Update()
    grid = reader.GetOutput()
    assert reader.GetErrorCode() == 0 and grid.GetNumberOfCells() == len(shown)
    assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), vertices)
    for at, site in enumerate(shown):
        cell = grid.GetCell(at)
        assert cell.GetCellType() == 42 and cell.GetNumberOfFaces() == offsets[site + 1] - offsets[site]
        for k, ring in enumerate(faces_of(site)):
            ids = cell.GetFace(k).GetPointIds()
            assert [ids.GetId(i) for i in range(ids.GetNumberOfIds())] == list(ring)
    data = grid.GetCellData()
    assert np.array_equal(vtk_to_numpy(data.GetArray("site")), shown)
    assert np.array_equal(vtk_to_numpy(data.GetArray("volume")), cells["volumes"][shown])
    assert np.array_equal(vtk_to_numpy(data.GetArray("centroid")), cells["centroids"][shown])
    if "weights" in cells:
        assert np.array_equal(vtk_to_numpy(data.GetArray("weight")), weights[shown])
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    found = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))
    # VTK makes tetrahedra of a polyhedron, which merges corners that are close to each other.
    off = np.abs(found / cells["volumes"][shown] - 1)
    assert np.median(off) < 1e-12 and np.quantile(off, 0.98) < 1e-6 and off.max() < 0.05, "VTK's own volumes"


for check in (check_arrays, check_csv, check_obj, check_ply, check_vtu):
    check()
