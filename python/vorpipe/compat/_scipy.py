"""What scipy's classes are derived from here, where there is scipy: its interpolators ask for instances of them."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    class DelaunayBase: ...
    class VoronoiBase: ...
    class SphericalBase: ...
    class ErrorBase(RuntimeError): ...
else:
    try:
        from scipy.spatial import Delaunay as DelaunayBase
        from scipy.spatial import QhullError as ErrorBase
        from scipy.spatial import SphericalVoronoi as SphericalBase
        from scipy.spatial import Voronoi as VoronoiBase
    except ImportError:
        DelaunayBase = VoronoiBase = SphericalBase = object
        ErrorBase = RuntimeError


def other(name: str) -> Any:
    """Whatever else scipy.spatial has: its plots, ConvexHull, KDTree."""
    if not name.startswith('__'):
        try:
            from scipy import spatial
        except ImportError:
            raise AttributeError(f'vorpipe.compat has no {name}; '
                                 'what it takes from scipy.spatial takes scipy') from None
        if hasattr(spatial, name):
            return getattr(spatial, name)
    raise AttributeError(f'neither vorpipe.compat nor scipy.spatial has {name}')
