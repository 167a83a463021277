"""Meshes of cells, read by programs that are not ours."""

import re

import numpy as np

from cells_readers_data import equal, program, shoelace


def check_mesh(cells, points, faces, sites):
    """Faces in the order of their sites, their corners the cells' vertices, without a gap between them."""
    points = np.asarray(points)
    assert len(np.unique(points, axis=0)) == len(points), "a position stands twice"
    expected = [(site, piece) for site in cells.faces() for piece in cells.pieces(site)]
    if any(len(piece) > 1 for _, piece in expected):
        check_areas(cells, points, faces, sites)
        return
    assert len(faces) == len(expected), f"{len(faces)} faces"
    edges = set()
    for (site, piece), face in zip(expected, faces):
        ring = np.hstack([piece[0], np.zeros((len(face), 1))])
        equal(points[list(face)].astype(ring.dtype), ring.astype(points.dtype), f"face of site {site}")
        for edge in zip(face, np.roll(face, -1)):
            assert edge not in edges, f"edge {edge} belongs to two faces on the same side"
            edges.add(edge)
    if cells.periodic or cells.outline is not None:
        return
    for a, b in edges:
        assert (b, a) in edges or cells.on_wall(points[a][:2], points[b][:2]), f"the mesh is open at {a}, {b}"


def check_areas(cells, points, faces, sites):
    """Holes are left out: the faces of a site have its area together, and none is clockwise."""
    areas = np.zeros(cells.count)
    for site, face in zip(sites, faces):
        area = shoelace(points[list(face)][:, :2])
        assert area > 0, f"a face of site {site} is clockwise"
        areas[site] += area
    assert np.allclose(areas, cells.areas, rtol=1e-9, atol=1e-15), "areas of the faces"


def sites_of_pieces(cells):
    """The sites of the faces, where no piece has a hole."""
    return [site for site in cells.faces() for _ in cells.pieces(site)]


def python_obj(cells):
    with open("c.obj") as file:
        lines = [line.split() for line in file]
    points = [[float(word) for word in words[1:]] for words in lines if words[0] == "v"]
    faces, sites, site = [], [], None
    for words in lines:
        if words[0] == "g":
            site = int(words[1].removeprefix("site_"))
        elif words[0] == "f":
            faces.append([int(word) - 1 for word in words[1:]])
            sites.append(site)
    assert (site is None) == (cells.outline is None), "groups are for pieces"
    if site is not None and len(faces) == len(sites_of_pieces(cells)):
        equal(sites, sites_of_pieces(cells), "groups")
    check_mesh(cells, points, faces, sites)


def python_ply(cells):
    with open("c.ply", "rb") as file:
        head, data = file.read().split(b"end_header\n", 1)
    count = int(re.search(rb"element vertex (\d+)", head)[1])
    points = np.frombuffer(data, "<f8", 3 * count).reshape(-1, 3)
    at, faces, sites = points.nbytes, [], []
    while at < len(data):
        corners = int.from_bytes(data[at : at + 4], "little")
        record = np.dtype([("corners", "<i4", corners), ("site", "<u4"), ("area", "<f8")])
        face = np.frombuffer(data, record, 1, at + 4)[0]
        assert face["area"] == cells.areas[face["site"]], f"face of site {face['site']}"
        faces.append(face["corners"])
        sites.append(face["site"])
        at += 4 + record.itemsize
    assert at == len(data) and len(faces) == int(re.search(rb"element face (\d+)", head)[1])
    assert sites == sorted(sites) and set(sites) == set(cells.faces())
    check_mesh(cells, points, faces, sites)


def assimp_meshes(cells):
    faces = sum(len(cells.pieces(site)) for site in cells.faces())
    for path in "c.obj", "c.ply":
        # As they are written: which triangles it would draw is its own affair, by version.
        text = program("assimp", "info", path, "--raw")
        if text is None:
            return "assimp"
        found = int(re.search(r"^Faces:\s*(\d+)", text, re.MULTILINE)[1])
        assert found == faces, f"{path}: {found} faces, not {faces}"
    return None


def data_of(cells):
    """What files of VTK say of each site's faces."""
    data = {"site": np.arange(cells.count), "area": cells.areas, "perimeter": cells.perimeters}
    return data | {"neighbors": np.diff(cells.neighbor_offsets), "status": cells.status}


def vtk_meshes(cells):
    try:
        import vtkmodules.util.numpy_support as support
        from vtkmodules.vtkIOGeometry import vtkOBJReader
        from vtkmodules.vtkIOLegacy import vtkPolyDataReader
        from vtkmodules.vtkIOPLY import vtkPLYReader
    except ImportError:
        return "VTK"
    sites = cells.faces()
    for reader, path in (vtkPolyDataReader(), "c.vtk"), (vtkPLYReader(), "c.ply"), (vtkOBJReader(), "c.obj"):
        reader.SetFileName(path)
        if path == "c.vtk":
            reader.ReadAllScalarsOn()
        reader.Update()
        mesh = reader.GetOutput()
        if path == "c.vtk":  # the other two readers make float32 of the positions
            check_vtk(cells, mesh, mesh.GetPolys(), data_of(cells))
        elif cells.outline is None:
            offsets = support.vtk_to_numpy(mesh.GetPolys().GetOffsetsArray())
            equal(np.diff(offsets), np.diff(cells.cell_offsets)[sites], f"corners of faces in {path}")
    return None


def check_vtk(cells, mesh, polygons, data):
    import vtkmodules.util.numpy_support as support

    arrays = mesh.GetCellData()
    of_faces = support.vtk_to_numpy(arrays.GetArray("site"))
    points = support.vtk_to_numpy(mesh.GetPoints().GetData())
    corners = support.vtk_to_numpy(polygons.GetConnectivityArray())
    offsets = support.vtk_to_numpy(polygons.GetOffsetsArray())
    check_mesh(cells, points, np.split(corners, offsets[1:-1]), of_faces)
    for name, values in data.items():
        equal(support.vtk_to_numpy(arrays.GetArray(name)), values[of_faces], name)


def vtk_xml_meshes(cells):
    try:
        import vtkmodules.util.numpy_support as support
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
    except ImportError:
        return "VTK"
    data = data_of(cells) | {"centroid": np.hstack([cells.centroids, np.zeros((cells.count, 1))])}
    if hasattr(cells, "weights"):
        data["weight"] = cells.weights
    for reader, path in (vtkXMLPolyDataReader(), "c.vtp"), (vtkXMLUnstructuredGridReader(), "c.vtu"):
        reader.SetFileName(path)
        reader.Update()
        mesh = reader.GetOutput()
        polygons = mesh.GetPolys() if path == "c.vtp" else mesh.GetCells()
        check_vtk(cells, mesh, polygons, data)
        if path == "c.vtu":
            kinds = support.vtk_to_numpy(mesh.GetCellTypesArray())
            assert (kinds == 7).all(), "cells that are no polygons"
    return None
