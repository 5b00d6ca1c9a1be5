"""Cache of values derived from a volume, such as windows and point spreads."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

#: Largest number of cached values, and number of voxels compared to detect a change of the volume.
_MOST, _LOOKED_AT = 32, 32768

_T = TypeVar("_T")


class FoundOnce(Generic[_T]):
    """Cache of values computed from one volume, by name and by vessels (the same objects in the same order).

    The cache keeps the vessels alive, so that no new vessel gets the same id. Callers may write to the
    voxels: if any of the evenly spread samples changed, all values are computed again.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._looked_at = b""
        self._found: dict[tuple[Any, ...], tuple[_T, Any]] = {}

    def __len__(self) -> int:
        """Return the number of cached values."""
        return len(self._found)

    def once(self, voxels: npt.NDArray[Any], name: str, tree: Any, find: Callable[[], _T]) -> _T:
        """Return the value with this name for the vessels of a tree, or for the volume only.

        Parameters
        ----------
        voxels : numpy.ndarray, shape (n,)
            The voxels of the volume, in the order of memory.
        name : str
            The name of the value.
        tree : VesselTree or None
            The vessels that the value depends on; None if it depends on the volume only.
        find : callable
            Computes the value if it is not cached.
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
