"""Tracing of all vessels connected to the vessel that contains a seed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import callback, numbers
from lumencut.errors import TracingError
from lumencut.scene.images import as_volume
from lumencut.scene.polarity import Polarity, traced_volume
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.tracing.vessel_finding import checked_radius, found_tree


def trace_from(
    volume: Volume | Any,
    seed: npt.ArrayLike,
    *,
    smallest_radius: float | None = None,
    polarity: Polarity = "bright",
    progress: Callable[[int, int], object] | None = None,
) -> VesselTree:
    """Find all vessels connected to the vessel that contains a point.

    All vessels of the scan are found as :func:`lumencut.find_vessels` does, and the seed chooses among them:
    the part of the vessel nearest to it, at most 1.5 radii or a voxel away. So all seeds in one part give
    bit-identical vessels. Around a seed outside all of them, fainter vessels are searched.
    docs/method/tracing.md describes the method.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The scan, such as an angiography.
    seed : array_like, shape (3,)
        A point in a vessel (mm, LPS). It need not be central.
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
        Whole vessels from the root of the part outwards, with ``radius`` and ``confidence``, points at most
        0.5 mm apart; the first point of a branch is exactly a point of its parent. A ring ends on its
        first point. :attr:`VesselTree.doubtful` has the uncertain vessels of the part,
        :attr:`VesselTree.doubts` says why, and :attr:`VesselTree.notes` the level and contrast of the
        vessels.

    Raises
    ------
    TracingError
        For a seed outside the volume, one in no vessel (the error says how far the nearest one is), and one
        whose part has only uncertain vessels.
    SettingsError
        For a smallest radius below 0, or another polarity.
    VolumeError
        For anything that is not a volume.
    """
    place = numbers(TracingError, "seed", seed, (3,))
    smallest = checked_radius(smallest_radius)
    callback(TracingError, "progress", progress)
    traced = traced_volume(as_volume(volume), polarity)
    return found_tree(*_lumencut.trace_from(traced, tuple(place.tolist()), smallest, progress))
