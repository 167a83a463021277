"""Results, which never change once they are made."""
from __future__ import annotations

from typing import Any, ClassVar, Dict, Tuple


class Kept:
    """A copy of one is itself; a pickle has what the slots in `_made_of` hold, of which the class makes it anew."""

    __slots__: Tuple[str, ...] = ()
    _made_of: ClassVar[Tuple[str, ...]]

    def __copy__(self) -> Any:
        return self

    def __deepcopy__(self, memo: Dict[int, Any]) -> Any:
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), tuple(getattr(self, name) for name in self._made_of)
