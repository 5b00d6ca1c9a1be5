"""All vessels of an angiography, without a seed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from lumencut import _lumencut
from lumencut.base.checks import callback
from lumencut.errors import TracingError
from lumencut.scene.images import as_volume
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.tracing.found_tree import checked_radius, found_tree


def find_vessels(
    volume: Volume | Any,
    *,
    smallest_radius: float = 1.0,
    progress: Callable[[int, int], object] | None = None,
) -> VesselTree:
    """Find all vessels of an angiography, with no point given.

    Tubes brighter than their surroundings are found at all widths and followed along their middle,
    each with its own levels. Those that are bone, organ or noise are left out or marked as doubtful,
    the others are joined where they meet, and connected vessels form a part. The steps are in
    docs/method/tracing.md.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography; lumen must be brighter than the tissue around it. Nothing depends on the unit of its
        values.
    smallest_radius : float, default 1.0
        Vessels end about where they become narrower than this (mm). Vessels less than about two voxels wide
        are not found.
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
        If no certain vessel is found.
    SettingsError
        For a smallest radius below 0.
    VolumeError
        For anything that is not a volume.
    KeyboardInterrupt
        After Ctrl-C.
    """
    smallest = checked_radius(smallest_radius)
    callback(TracingError, "progress", progress)
    return found_tree(*_lumencut.find_vessels(as_volume(volume), smallest, progress))
