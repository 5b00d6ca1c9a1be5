"""The images of a view that the measures need, rendered by a method."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from lumencut.evaluation.methods import Method
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings


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
    value: npt.NDArray[np.floating] | None = None
    plain_depth: npt.NDArray[np.floating] | None = None
    strength: npt.NDArray[np.floating] | None = None
    sheet_gap: npt.NDArray[np.floating] | None = None


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
