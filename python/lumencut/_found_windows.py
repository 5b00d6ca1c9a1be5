"""The windows that were found in a volume, kept with it so that each is found once."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

#: Of how many trees windows are kept, and how many voxels tell whether the voxels were exchanged.
_MOST, _LOOKED_AT = 32, 32768

#: Level and width.
_LevelWidth = tuple[float, float]


class FoundWindows:
    """The windows of one volume, by what was asked for and by the vessels: the same objects in order.

    The tree of each window is kept, so that no other vessels take its place in memory. Voxels may be written
    to by whoever holds their array: where evenly spread ones have changed, all windows are found anew.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._looked_at = b""
        self._found: dict[tuple[Any, ...], tuple[_LevelWidth, Any]] = {}

    def __reduce__(self) -> tuple[type[FoundWindows], tuple[()]]:
        """Begin anew in copies of the volume."""
        return FoundWindows, ()

    def __len__(self) -> int:
        """Return how many windows are kept."""
        return len(self._found)

    def window(
        self, voxels: npt.NDArray[Any], name: str, tree: Any, find: Callable[[], _LevelWidth]
    ) -> _LevelWidth:
        """Return the window of this name along the vessels of a tree, or of the volume alone.

        Parameters
        ----------
        voxels : numpy.ndarray, shape (n,)
            The voxels of the volume, in the order of memory.
        name : str
            What tells this window from others.
        tree : VesselTree or None
            The vessels along which the window lies.
        find : callable
            Finds level and width; called where they are not known.
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
