"""Objects as values: what pickling and copying keep, and how arrays are compared by what they hold."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._found_once import FoundOnce


class KeepsReadOnly:
    """A base whose read-only arrays are read-only again in what is unpickled or copied."""

    __slots__ = ()

    def __getstate__(self) -> tuple[dict[str, Any], list[str]]:
        # What was found in a volume is found again in its copies.
        state = {name: value for name, value in vars(self).items() if not isinstance(value, FoundOnce)}
        arrays = ((name, value) for name, value in state.items() if isinstance(value, np.ndarray))
        return state, [name for name, array in arrays if not array.flags.writeable]

    def __setstate__(self, state: tuple[dict[str, Any], list[str]]) -> None:
        values, locked = state
        for name in locked:
            values[name].flags.writeable = False
        vars(self).update(values)


class Value(KeepsReadOnly):
    """A base of what is equal to another of its class with the same content.

    `_content` gives it as what can be compared and hashed.
    """

    __slots__ = ()

    def _content(self) -> tuple[Any, ...]:
        raise NotImplementedError

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if not isinstance(other, Value) or type(other) is not type(self):
            return NotImplemented
        return self._content() == other._content()

    def __hash__(self) -> int:
        return hash(self._content())


def content_of(array: npt.NDArray[np.float64] | None) -> tuple[tuple[int, ...], bytes] | None:
    """What a finite array holds: equal for equal shapes and numbers, -0.0 and 0.0 among them."""
    return None if array is None else (array.shape, (array + 0.0).tobytes())
