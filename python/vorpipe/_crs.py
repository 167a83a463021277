"""Coordinate reference systems, by the names that GeoPandas takes."""
from __future__ import annotations

from typing import Any, Optional, Tuple

from ._scalars import refuse

#: the kind ("degrees", "plane", "unknown"), who gave the code, the code, the definition in WKT
System = Tuple[str, str, int, str]

WGS84 = 4326


def system_of(value: Any) -> Optional[System]:
    """Of "EPSG:4326", its number, WKT, or what has `to_wkt`, as pyproj's CRS; and as GeoDataFrame.crs has it."""
    if value is None:
        return None
    if hasattr(value, 'to_wkt') and hasattr(value, 'is_geographic'):
        return _system_of_pyproj(value)
    crs = _pyproj_crs(value)
    if crs is not None:
        return _system_of_pyproj(crs)
    code = _code_of(value)
    if code is None:
        raise refuse('crs', f'{value!r} is not "EPSG:CODE", and there is no pyproj to read it')
    return ('degrees' if code == WGS84 else 'unknown'), 'EPSG', code, ''


def name_of(system: System) -> Optional[str]:
    """What GeoPandas takes for it; None where nothing says which it is."""
    _, organization, code, definition = system
    if organization and organization != 'NONE' and code > 0:
        return f'{organization}:{code}'
    return definition or None


def _pyproj_crs(value: Any) -> Any:
    try:
        from pyproj import CRS
        from pyproj.exceptions import CRSError
    except ImportError:
        return None
    try:
        return CRS.from_user_input(value)
    except CRSError:
        raise refuse('crs', f'{value!r} is no coordinate reference system') from None


def _system_of_pyproj(crs: Any) -> System:
    kind = 'degrees' if crs.is_geographic else 'plane'
    authority = crs.to_authority()
    organization, code = authority if authority is not None else ('', '')
    if not str(code).isdecimal():
        organization, code = '', 0
    return kind, organization, int(code), crs.to_wkt()


def _code_of(value: Any) -> Optional[int]:
    organization, _, code = str(value).rpartition(':')
    return int(code) if organization.upper() in ('', 'EPSG') and code.isdecimal() else None
