"""Renders a view by a method."""

from __future__ import annotations

import math
from dataclasses import replace

from lumencut.evaluation.methods import Method
from lumencut.evaluation.shown import Shown
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings


def shown_by(method: Method, renderer: Renderer, camera: Camera, settings: Settings) -> Shown:
    """Render all images that the measures need."""
    frame = method.surface(renderer, camera, settings)
    turned = method.surface(renderer, camera.rotated(math.radians(1.0), "up"), settings)
    unfiltered = replace(settings, depth_filter=False)
    plain = method.surface(renderer, camera, unfiltered) if method.is_filtered else frame
    details = method.details(renderer, camera, settings)
    return Shown(
        depth=frame.depth,
        vessel=frame.vessel,
        position=frame.position,
        turned_depth=turned.depth,
        turned_vessel=turned.vessel,
        value=frame.value if frame.has("value") else None,
        plain_depth=plain.depth,
        strength=details.get("strength"),
        sheet_gap=details.get("sheet_gap"),
    )
