"""Curvicircular feature aggregation (CFA): a straightened vessel that shows all sides in one picture."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice
from lumencut.errors import CameraError, SettingsError
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import check_vessel
from lumencut.reformations.planar_reformation import CprRequest, PlanarReformation
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.request import HEAD, ReformationRequest
from lumencut.scene.checked_settings import checked
from lumencut.scene.settings import Settings
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.window import Window

Feature: TypeAlias = Literal["max", "mean", "min", "range", "share"]

FEATURES = ("max", "mean", "min", "range", "share")

_SHOWN = {
    "max": "the largest value",
    "mean": "the mean",
    "min": "the smallest value",
    "range": "by how much the largest value exceeds the smallest",
    "share": "how much lies above {level:g}",
}

_AXES = (
    "Down: along the vessel, in mm. Across: the radius of the half circle on that side, in mm; {shown} on it."
)


class FeatureAggregation(Reformation):
    """A straightened vessel whose pixels stand for half circles; made by :func:`lumencut.cfa`.

    ``value`` holds the aggregated values, NaN if the whole half circle lies outside the volume; its middle
    column is the vessel itself. ``position`` and both conversions between pixels and world are those of the
    middle of the half circle, which the straightened CPR shows.

    Attributes
    ----------
    feature : {"max", "mean", "min", "range", "share"}
        Which value of a half circle is shown.
    level : float or None
        The value above which ``"share"`` counts.
    radius : numpy.ndarray, float64, shape (W,)
        Radius of the circle of each column (mm), negative to the left.
    angles : int
        Number of sampled directions of a half circle.
    """

    _arrays = (*Reformation._arrays, "radius")

    def __init__(
        self, surface: PlanarReformation, feature: Feature, level: float | None, radius: float
    ) -> None:
        self.feature: Feature = feature
        self.level: float | None = level
        axes = _AXES.format(shown=_SHOWN[feature].format(level=level))
        kept = ("pixel_spacing", "up", "smoothing")
        parameters = {name: surface.recipe.parameters[name] for name in kept}
        parameters |= {"radius": radius, "feature": feature, "level": level}
        recipe = ReformationRecipe(f"CFA, {feature}", axes, parameters, CfaRequest.kind)
        super().__init__(surface._renderer, surface._core, surface._given, recipe, measurable=True)
        self.angles: int
        self._aggregated, self.angles = self._renderer._core.aggregate(
            self._renderer.volume, surface._core, checked(self._given), (feature, level), self.pixel_spacing
        )
        columns = self.size[0]
        beside = np.arange(-(columns // 2), columns // 2 + 1, dtype=np.float64)
        self.radius: npt.NDArray[np.float64] = beside * self.pixel_spacing

    def __repr__(self) -> str:
        """Return the size."""
        width, height = self.size
        return f"FeatureAggregation({width} × {height} pixels, {self.angles} angles on each side)"

    @functools.cached_property
    def settings(self) -> Settings:
        """The settings, with numbers for the window; values of the volume have its window.

        The window of ``"range"`` begins at 0; ``"share"`` is shown from 0 to 1.
        """
        found = self._renderer.windowed(self._given)
        if not isinstance(found.window, Window):
            return found
        own = [found.window.level, found.window.width]
        level, width = _lumencut.feature_window(self.feature, self.level, own)
        return replace(found, window=Window(level, width))

    def _look(self, settings: Settings, *images: str) -> dict[str, Any]:
        made: dict[str, npt.NDArray[Any]] = {"value": self._aggregated}
        if "image" in images:
            made["image"] = _lumencut.picture(self._aggregated, checked(settings))
        return made


def cfa(
    volume: Any,
    vessel: Vessel,
    radius: float = 10.0,
    feature: Feature = "max",
    pixel_spacing: float | None = None,
    up: npt.ArrayLike = HEAD,
    smoothing: float = 0.0,
    settings: Settings | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
    *,
    level: float | None = None,
) -> FeatureAggregation:
    """Return one straightened picture of everything around a vessel.

    This is our reading of curvicircular feature aggregation (Mistelbauer et al. 2013): a pixel r mm from
    the vessel shows the chosen feature of the half circle of radius r on its side, in the section of its row.
    So everything around the vessel is visible without turning it, on its true side.

    Parameters
    ----------
    volume, vessel, pixel_spacing, up, smoothing, settings, device
        As for :func:`lumencut.cpr`. The slab of the settings extends along the tangent of the circle.
    radius : float, default 10
        The radius of the largest circle (mm).
    feature : {"max", "mean", "min", "range", "share"}, default "max"
        Which value of a half circle is shown: its largest, mean or smallest value; ``"range"``, the largest
        minus the smallest, which shows uneven surroundings; or ``"share"``, the share of the half circle
        above ``level``, from 0 to 1. Its samples are at most a pixel apart, and one of them is
        the pixel of the straightened CPR.
    level : float, optional
        The value above which ``"share"`` counts, in the volume's unit; only for ``"share"``.

    Raises
    ------
    LumencutError
        As :func:`lumencut.cpr`; a ``CameraError`` for a radius that is not above 0, a ``SettingsError`` for
        another feature, for a share without a level, and for a level without a share.
    """
    check_vessel(vessel)
    asked = CfaRequest(radius, feature, pixel_spacing, up, smoothing, settings, level)
    return asked.of(Renderer(volume, VesselTree([vessel]), device), vessel)


@dataclass(frozen=True)
class CfaRequest(ReformationRequest):
    """The parameters of :func:`cfa`."""

    kind, subject = "cfa", "CFA"
    stored = ("level", "radius")

    radius: float = 10.0
    feature: Feature = "max"
    pixel_spacing: float | None = None
    up: npt.ArrayLike = HEAD
    smoothing: float = 0.0
    settings: Settings | None = None
    level: float | None = None

    def of(self, renderer: Renderer, vessel: Vessel) -> FeatureAggregation:
        """Return the CFA of a vessel in the scene and window of a renderer."""
        choice(SettingsError, "feature of the CFA", self.feature, FEATURES)
        level, radius = self.checked().values()
        _lumencut.feature_window(self.feature, level, [0.0, 1.0])
        if not (math.isfinite(radius) and radius > 0):
            raise CameraError("radius of the CFA", f"{radius:g} mm", "a radius above 0 mm")
        surface = self.surface(2 * radius).of(renderer, vessel)
        return FeatureAggregation(surface, self.feature, level, radius)

    def surface(self, width: float) -> CprRequest:
        """Return the straightened CPR of this width (mm) whose pixels stand for the half circles."""
        kept = {name: getattr(self, name) for name in ("pixel_spacing", "up", "smoothing", "settings")}
        return CprRequest("straightened", width, **kept)
