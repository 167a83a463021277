"""scipy.spatial's Voronoi and Delaunay of points in the plane, computed by vorpipe.

    from vorpipe.compat import Delaunay, Voronoi

The classes have the attributes and methods of scipy's, with the same meaning; arrays are in an order of their own,
and points on a common circle are triangulated in another, as valid way. Not taken: points of other than two
dimensions, furthest_site=True, and options of Qhull other than its defaults. scipy is not needed.
"""
from ._delaunay import Delaunay
from ._points import QhullError
from ._voronoi import Voronoi

__all__ = ['Delaunay', 'QhullError', 'Voronoi']
