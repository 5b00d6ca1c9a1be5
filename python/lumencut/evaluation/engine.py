"""What a method shows of a view, and the images that the engine does not hand out yet."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from lumencut.camera import Camera
from lumencut.evaluation.methods import Method
from lumencut.evaluation.shown import Shown
from lumencut.renderer import Renderer
from lumencut.settings import Settings


def shown_by(method: Method, renderer: Renderer, camera: Camera, settings: Settings) -> Shown:
    """Render all images of a view that the measures read."""
    frame = method.surface(renderer, camera, settings)
    turned = method.surface(renderer, camera.rotated(math.radians(1.0), "up"), settings)
    strength, plain = _strength(renderer, camera, settings), None
    if strength is not None:
        plain = method.surface(renderer, camera, replace(settings, depth_filter=False)).depth
    return Shown(
        depth=frame.depth,
        vessel=frame.vessel,
        position=frame.position,
        turned_depth=turned.depth,
        turned_vessel=turned.vessel,
        value=frame.value if frame.has("value") else None,
        plain_depth=plain,
        strength=strength,
        sheet_gap=_sheet_gap(renderer, camera, settings),
    )


def _sheet_gap(_: Renderer, __: Camera, ___: Settings) -> npt.NDArray[np.float32] | None:
    """Arc length between the sheets that each pixel blends (mm), (H, W); the engine does not tell it yet."""
    return None


def _strength(_: Renderer, __: Camera, ___: Settings) -> npt.NDArray[np.float32] | None:
    """Strength of the silhouettes, (H, W); the engine does not hand it out yet."""
    return None
