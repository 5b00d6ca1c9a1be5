"""The images of a view that the measures need."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut.scene.camera import Camera

#: Change of depth (mm) beyond which a surface jumps.
JUMP_MM = 5.0
#: Angle between a view and its turned view (radians).
TURN = math.radians(1.0)


@dataclass(frozen=True, eq=False)
class Shown:
    """The images of one view by one method, each (H, W), or None if the method or scene has none.

    Parameters
    ----------
    depth : numpy.ndarray
        Depth of the shown point (mm); NaN if nothing is shown.
    vessel : numpy.ndarray
        Id of the vessel of the pixel's zone; -1 if nothing is shown.
    position : numpy.ndarray, shape (H, W, 3)
        Shown world point (mm, LPS).
    slides : numpy.ndarray of bool
        Where the surface jumps beyond its motion by that turn, see :func:`slid`.
    value : numpy.ndarray or None
        Value of the volume there; NaN outside.
    turned_depth, turned_vessel : numpy.ndarray
        Depth and vessel after the camera has turned by one degree about its up axis.
    plain_depth : numpy.ndarray or None
        Depth before any filter.
    strength : numpy.ndarray or None
        Strength of the silhouettes, 0 to 1.
    sheet_gap : numpy.ndarray or None
        Arc length between the sheets of a vessel that the pixel blends (mm).
    """

    depth: npt.NDArray[np.floating]
    vessel: npt.NDArray[np.integer]
    position: npt.NDArray[np.float64]
    turned_depth: npt.NDArray[np.floating]
    turned_vessel: npt.NDArray[np.integer]
    slides: npt.NDArray[np.bool_]
    value: npt.NDArray[np.floating] | None = None
    plain_depth: npt.NDArray[np.floating] | None = None
    strength: npt.NDArray[np.floating] | None = None
    sheet_gap: npt.NDArray[np.floating] | None = None


def slid(
    camera: Camera,
    depth: npt.NDArray[np.floating],
    turned_depth: npt.NDArray[np.floating],
    turned_position: npt.NDArray[np.float64],
) -> npt.NDArray[np.bool_]:
    """Return where the depth jumps by more than 5 mm beyond the motion of the surface, (H, W).

    The camera has turned about its up axis. A point that turns with the scene lies on the surface of the view
    before: between the depths of the pixels around its projection there. Surroundings face the viewer in both
    views; their depth changes at most as much as that of a turning point there. Both may be 5 mm off.
    """
    height, width = depth.shape
    column, row, found = camera.project(turned_position.reshape(-1, 3)).T
    inside = np.isfinite(found) & (np.abs(column - (width - 1) / 2) < width / 2)
    inside &= np.abs(row - (height - 1) / 2) < height / 2
    around = np.lib.stride_tricks.sliding_window_view(np.pad(depth, 1, mode="edge"), (3, 3))
    near, far = around.min(axis=(2, 3)), around.max(axis=(2, 3))
    place = np.rint(row[inside]).astype(int), np.rint(column[inside]).astype(int)
    off = np.zeros(found.size, bool)
    # A comparison with NaN, where nothing is shown, is false.
    off[inside] = (found[inside] < near[place] - JUMP_MM) | (found[inside] > far[place] + JUMP_MM)
    aside = np.abs(np.arange(width) - (width - 1) / 2) * camera.pixel_spacing
    change = np.abs(turned_depth.astype(float) - depth)
    slides: npt.NDArray[np.bool_] = off.reshape(depth.shape) & (change > JUMP_MM + aside * math.sin(TURN))
    return slides
