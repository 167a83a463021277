"""scipy.spatial's Voronoi and Delaunay of points in the plane, and SphericalVoronoi, computed by vorpipe.

    from vorpipe.compat import Delaunay, SphericalVoronoi, Voronoi

The classes have the attributes and methods of scipy's, with the same meaning; arrays are in an order of their own,
and points on a common circle are triangulated in another, as valid way. Not taken: points of other than two
dimensions, on the sphere three, furthest_site=True, and options of Qhull that ask for another diagram.

scipy is not needed. Where it is, the classes are derived from its own, so that its interpolators take them, and all
else of scipy.spatial is found here under its name, as voronoi_plot_2d and ConvexHull.
"""
from ._delaunay import Delaunay
from ._points import QhullError
from ._scipy import other as __getattr__
from ._spherical import SphericalVoronoi
from ._voronoi import Voronoi

__all__ = ['Delaunay', 'QhullError', 'SphericalVoronoi', 'Voronoi']
