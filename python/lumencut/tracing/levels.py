"""The level of a pyramid at which vessels between points are traced, and the part of it that is read."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from lumencut.errors import TracingError
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.scene.volume_pyramid import VolumePyramid

#: Room around points for detours of a vessel, in addition to half of their extent (voxels).
_DETOUR_IN_VOXELS = 20.0
#: Room around the line of a coarser level: times its largest radius.
_DETOUR_IN_RADII = 4.0
#: Voxels of the first part, which is traced in less than a second.
_FIRST = 2_000_000
#: Radius of a lumen that is resolved (voxels): that of a 4 mm artery in a CT angiography of 0.5 mm.
_RESOLVED = 4.0
#: Share of the points whose radius may be smaller, as at ends of lines.
_NARROWER = 0.1


def trace_by_levels(
    volume: Volume, lists: Sequence[npt.NDArray[np.float64]], route: Callable[[Volume], VesselTree]
) -> VesselTree:
    """Trace in a volume; in a pyramid from coarse to fine, until every lumen is resolved.

    Parameters
    ----------
    volume : Volume
        The scan.
    lists : sequence of ndarray, shape (n, 3)
        The points of each vessel (mm, LPS).
    route : callable
        Traces the vessels in a part of the scan.

    Raises
    ------
    TracingError
        That of the finest level that fits into the memory.
    """
    places = np.concatenate([*lists, np.empty((0, 3))])
    if not isinstance(volume, VolumePyramid) or not len(places):
        return route(volume)
    margin = float(np.linalg.norm(np.ptp(places, axis=0))) / 2
    tree = None
    for number in range(_first_level(volume, places, margin), -1, -1):
        spacing = float(volume.levels[number].spacing.max())
        part = volume.part(places, margin + _DETOUR_IN_VOXELS * spacing, spacing)
        is_too_large = float(part.spacing.max()) > spacing
        if is_too_large and tree is not None:
            return tree
        try:
            tree = route(part)
        except TracingError:
            # Coarse voxels may hide the lumen.
            if is_too_large or number == 0:
                raise
            continue
        radius = np.concatenate([vessel.radius for vessel in tree])
        if is_too_large or np.quantile(radius, _NARROWER) >= _RESOLVED * spacing:
            return tree
        places = np.concatenate([vessel.points for vessel in tree])
        margin = _DETOUR_IN_RADII * float(radius.max())
    assert tree is not None
    return tree


def _first_level(volume: VolumePyramid, places: npt.NDArray[np.float64], margin: float) -> int:
    """Return the finest level at which the part around some places is traced quickly; else the coarsest."""
    for number, level in enumerate(volume.levels):
        extent = np.ptp(places, axis=0) + 2 * margin
        if np.prod(extent / level.spacing + 2 * _DETOUR_IN_VOXELS) <= _FIRST:
            return number
    return len(volume.levels) - 1
