"""Single arguments of any kind to what the module of C++ takes; what cannot be is refused by name."""
from __future__ import annotations

import os
from typing import Any, Optional

from ._errors import InputError

#: the largest whole number that counts go up to
MOST = 2**63 - 1


def refuse(argument: str, message: str) -> InputError:
    return InputError(f'{argument}: {message}', 'input', argument)


def path_of(value: Any, argument: str = 'path') -> bytes:
    """As the system has it: a name that is not UTF-8 too, as os.listdir gives it."""
    try:
        path = os.fsencode(value)
    except (TypeError, ValueError):
        raise refuse(argument, f'{value!r} is no path') from None
    if b'\0' in path:
        raise refuse(argument, f'{value!r} has a zero byte, which names of files do not have')
    return path


def number_of(argument: str, value: Any) -> float:
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise refuse(argument, f'{value!r} is no number') from None


def number_or_none(argument: str, value: Any) -> Optional[float]:
    return None if value is None else number_of(argument, value)


def whole_of(argument: str, value: Any, least: int = 0, most: int = MOST,
             what: str = 'is no whole number that is possible here') -> int:
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        whole = int(value)
        if whole != value or not least <= whole <= most:
            raise ValueError
    except (TypeError, ValueError, OverflowError):
        raise refuse(argument, f'{value!r} {what}') from None
    return whole


def seed_of(value: Any) -> int:
    return whole_of('seed', value, 0, 2**64 - 1, 'is no seed, which is from 0 to 2^64 - 1')


def flag_of(argument: str, value: Any) -> bool:
    """Numbers stand for one, texts do not."""
    try:
        if value is not None and not hasattr(value, '__bool__'):
            raise TypeError
        return bool(value)
    except (TypeError, ValueError):
        raise refuse(argument, f'{value!r} is neither True nor False') from None


def text_of(argument: str, value: Any) -> str:
    if not isinstance(value, str):
        raise refuse(argument, f'{value!r} is no text')
    try:
        value.encode()
    except UnicodeEncodeError:
        raise refuse(argument, f'UTF-8 cannot say {value!r}') from None
    return value


def text_or_none(argument: str, value: Any) -> Optional[str]:
    return None if value is None else text_of(argument, value)


def call_of(argument: str, value: Any) -> Any:
    """A function; or None."""
    if value is not None and not callable(value):
        raise refuse(argument, f'{value!r} is no function')
    return value
