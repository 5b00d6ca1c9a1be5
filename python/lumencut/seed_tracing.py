"""Centerlines of all branches that one seed reaches."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy.typing as npt

from lumencut import _lumencut
from lumencut._checks import numbers
from lumencut._found_tree import checked_radius, found_tree
from lumencut.errors import TracingError
from lumencut.vessel_tree import VesselTree
from lumencut.volume import Volume
from lumencut.volume_files.memory import as_volume


def trace_from(
    volume: Volume | Any,
    seed: npt.ArrayLike,
    *,
    smallest_radius: float = 1.0,
    progress: Callable[[int, int], object] | None = None,
) -> VesselTree:
    """Trace all branches that one point in the lumen reaches.

    The values around the seed tell what lumen looks like. All voxels with such values that are joined with
    the seed are followed from their farthest ends back, and kept as far as cross-sections of the grey values
    show a tube that goes on: bone, organs and veins that touch the lumen are left out where they begin. What
    is kept is thinned to lines as :func:`lumencut.trace_mask` does, so cycles stay, and the lines are moved
    to the middle of the lumen as those of :func:`lumencut.trace` are. METHOD.md, "Tracing from a seed".

    Parameters
    ----------
    volume : Volume, or whatever else :func:`lumencut.render` takes as one
        The angiography; lumen must be brighter than the tissue around it.
    seed : array_like, shape (3,)
        A point in the lumen (mm, LPS). It need not be central.
    smallest_radius : float, default 1.0
        Branches end about where they are narrower from there on (mm); some go on beyond. Lumen less than
        about two voxels wide is not found.
    progress : callable, optional
        Called now and then with how much is done and how much there is to do.

    Returns
    -------
    VesselTree
        The branches with ``radius`` and ``confidence``, points at most 0.5 mm apart; those that meet share
        their end points to the bit. :attr:`VesselTree.doubtful` has the branches that are not sure, and
        :attr:`VesselTree.doubts` says why.

    Raises
    ------
    TracingError
        For a seed outside the volume or not in lumen, one around which no tube is to be seen, and one whose
        lumen fills too much of the volume: the error says what was found there and what was expected.
    SettingsError
        For a smallest radius below 0.
    VolumeError
        For what is no volume.
    """
    place = numbers(TracingError, "seed", seed, (3,))
    smallest = checked_radius(smallest_radius)
    vessels, _, notes = _lumencut.trace_from(as_volume(volume), tuple(place.tolist()), smallest, progress)
    return found_tree(vessels, None, notes)
