"""Results, which never change once they are made."""
from __future__ import annotations

from typing import Any, Dict, Tuple


class Kept:
    """A copy of one is itself; a pickle has what its first slot holds, of which the class makes it anew."""

    __slots__: Tuple[str, ...] = ()

    def __copy__(self) -> Any:
        return self

    def __deepcopy__(self, memo: Dict[int, Any]) -> Any:
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (getattr(self, type(self).__slots__[0]),)
