"""All vessels of an angiography, without a seed, and the tree of found vessels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import callback, number
from lumencut.errors import SettingsError, TracingError
from lumencut.scene.images import as_volume
from lumencut.scene.polarity import Polarity, traced_volume
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

_Array = npt.NDArray[np.float64]


def find_vessels(
    volume: Volume | Any,
    *,
    smallest_radius: float | None = None,
    polarity: Polarity = "bright",
    progress: Callable[[int, int], object] | None = None,
) -> VesselTree:
    """Find all vessels of an angiography, with no point given.

    Tubes brighter (or darker) than their surroundings are found at all widths and followed along their
    middle, each with its own levels. Those that are bone, organ or noise are left out or marked as doubtful,
    the others are joined where they meet, and connected vessels form a part. The steps are in
    docs/method/tracing.md.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The scan, such as an angiography. Nothing depends on the unit of its values.
    smallest_radius : float, optional
        Vessels end about where they become narrower than this (mm); default: 1 mm, or 1.3 voxel sides if that
        is less. Vessels less than about two voxels wide are not found.
    polarity : {"bright", "dark"}, default "bright"
        Whether lumen is brighter than the tissue around it, or darker, as in airways and bile ducts.
    progress : callable, optional
        Called at intervals with the work done and the total work.

    Returns
    -------
    VesselTree
        Whole vessels from their roots outwards, with ``radius`` and ``confidence``, points at most 0.5 mm
        apart; the first point of a branch is exactly a point of its parent. :attr:`VesselTree.parts` lists
        which are connected, the most important part first. :attr:`VesselTree.doubtful` has the uncertain
        ones, :attr:`VesselTree.doubts` says why, and :attr:`VesselTree.notes` the level and contrast of the
        vessels. The result is the same for any number of threads.

    Raises
    ------
    TracingError
        If no certain vessel is found; it says how many mm a smaller radius finds.
    SettingsError
        For a smallest radius below 0, or another polarity.
    VolumeError
        For anything that is not a volume.
    KeyboardInterrupt
        After Ctrl-C.
    """
    smallest = checked_radius(smallest_radius)
    callback(TracingError, "progress", progress)
    return found_tree(*_lumencut.find_vessels(traced_volume(as_volume(volume), polarity), smallest, progress))


def checked_radius(smallest_radius: float | None) -> float | None:
    """Return the checked smallest radius of vessels to find (mm)."""
    if smallest_radius is None:
        return None
    smallest = number(SettingsError, "smallest_radius", smallest_radius)
    if not 0 <= smallest < float("inf"):
        raise SettingsError("smallest_radius", f"{smallest:g}", "0 or more (mm)")
    return smallest


def found_tree(
    vessels: list[tuple[_Array, _Array, _Array, str]], parts: list[list[int]], notes: list[str]
) -> VesselTree:
    """Return the tree of the certain vessels; it also stores the doubtful ones, the parts and the notes."""
    made = [
        (Vessel(points, radius, confidence=confidence), doubt)
        for points, radius, confidence, doubt in vessels
    ]
    tree = VesselTree(vessel for vessel, doubt in made if not doubt)
    tree._doubtful = tuple(vessel for vessel, doubt in made if doubt)
    tree._doubts = tuple(doubt for _, doubt in made if doubt)
    tree._parts = tuple(map(tuple, parts))
    tree._notes = tuple(notes)
    return tree
