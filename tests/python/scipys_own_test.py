"""scipy's own tests of Delaunay, Voronoi and SphericalVoronoi, run with vorpipe.compat's in their place.

Left out is what does not apply, with the reason.
"""
import types

import pytest

from vorpipe import compat

theirs = pytest.importorskip('scipy.spatial.tests.test_qhull', reason='there is no scipy with its tests')
theirs_on_spheres = pytest.importorskip('scipy.spatial.tests.test_spherical_voronoi')

OTHER_DIMENSIONS = 'it is of points that are not in the plane'
ORDER = 'it expects the order that Qhull happens to answer in; compat_test.py has the like of it'
NOT_TAKEN = 'it is of options that vorpipe.compat refuses, or of points that QJ moves'
OTHER_CLASSES = 'it is of classes that vorpipe.compat does not have'
GONE = 'it is of an attribute that scipy has taken away since, and its test with it'

LEFT_OUT = {
    'TestUtilities': {
        'test_find_simplex': ORDER,
        'test_convex_hull': ORDER,
        'test_volume_area': OTHER_CLASSES,
        'test_random_volume_area': OTHER_CLASSES,
        'test_incremental_volume_area_random_input': OTHER_CLASSES,
        'test_more_barycentric_transforms': OTHER_DIMENSIONS,
    },
    'TestDelaunay': {
        'test_nd_simplex': OTHER_DIMENSIONS,
        'test_2d_square': ORDER,
        'test_joggle': NOT_TAKEN,
        'test_furthest_site': NOT_TAKEN,
        'test_vertices_deprecation': GONE,
    },
    'TestVoronoi': {
        'test_simple': ORDER,
        'test_furthest_site': NOT_TAKEN,
        'test_furthest_site_flag': NOT_TAKEN,
    },
    'TestVertexNeighborVertices': {},
    'TestSphericalVoronoi': {
        'test_sort_vertices_of_regions_flattened': ORDER,
        'test_sort_vertices_of_regions_dimensionality': OTHER_DIMENSIONS,
        'test_area_unsupported_dimension': OTHER_DIMENSIONS,
    },
}


@pytest.fixture(autouse=True)
def ours(monkeypatch):
    """Their module's names for the classes are ours while a test runs."""
    replaced = types.SimpleNamespace(**vars(theirs.qhull))
    replaced.Delaunay, replaced.Voronoi = compat.Delaunay, compat.Voronoi
    monkeypatch.setattr(theirs, 'qhull', replaced)
    monkeypatch.setattr(theirs, 'Voronoi', compat.Voronoi)
    monkeypatch.setattr(theirs_on_spheres, 'SphericalVoronoi', compat.SphericalVoronoi)


def applies(name):
    """Whether a data set of theirs is in the plane, and asks for nothing that is refused."""
    if name in theirs.DATASETS:
        return theirs.DATASETS[name].shape[1] == 2
    chunks, options = theirs.INCREMENTAL_DATASETS[name]
    return chunks[0].shape[1] == 2 and options is None


def adopted(group):
    """Their class with the tests that apply, each with the parameters that apply."""
    tests = {}
    for name, test in vars(group).items():
        if not name.startswith('test_') or name in LEFT_OUT[group.__name__]:
            tests[name] = None if name.startswith('test_') else test
            continue
        copy = types.FunctionType(test.__code__, test.__globals__, name, test.__defaults__, test.__closure__)
        copy.pytestmark = [chosen(mark) for mark in getattr(test, 'pytestmark', [])]
        tests[name] = copy
    return type(group.__name__, (), {name: test for name, test in tests.items()
                                     if test is not None and name not in ('__dict__', '__weakref__')})


def chosen(mark):
    if mark.name != 'parametrize':
        return mark
    names, values = mark.args
    if names == 'name':
        values = [value for value in values if applies(value)]
    elif names == 'ndim':
        values = [2]
    elif names == 'dim':
        values = [3]
    elif names == 'poly':
        values = [name for name in values if theirs_on_spheres._generate_polytope(name).shape[1] == 3]
    return pytest.mark.parametrize(names, values).mark


def test_what_is_left_out_is_there():
    for group, names in LEFT_OUT.items():
        module = theirs if hasattr(theirs, group) else theirs_on_spheres
        assert all(hasattr(getattr(module, group), name) for name, why in names.items() if why != GONE)


TestUtilities = adopted(theirs.TestUtilities)
TestVertexNeighborVertices = adopted(theirs.TestVertexNeighborVertices)
TestDelaunay = adopted(theirs.TestDelaunay)
TestVoronoi = adopted(theirs.TestVoronoi)
TestSphericalVoronoi = adopted(theirs_on_spheres.TestSphericalVoronoi)
