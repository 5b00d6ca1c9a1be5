"""Counts for pictures whose pixels are not those of the view."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lumencut.evaluation.amounts import Amounts, counted
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import EXACT, Truth
from lumencut.reformations.untangling import UntangledRequest

if TYPE_CHECKING:
    from lumencut.pictures.renderer import Renderer
    from lumencut.reformations.reformation import Reformation
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings

COUNTED = ("tissue", "centerline")


def untangled_picture(renderer: Renderer, camera: Camera, settings: Settings) -> Reformation:
    """Return the untangled CPR of a view with the same pixel spacing."""
    return UntangledRequest(camera, pixel_spacing=camera.pixel_spacing, settings=settings).of(renderer)


def own_amounts(picture: Reformation, truth: Truth) -> dict[str, Amounts]:
    """Count the pixels with tissue and the centerline points shown.

    A point is shown if the pixel to which the picture assigns the point shows it within 0.05 mm. No point is
    hidden or outside the picture.
    """
    points = truth.seen.centerline.points
    pixels = picture.pixel_from_world(points)
    known = np.isfinite(pixels).all(axis=1)
    off = np.linalg.norm(picture.world_from_pixel(pixels[known]) - points[known], axis=1)
    return {
        "tissue": {"pixels": picture.value.size, "tissue": counted(~np.isnan(picture.value))},
        "centerline": {
            "points": len(points),
            "visible": counted(off <= EXACT),
            "hidden": 0,
            "without lumen": 0,
            "outside": 0,
        },
    }


def nothing_shown(truth: Truth) -> Shown:
    """Return a view in which nothing is shown."""
    depth = np.full(truth.nearest.depth.shape, np.nan, np.float32)
    vessel = np.full(depth.shape, -1, np.int32)
    position = np.full((*depth.shape, 3), np.nan)
    return Shown(
        depth=depth,
        vessel=vessel,
        position=position,
        turned_depth=depth,
        turned_vessel=vessel,
        slides=np.zeros(depth.shape, bool),
        value=None,
        plain_depth=depth,
        strength=None,
        sheet_gap=None,
    )
