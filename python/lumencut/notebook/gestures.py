"""How drags, the wheel and keys change a camera and a window; as in the viewer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.scene.camera import Camera
from lumencut.scene.window import Window

Point = npt.NDArray[np.float64]


def trackballed(camera: Camera, pivot: Point, right: float, down: float) -> Camera:
    """Return the camera after a drag (pixels) on a ball; the height of the view is half a turn."""
    return camera._moved(_lumencut.trackballed(camera, pivot, (right, down)))


def spun(camera: Camera, pivot: Point, axis: npt.ArrayLike, right: float) -> Camera:
    """Return the camera after a drag to the right (pixels) about an axis (LPS)."""
    return camera._moved(_lumencut.spun(camera, pivot, axis, right))


def panned(camera: Camera, right: float, down: float) -> Camera:
    """Return the camera after a drag that moved the scene by these pixels."""
    return camera._moved(_lumencut.dragged(camera, (right, down)))


def zoomed(camera: Camera, factor: float, column: float, row: float) -> Camera:
    """Return the camera magnified by a factor; the point at this pixel does not move."""
    return camera._moved(_lumencut.zoomed_at(camera, factor, (column, row)))


def sampled(camera: Camera, share: float) -> Camera:
    """Return the same view with fewer pixels along each side."""
    size, pixel_spacing = _lumencut.sampled(camera, share)
    return replace(camera, size=size, pixel_spacing=pixel_spacing)


def dragged_window(window: Window, right: float, down: float) -> Window:
    """Return the window after a drag (pixels): to the right it grows wider, upwards the picture brighter."""
    return Window(*_lumencut.dragged_window((window.level, window.width), (right, down)))
