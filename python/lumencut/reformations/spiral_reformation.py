"""Spiral CPR: every section across a vessel wound up into one row of an image."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice, number
from lumencut.errors import SettingsError, VesselTreeError
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import SlabArgument, check_vessel, flat_settings
from lumencut.reformations.planar_reformation import one_angle
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.request import HEAD, ReformationRequest, pixel_side
from lumencut.scene.settings import Settings
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

SAMPLINGS = ("arc", "angle")

#: The areas that a ruler may show (mm²), and its greatest width as a share of the picture.
_AREAS, _WIDEST = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000), 0.4


#: Largest number of columns with a default pitch.
_MOST_COLUMNS = 16_000


class SpiralReformation(Reformation):
    """A vessel whose sections are wound up into rows (H, W), made by :func:`lumencut.spiral`.

    The vessel is the middle column. From there two spirals go out to both sides, half of a turn apart. A
    world point lies on the winding that is nearest to it, NaN beyond the outermost one and beyond the ends
    of the vessel. A pixel is folded where sections have met before they reach it.

    Attributes
    ----------
    pitch : float
        The distance of neighbouring windings (mm). With samples at even arc lengths the width of anything in
        a row, in mm, is its area in the section, in mm², divided by the pitch.
    radius : float
        How far from the vessel the windings reach (mm).
    sampling : {"arc", "angle"}
        The spacing of samples on the spirals.
    """

    def __init__(
        self, renderer: Renderer, core: _lumencut.Spiral, given: Settings, parameters: dict[str, Any]
    ) -> None:
        self.pitch: float = parameters["pitch"]
        self.radius: float = parameters["radius"]
        self.sampling: str = parameters["sampling"]
        axes = _lumencut.axes_words(f"spiral by {self.sampling}", self.pitch)
        recipe = ReformationRecipe("spiral CPR", axes, parameters, SpiralRequest.kind)
        super().__init__(renderer, core, given, recipe, measurable=False)

    def area(self, columns: int) -> float:
        """Return the area in a section (mm²) that this number of columns of a row represents.

        Raises
        ------
        SettingsError
            If samples lie at even angles: columns then do not represent equal areas.
        """
        if self.sampling != "arc":
            raise SettingsError("sampling of the spiral CPR", repr(self.sampling), "'arc', for areas")
        return number(SettingsError, "columns", columns) * self.pixel_spacing * self.pitch

    def annotated(self, *, vessel_names: bool = True) -> npt.NDArray[np.uint8]:
        """Return the picture with labels as every reformation has them, and with a ruler in mm²."""
        from lumencut.pictures.lettering import SMALLEST_SIDE, Sheet

        image = super().annotated(vessel_names=vessel_names)
        volume = self._renderer.volume
        states_spacing = volume is not None and volume.states_spacing
        if self.sampling != "arc" or min(self.size) < SMALLEST_SIDE or not states_spacing:
            return image
        fitting = [area for area in _AREAS if self._ruler(area) <= _WIDEST * self.size[0]]
        if not fitting:
            return image
        sheet = Sheet(image)
        sheet.ruler(self._ruler(fitting[-1]), f"{fitting[-1]} square mm")
        return sheet.pixels()

    def _ruler(self, area: float) -> float:
        """Return the width of an area in a row (pixels)."""
        return area / self.pitch / self.pixel_spacing


def spiral(
    volume: Any,
    vessel: Vessel,
    pitch: float | None = None,
    radius: float | None = None,
    sampling: Literal["arc", "angle"] = "arc",
    pixel_spacing: float | None = None,
    angle: float = 0.0,
    *,
    up: npt.ArrayLike = HEAD,
    slab: SlabArgument = None,
    smoothing: float = 0.0,
    settings: Settings | None = None,
    degrees: float | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> SpiralReformation:
    """Return a vessel whose sections are wound up, so that a still picture shows all around it.

    In each section two spirals go out from the vessel with an even distance of windings; they become one row.
    Windings sample a section evenly, so the width of anything in a row is its area divided by the pitch: half
    of a diameter is a quarter of the width. Kanitsar (dissertation, TU Wien 2004) describes the spirals of
    helical CPR; the formulas and this law are ours.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume
        The angiography.
    vessel : Vessel
        The centerline; :meth:`VesselTree.path` makes one of several vessels that meet.
    pitch : float, optional
        The distance of neighbouring windings (mm); a quarter of the vessel's median radius by default,
        but no less than the smallest side of a voxel, and no finer than fits into 16,000 columns.
    radius : float, optional
        How far from the vessel the windings reach (mm); by default 1.25 times its largest radius plus 2 mm.
    sampling : {"arc", "angle"}, default "arc"
        ``"arc"``: samples are a pixel apart along the spirals. ``"angle"``: they are an even angle apart, so
        that every winding has the same width.
    pixel_spacing : float, optional
        Side of a pixel (mm); default: the smallest voxel side, at least 0.05 and at most 0.25 mm.
    angle : float, default 0
        The angle by which sections are turned (radians): 0 begins to the right of the straightened CPR.
    up : array_like, shape (3,), default (0, 0, 1)
        Upwards in space (LPS), as for :func:`lumencut.cpr`.
    smoothing : float, default 0
        Standard deviation of the Gaussian that smooths the centerline along its length (mm).
    slab : Slab, (mm, mode) or mm, optional
        Thickness across the spirals, and which value of it is shown; by default as in the settings.
    settings : Settings, optional
        Window, opacity, background and slab.
    degrees : float, optional
        The angle in degrees, instead of ``angle``.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`lumencut.Renderer`.

    Raises
    ------
    VesselTreeError
        For a vessel of another kind, without length, or without radii where pitch or radius is not given.
    CameraError
        For lengths that are invalid, and for an image of too many pixels: it names a pitch that fits.
    SettingsError
        For another sampling, or a smoothing out of range.
    VolumeError
        For an image that is not a volume.
    """
    check_vessel(vessel)
    turned = one_angle(angle, degrees)
    asked = SpiralRequest(pitch, radius, sampling, pixel_spacing, turned, up, slab, smoothing, settings)
    return asked.of(Renderer(volume, VesselTree([vessel]), device), vessel)


@dataclass(frozen=True)
class SpiralRequest(ReformationRequest):
    """The parameters of :func:`spiral`."""

    kind, subject = "spiral", "spiral CPR"
    stored = ("pixel_spacing", "radius", "sampling", "angle", "up", "smoothing", "pitch")

    pitch: float | None = None
    radius: float | None = None
    sampling: Literal["arc", "angle"] = "arc"
    pixel_spacing: float | None = None
    angle: float = 0.0
    up: npt.ArrayLike = HEAD
    slab: SlabArgument = None
    smoothing: float = 0.0
    settings: Settings | None = None

    def of(self, renderer: Renderer, vessel: Vessel) -> SpiralReformation:
        """Return the spiral CPR of a vessel in the scene and window of a renderer."""
        volume = self._volume(renderer, vessel)
        choice(SettingsError, "sampling of the spiral CPR", self.sampling, SAMPLINGS)
        reach = _reach(vessel) if self.radius is None else None
        asked = self.checked(pixel_spacing=pixel_side(volume), radius=reach)
        if self.pitch is None:
            asked["pitch"] = _fine_pitch(vessel, float(volume.spacing.min()), asked)
        given = flat_settings(self.settings, self.slab)
        lengths = [asked[name] for name in ("pitch", "radius", "pixel_spacing")]
        core = _lumencut.Spiral(
            vessel.points, asked["smoothing"], asked["up"], lengths, self.sampling, asked["angle"]
        )
        return SpiralReformation(renderer, core, given, asked)


def _radii(vessel: Vessel, missing: str) -> npt.NDArray[np.float64]:
    """Return the radii of a vessel that are above 0."""
    known = np.zeros(0) if vessel.radius is None else vessel.radius[vessel.radius > 0]
    if not known.size:
        expected = "radii, or the other"
        raise VesselTreeError("radius of the vessel", "none", expected, f"give {missing}=, in mm")
    return known


def _reach(vessel: Vessel) -> float:
    return _lumencut.spiral_reach(float(_radii(vessel, "radius").max()))


def _fine_pitch(vessel: Vessel, voxel: float, parameters: dict[str, Any]) -> float:
    """Return a quarter of the median radius, or more if voxels or the widest picture require that."""
    usual = float(np.median(_radii(vessel, "pitch")))
    radius, spacing = parameters["radius"], parameters["pixel_spacing"]
    return _lumencut.spiral_pitch(usual, voxel, radius, spacing, _MOST_COLUMNS)
