"""Views spread evenly over the sphere."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut.scene.camera import Camera, upright

if TYPE_CHECKING:
    from lumencut.scene.vessel_tree import VesselTree

_GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))


def directions(count: int) -> npt.NDArray[np.float64]:
    """Return evenly spread unit vectors on a Fibonacci lattice, shape (count, 3); deterministic."""
    number = np.arange(count)
    z = 1 - (2 * number + 1) / count
    across, angle = np.sqrt(1 - z**2), number * _GOLDEN_ANGLE
    return np.stack([across * np.sin(angle), across * np.cos(angle), z], axis=1)


def cameras(
    tree: VesselTree, count: int, size: tuple[int, int], pixel_spacing: float | None
) -> tuple[Camera, ...]:
    """Return cameras along :func:`directions`, fitted to the tree unless `pixel_spacing` (mm) is given."""
    views = (Camera.fitted(tree, ahead, upright(ahead), size) for ahead in directions(count))
    if pixel_spacing is None:
        return tuple(views)
    return tuple(replace(view, pixel_spacing=pixel_spacing) for view in views)
