"""How drags, the wheel and keys change a camera and a window; as in the viewer."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from lumencut.camera import Camera
from lumencut.window import Window

Point = npt.NDArray[np.float64]

#: Relative change of the window per dragged pixel.
_WINDOW_PER_PIXEL = 0.004
_NARROWEST = 1e-3
#: Limits of the pixel spacing when zooming (mm).
_FINEST, _COARSEST = 0.005, 20.0


def turned(camera: Camera, pivot: Point, axis: npt.ArrayLike, angle: float) -> Camera:
    """Return the camera turned about an axis (LPS) through a point (mm, LPS), by an angle (radians)."""
    rotated = camera.rotated(angle, axis)
    before = np.stack([camera.right_axis, camera.up, camera.direction])
    after = np.stack([rotated.right_axis, rotated.up, rotated.direction])
    return replace(rotated, center=pivot + (before @ (camera.center - pivot)) @ after)


def trackballed(camera: Camera, pivot: Point, right: float, down: float) -> Camera:
    """Return the camera after a drag (pixels) on a ball; the height of the view is half a turn."""
    pixels = math.hypot(right, down)
    if pixels == 0:
        return camera
    axis = -right * camera.up - down * camera.right_axis
    return turned(camera, pivot, axis, pixels * math.pi / camera.size[1])


def spun(camera: Camera, pivot: Point, axis: npt.ArrayLike, right: float) -> Camera:
    """Return the camera after a drag to the right (pixels) about an axis (LPS)."""
    return turned(camera, pivot, axis, -right * math.pi / camera.size[1])


def panned(camera: Camera, right: float, down: float) -> Camera:
    """Return the camera after a drag that moved the scene by these pixels."""
    return camera.panned(-right * camera.pixel_spacing, down * camera.pixel_spacing)


def zoomed(camera: Camera, factor: float, column: float, row: float) -> Camera:
    """Return the camera magnified by a factor; the point at this pixel does not move."""
    spacing = min(max(camera.pixel_spacing / factor, _FINEST), _COARSEST)
    away = camera.pixel_spacing - spacing
    width, height = camera.size
    moved = camera.panned((column - (width - 1) / 2) * away, ((height - 1) / 2 - row) * away)
    return replace(moved, pixel_spacing=spacing)


def sampled(camera: Camera, share: float) -> Camera:
    """Return the same view with fewer pixels along each side."""
    width, height = (max(round(side * share), 1) for side in camera.size)
    return replace(camera, size=(width, height), pixel_spacing=camera.pixel_spacing * camera.size[1] / height)


def dragged_window(window: Window, right: float, down: float) -> Window:
    """Return the window after a drag (pixels): to the right it grows wider, upwards the picture brighter."""
    width = max(window.width * math.exp(right * _WINDOW_PER_PIXEL), _NARROWEST)
    return Window(window.level + down * _WINDOW_PER_PIXEL * window.width, width)
