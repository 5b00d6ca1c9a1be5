"""Centerlines of all branches that one seed reaches."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy.typing as npt

from lumencut import _lumencut
from lumencut._checks import number, numbers
from lumencut.errors import SettingsError, TracingError
from lumencut.vessel_tree import Vessel, VesselTree
from lumencut.volume import Volume
from lumencut.volume_files.memory import as_volume


def trace_from(
    volume: Volume | Any,
    seed: npt.ArrayLike,
    *,
    smallest_radius: float = 1.0,
    progress: Callable[[int, int], object] | None = None,
) -> VesselTree:
    """Trace all branches that one point in the lumen reaches."""
    place = numbers(TracingError, "seed", seed, (3,))
    smallest = number(SettingsError, "smallest_radius", smallest_radius)
    found = _lumencut.trace_from(as_volume(volume), tuple(place.tolist()), smallest, progress)
    return VesselTree(Vessel(points, radius, confidence=confidence) for points, radius, confidence, _ in found)
