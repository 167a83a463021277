"""How a picture is to look: colors, labels, and what stands around it."""
from __future__ import annotations

from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import _attributes, _vorpipe
from ._arguments import box_of, options_of, pair_of, range_of, search_of, size_of
from ._options import PictureOptions, usual
from ._scalars import flag_of, refuse, text_of, text_or_none


def colormap_of(value: Union[None, str, Sequence[str]]) -> Tuple[Optional[str], List[str]]:
    """The name of a map, or own colors."""
    if value is None:
        return None, []
    if isinstance(value, str):
        if value not in _vorpipe.colormaps():
            raise refuse('colormap', f'{value!r} is none of {", ".join(_vorpipe.colormaps())}')
        return value, []
    colors = [text_of('colormap', color) for color in value]
    if not 2 <= len(colors) <= 254:
        raise refuse('colormap', f'{len(colors)} colors, must be 2 to 254')
    return None, colors


def legend_of(value: Union[bool, str]) -> Tuple[bool, bool]:
    """Whether there is one, and beside the picture."""
    if isinstance(value, str):
        if value not in ('inside', 'beside'):
            raise refuse('legend', f'{value!r} is neither "inside" nor "beside"')
        return True, value == 'beside'
    return flag_of('legend', value), False


def look_of(count: int, options: Mapping[str, Any]) -> _vorpipe.Look:
    """Of a picture of `count` points, by `PictureOptions`; colors and labels may be a value for each."""
    options = {**usual(PictureOptions), **options}
    method, neighbors = search_of(options['search'])
    name, colors = colormap_of(options['colormap'])
    has_legend, beside = legend_of(options['legend'])
    marks = {name: options[name] for name in _vorpipe.MARKS if name != 'dot_size' or options[name] is not None}
    own: Dict[str, Any] = {}
    named: Dict[str, str] = {}
    for argument in ('color', 'labels'):
        value = options[argument]
        if isinstance(value, str) and value.startswith('@'):
            named[argument] = text_of(argument, value[1:])
        elif hasattr(value, '__len__') and not isinstance(value, str):
            own[argument] = value
    attributes = _attributes.attributes_of(own, count) if own else None
    words = _vorpipe.Words(text_or_none('title', options['title']) or '',
                           text_or_none('legend_title', options['legend_title']) or '',
                           named.get('color', ''), named.get('labels', ''), beside, attributes)
    marks['labels'] = 'labels' in named or 'labels' in own or flag_of('labels', options['labels'])
    by = 'site' if 'color' in named or 'color' in own else text_of('color', options['color'])
    look = _vorpipe.Colors(by, name, colors, text_or_none('color_scale', options['color_scale']),
                           range_of(options['color_range']), has_legend, flag_of('fill', options['fill']))
    return _vorpipe.Look(size_of(options['size']), text_or_none('fit', options['fit']), look, words,
                         options_of(_vorpipe.MARKS, marks), method, neighbors, box_of(options['view'], 'view'),
                         text_or_none('map', options['map']),
                         None if options['view_from'] is None else pair_of('view_from', options['view_from']))
