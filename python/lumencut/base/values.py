"""Base classes of values: pickling, copying, and comparison of arrays by content."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.found_once import FoundOnce


class KeepsReadOnly:
    """A base whose read-only arrays stay read-only after pickling and copying."""

    __slots__ = ()

    def __getstate__(self) -> tuple[dict[str, Any], list[str]]:
        state = {name: value for name, value in vars(self).items() if not isinstance(value, FoundOnce)}
        arrays = ((name, value) for name, value in state.items() if isinstance(value, np.ndarray))
        return state, [name for name, array in arrays if not array.flags.writeable]

    def __setstate__(self, state: tuple[dict[str, Any], list[str]]) -> None:
        values, locked = state
        for name in locked:
            values[name].flags.writeable = False
        vars(self).update(values)


class Value(KeepsReadOnly):
    """A base class; two objects are equal if their class and content are equal.

    Subclasses return their content from `_content` in a comparable and hashable form.
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
    """Return a key of a finite array: arrays of equal shape and numbers have equal keys; -0.0 equals 0.0."""
    return None if array is None else (array.shape, (array + 0.0).tobytes())
