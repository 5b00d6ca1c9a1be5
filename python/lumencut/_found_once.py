"""Cache of values derived from a volume, such as windows and point spreads."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

#: Number of trees with cached values, and of sampled voxels that detect a change of the array.
_MOST, _LOOKED_AT = 32, 32768

_T = TypeVar("_T")


class FoundOnce(Generic[_T]):
    """Cache of values found in one volume, by name and by vessels (the same objects in order).

    The cache keeps each tree, so that no other vessels get its address in memory. Callers may write to the
    voxels: if any of the evenly spread samples changed, all values are found again.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._looked_at = b""
        self._found: dict[tuple[Any, ...], tuple[_T, Any]] = {}

    def __len__(self) -> int:
        """Return the number of cached values."""
        return len(self._found)

    def once(self, voxels: npt.NDArray[Any], name: str, tree: Any, find: Callable[[], _T]) -> _T:
        """Return the value of this name for the vessels of a tree, or for the volume only.

        Parameters
        ----------
        voxels : numpy.ndarray, shape (n,)
            The voxels of the volume, in the order of memory.
        name : str
            Its key.
        tree : VesselTree or None
            The vessels along which it is found.
        find : callable
            Computes it; called if it is not cached.
        """
        key = (name, *map(id, tree or ()))
        with self._lock:
            self._forget_exchanged(voxels)
            if key not in self._found:
                found = find()
                if len(self._found) >= _MOST:
                    del self._found[next(iter(self._found))]
                self._found[key] = (found, tuple(tree or ()))
            return self._found[key][0]

    def _forget_exchanged(self, voxels: npt.NDArray[Any]) -> None:
        looked_at = np.ascontiguousarray(voxels[:: max(1, len(voxels) // _LOOKED_AT)]).tobytes()
        if looked_at != self._looked_at:
            self._looked_at = looked_at
            self._found.clear()
