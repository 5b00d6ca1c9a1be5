"""Hangings: fixed views in a fixed order with one pixel spacing, so that studies can be compared."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lumencut.scene.camera import VIEWS, Camera

if TYPE_CHECKING:
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

#: Angles of a C-arm for each view of a hanging (degrees): LAO and cranial above 0, RAO and caudal
#: below. The views are in the order of the series.
HANGINGS: dict[str, tuple[tuple[int, int], ...]] = {
    "evar": ((0, 0), (45, 0), (90, 0), (180, 0), (-45, 0), (-90, 0)),
    "carotid": ((0, 0), (45, 0), (90, 0), (-45, 0), (-90, 0)),
    "runoff": ((0, 0), (30, 0), (-30, 0), (180, 0)),
    "coronary": ((-30, -20), (-30, 20), (0, 40), (45, 25), (45, -25), (45, 0), (-30, 0)),
    "head": ((0, 0), (45, 0), (90, 0), (-45, 0), (-90, 0), (0, 90)),
}


def hanging_views(name: str, size: tuple[int, int]) -> list[tuple[str, Camera]]:
    """Return the views of a hanging in their order, with their names in file names.

    The position and the magnification of the cameras are not set yet.

    Parameters
    ----------
    name : str
        One of `HANGINGS`.
    size : (int, int)
        Width and height (pixels).
    """
    ahead, up = map(np.array, VIEWS["anterior"])
    front = Camera(np.zeros(3), ahead, up, size)
    found = []
    for number, (lao, cranial) in enumerate(HANGINGS[name], 1):
        turned = front.rotated(math.radians(lao), (0.0, 0.0, 1.0))
        # The sign is negative because a right-handed turn about the right axis would lower the viewer.
        found.append((f"{number}-{_called(lao, cranial)}", turned.rotated(-math.radians(cranial), "right")))
    return found


def fitted_alike(views: list[Camera], scene: VesselTree | Volume) -> list[Camera]:
    """Return the views centred on the scene, all with the smallest pixel spacing at which every view fits."""
    fitted = [Camera.fitted(scene, view.direction, view.up, view.size) for view in views]
    spacing = max(camera.pixel_spacing for camera in fitted)
    return [replace(camera, pixel_spacing=spacing) for camera in fitted]


def _called(lao: int, cranial: int) -> str:
    parts = ((lao, "lao", "rao"), (cranial, "cra", "cau"))
    words = [f"{above if degrees > 0 else below}{abs(degrees)}" for degrees, above, below in parts if degrees]
    return "-".join(words) or "anterior"
