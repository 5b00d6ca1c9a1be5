"""Curvicircular feature aggregation (CFA): the straightened vessel without a need to turn it."""

from __future__ import annotations

import functools
import math
import os
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut._checked_settings import checked
from lumencut._checks import choice, number
from lumencut._files import WRITABLE, checked_path, replace_whole
from lumencut.errors import CameraError, SettingsError
from lumencut.frame import picture_as_png, save_picture
from lumencut.planar_reformation import PlanarReformation, check_vessel, cpr_of
from lumencut.renderer import Renderer
from lumencut.settings import Settings
from lumencut.vessel import Vessel
from lumencut.vessel_tree import VesselTree

FEATURES = ("max", "mean", "min")


class FeatureAggregation:
    """A straightened vessel whose pixels stand for half circles; made by :func:`lumencut.cfa`.

    Attributes
    ----------
    value : numpy.ndarray, float32, shape (H, W)
        The aggregated values, NaN where the whole half circle lies outside the volume. The middle column is
        the vessel itself.
    arc_length : numpy.ndarray, float64, shape (H,)
        Length of the vessel from its first point to each row (mm).
    radius : numpy.ndarray, float64, shape (W,)
        Radius of the circle of each column (mm), negative to the left.
    angles : int
        How many directions a half circle has.
    """

    def __init__(
        self,
        surface: PlanarReformation,
        value: npt.NDArray[np.float32],
        radius: npt.NDArray[np.float64],
        angles: int,
    ) -> None:
        self.value, self.radius, self.angles = value, radius, angles
        self.arc_length = surface.arc_length
        self._surface = surface

    @functools.cached_property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4), made when it is first asked for."""
        return _lumencut.picture(self.value, checked(self._surface.settings))

    def __repr__(self) -> str:
        """Return the size."""
        height, width = self.value.shape
        return f"FeatureAggregation({width} × {height} pixels, {self.angles} angles on each side)"

    def _repr_png_(self) -> bytes:
        """Return the picture as Jupyter shows it."""
        return picture_as_png(self.image)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture, or with the ending ``.npz`` all arrays; errors are those of `Frame.save`."""
        path = checked_path(path, WRITABLE)
        if path.suffix.lower() == ".npz":
            replace_whole(path, self._write_arrays)
        else:
            save_picture(self.image, path)

    def _write_arrays(self, path: Path) -> None:
        names = ("image", "value", "arc_length", "radius")
        with path.open("wb") as file:
            np.savez_compressed(file, **{name: getattr(self, name) for name in names})


def cfa(
    volume: Any,
    vessel: Vessel,
    radius: float = 10.0,
    feature: Literal["max", "mean", "min"] = "max",
    pixel_spacing: float | None = None,
    up: npt.ArrayLike = (0.0, 0.0, 1.0),
    smoothing: float = 0.0,
    settings: Settings | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> FeatureAggregation:
    """Return one straightened picture of all that surrounds a vessel.

    This is our reading of curvicircular feature aggregation (Mistelbauer et al. 2013): a pixel r mm beside
    the vessel shows the largest, mean or smallest value on the half circle of radius r on its side, in the
    section of its row. So whatever lies around the vessel shows without turning it, on the side where it is.

    Parameters
    ----------
    volume, vessel, pixel_spacing, up, smoothing, settings, device
        As for :func:`lumencut.cpr`. A slab of the settings is thick along the circle's tangent.
    radius : float, default 10
        The largest circle (mm).
    feature : {"max", "mean", "min"}, default "max"
        Which value of a half circle is shown. Its samples are no farther apart than a pixel.

    Raises
    ------
    LumencutError
        As :func:`lumencut.cpr`; a ``CameraError`` for a radius that is not above 0, a ``SettingsError`` for
        another feature.
    """
    check_vessel(vessel)
    choice(SettingsError, "feature of the CFA", feature, FEATURES)
    largest = number(CameraError, "radius of the CFA", radius)
    if not (math.isfinite(largest) and largest > 0):
        raise CameraError("radius of the CFA", f"{largest:g} mm", "a radius above 0 mm")
    renderer = Renderer(volume, VesselTree([vessel]), device)
    surface = cpr_of(
        renderer,
        vessel,
        "straightened",
        width=2 * largest,
        pixel_spacing=pixel_spacing,
        up=up,
        smoothing=smoothing,
        settings=settings,
    )
    value, angles = renderer._core.aggregate(
        renderer.volume, surface._core, checked(surface._given), feature, surface.pixel_spacing
    )
    columns = surface.size[0]
    beside = np.arange(-(columns // 2), columns // 2 + 1, dtype=np.float64) * surface.pixel_spacing
    return FeatureAggregation(surface, value, beside, angles)
