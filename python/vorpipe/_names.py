"""Names that were others before: they serve for a release, with a DeprecationWarning."""
from __future__ import annotations

import functools
import inspect
from typing import Any, Callable, Dict, TypeVar, cast

from ._scalars import refuse
from ._warnings import deprecated

_Function = TypeVar('_Function', bound=Callable[..., Any])


def renamed(**new_names: str) -> Callable[[_Function], _Function]:
    """Lets a function take arguments by the names that they had, as keywords."""

    def decorate(function: _Function) -> _Function:
        signature = inspect.signature(function)

        @functools.wraps(function)
        def call(*arguments: Any, **named: Any) -> Any:
            for old in new_names.keys() & named.keys():
                arguments = _renamed(old, new_names[old], signature, arguments, named)
            return function(*arguments, **named)

        return cast(_Function, call)

    return decorate


def formerly(old: str, new: str) -> property:
    """What a class has by the name that it had."""

    def get(self: Any) -> Any:
        deprecated(f'{type(self).__name__}.{old} is {new} now')
        return getattr(self, new)

    return property(get, doc=f'`{new}`, by the name that it had.')


def _renamed(old: str, new: str, signature: inspect.Signature, arguments: Any, named: Dict[str, Any]) -> Any:
    """The arguments without a name; those with one are changed."""
    value = named.pop(old)
    deprecated(f'{old}= is {new}= now')
    bound = signature.bind_partial(*arguments, **named)
    if value is None:
        return arguments
    if bound.arguments.get(new) is not None:
        if old != 'outline' or isinstance(bound.arguments[new], str):
            raise refuse(old, f'is {new} now, and both are given')
        # The box around an outline was what pictures show.
        if 'view' in signature.parameters and bound.arguments.get('view') is None:
            bound.arguments['view'] = bound.arguments[new]
    bound.arguments[new] = value
    named.clear()
    named.update(bound.arguments.pop('options', {}), **bound.arguments)
    return ()
