"""Files of cells in space beside those of other programs.

Usage: space_file_readers.py lines OURS VOROS: lines of the format in space_files.sh, which Voro++ wrote as well
       space_file_readers.py surfaces STEM: .stl and .npz of the same cells, read by meshio
       space_file_readers.py write FOLDER: files of ASE, and their positions
"""

import sys

import numpy as np


def numbers(text):
    return np.array([float(word) for word in text.replace("(", " ").replace(")", " ").replace(",", " ").split()])


def tuples(text):
    return [numbers(part) for part in text.split()]


def close(a, b, scale=1.0):
    # Voro++ prints six digits.
    return np.shape(a) == np.shape(b) and np.allclose(a, b, rtol=2e-5, atol=2e-5 * scale)


def matched(ours, theirs):
    """For each of their places the nearest of ours, each once."""
    order = [int(np.argmin(np.linalg.norm(ours - place, axis=1))) for place in theirs]
    assert sorted(order) == list(range(len(ours))) and close(ours[order], theirs)
    return order


def check_lines(ours_path, theirs_path):
    def rows(path):
        with open(path) as file:
            return {line.split("|")[0]: line.rstrip("\n").split("|") for line in file}

    ours, theirs = rows(ours_path), rows(theirs_path)
    assert set(ours) == set(theirs) and len(ours) > 250, (len(ours), len(theirs))
    for site, a in ours.items():
        b = theirs[site]
        assert len(a) == len(b) == 23
        names = dict(zip("iqxrwPpomgEseFAaftlnvcC", zip(a, b)))
        for code in "qxrwmgEsFAvcC":
            assert close(numbers(names[code][0]), numbers(names[code][1])), (site, code, names[code])
        corners = matched(*(np.array(tuples(text)) for text in names["P"]))
        at = {code: [tuples(text) for text in names[code]] for code in "pote"}
        assert close(np.array(at["p"][0])[corners], np.array(at["p"][1]))
        assert [int(at["o"][0][k][0]) for k in corners] == [int(order[0]) for order in at["o"][1]]
        faces = [names["n"][0].split().index(neighbor) for neighbor in names["n"][1].split()]
        assert sorted(faces) == list(range(len(faces)))
        for code in "eafl":
            mine, other = (np.array(tuples(text)) for text in names[code])
            assert close(mine[faces], other, 10 if code == "l" else 1), (site, code)
        for k, ring in zip(faces, at["t"][1]):
            mine, other = at["t"][0][k].astype(int).tolist(), [corners[int(v)] for v in ring]
            first = mine.index(other[0])
            assert mine[first:] + mine[:first] == other, (site, k)


def check_surfaces(stem):
    try:
        import meshio
    except ImportError:
        print("SKIPPED")
        return
    mesh, cells = meshio.read(stem + ".stl"), np.load(stem + ".npz")
    corners = mesh.points.astype(float)[mesh.cells_dict["triangle"]]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    sides = np.diff(cells["face_vertex_offsets"])
    assert len(corners) == (sides - 2).sum()
    assert abs(np.linalg.det(corners).sum() / 6 - 1) < 1e-5  # outward, and the cells fill the box
    assert abs(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 / cells["areas"].sum() - 1) < 1e-5


def write(folder):
    try:
        import ase
        import ase.io
    except ImportError:
        print("SKIPPED")
        return
    points = np.random.default_rng(4).random((60, 3)) * (9, 10, 11)
    atoms = ase.Atoms(["Cu", "Zr"] * 30, positions=points.round(6), cell=(9, 10, 11), pbc=True)
    # Periods come with each place once more.
    ase.io.write(folder + "/ase.extxyz", [atoms, atoms], format="extxyz")
    ase.io.write(folder + "/ase.xyz", atoms, format="extxyz")
    ase.io.write(folder + "/ase.data", atoms, format="lammps-data", atom_style="atomic")
    np.savetxt(folder + "/ase.txt", atoms.positions, fmt="%.6f")


{"lines": check_lines, "surfaces": check_surfaces, "write": write}[sys.argv[1]](*sys.argv[2:])
