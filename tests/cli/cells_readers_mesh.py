"""Meshes of cells, read by programs that are not ours."""

import re

import numpy as np

from cells_readers_data import equal, program


def check_mesh(cells, points, faces):
    """Faces in the order of their sites, their corners the cells' vertices, without a gap between them."""
    expected = cells.faces()
    assert len(faces) == len(expected), f"{len(faces)} faces"
    points = np.asarray(points)
    assert len(np.unique(points, axis=0)) == len(points), "a position stands twice"
    edges = set()
    for site, face in zip(expected, faces):
        ring = np.hstack([cells.ring(site), np.zeros((len(face), 1))])
        equal(points[list(face)].astype(ring.dtype), ring.astype(points.dtype), f"face of site {site}")
        for edge in zip(face, np.roll(face, -1)):
            assert edge not in edges, f"edge {edge} belongs to two faces on the same side"
            edges.add(edge)
    for a, b in edges:
        assert (b, a) in edges or cells.on_wall(points[a][:2], points[b][:2]), f"the mesh is open at {a}, {b}"


def python_obj(cells):
    with open("c.obj") as file:
        lines = [line.split() for line in file]
    points = [[float(word) for word in words[1:]] for words in lines if words[0] == "v"]
    check_mesh(cells, points, [[int(word) - 1 for word in words[1:]] for words in lines if words[0] == "f"])


def python_ply(cells):
    with open("c.ply", "rb") as file:
        head, data = file.read().split(b"end_header\n", 1)
    count = int(re.search(rb"element vertex (\d+)", head)[1])
    points = np.frombuffer(data, "<f8", 3 * count).reshape(-1, 3)
    at, faces = points.nbytes, []
    for site in cells.faces():
        corners = int.from_bytes(data[at : at + 4], "little")
        record = np.dtype([("corners", "<i4", corners), ("site", "<u4"), ("area", "<f8")])
        face = np.frombuffer(data, record, 1, at + 4)[0]
        assert face["site"] == site and face["area"] == cells.areas[site], f"face of site {site}"
        faces.append(face["corners"])
        at += 4 + record.itemsize
    assert at == len(data), f"{len(data) - at} bytes too many"
    check_mesh(cells, points, faces)


def assimp_meshes(cells):
    triangles = sum(len(cells.ring(site)) - 2 for site in cells.faces())
    for path in "c.obj", "c.ply":
        text = program("assimp", "info", path)
        if text is None:
            return "assimp"
        found = int(re.search(r"^Faces:\s*(\d+)", text, re.MULTILINE)[1])
        assert found == triangles, f"{path}: {found} triangles, not {triangles}"
    return None


def vtk_meshes(cells):
    try:
        import vtkmodules.util.numpy_support as support
        from vtkmodules.vtkIOGeometry import vtkOBJReader
        from vtkmodules.vtkIOLegacy import vtkPolyDataReader
        from vtkmodules.vtkIOPLY import vtkPLYReader
    except ImportError:
        return "VTK"
    sites, counts = cells.faces(), np.diff(cells.neighbor_offsets)
    data = {"site": np.arange(cells.count), "area": cells.areas, "perimeter": cells.perimeters}
    data |= {"neighbors": counts, "status": cells.status}
    for reader, path in (vtkPolyDataReader(), "c.vtk"), (vtkPLYReader(), "c.ply"), (vtkOBJReader(), "c.obj"):
        reader.SetFileName(path)
        if path == "c.vtk":
            reader.ReadAllScalarsOn()
        reader.Update()
        mesh = reader.GetOutput()
        polygons = mesh.GetPolys()
        corners = support.vtk_to_numpy(polygons.GetConnectivityArray())
        offsets = support.vtk_to_numpy(polygons.GetOffsetsArray())
        equal(np.diff(offsets), np.diff(cells.cell_offsets)[sites], f"corners of faces in {path}")
        if path == "c.vtk":  # the other two readers make float32 of the positions
            check_mesh(cells, support.vtk_to_numpy(mesh.GetPoints().GetData()), np.split(corners, offsets[1:-1]))
            for name, values in data.items():
                equal(support.vtk_to_numpy(mesh.GetCellData().GetArray(name)), values[sites], name)
    return None
