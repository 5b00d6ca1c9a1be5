"""Curved Planar Reformation (CPR): one vessel laid out as an image of its surroundings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice
from lumencut.errors import CameraError, SettingsError
from lumencut.measuring.profile import Profile
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import SlabArgument, check_vessel, flat_settings, radians, rotation
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.request import HEAD, ReformationRequest, pixel_side
from lumencut.reformations.tangential import TangentialReformation, TangentialRequest
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

Mode: TypeAlias = Literal["projected", "stretched", "straightened"]

MODES = ("projected", "stretched", "straightened")

#: The mode that shows the vessel in the pixels of a camera.
TANGENTIAL: Final = "tangential"

ALL_MODES = (*MODES, TANGENTIAL)

#: Width of the strip that shows the angle of each row (pixels).
_STRIP = 32

#: Arc lengths (mm) and the angle at each (radians).
_Rolled: TypeAlias = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]

ROLLS = ("narrowest", "widest")

_AXES = {
    "projected": "Down: height as it is seen. Across: through the vessel; distances are not true.",
    "stretched": "Down: along the unrolled surface. Across: the lines through the vessel, in mm.",
    "straightened": "Down: along the vessel, in mm. Across: through the vessel, in mm.",
}


class PlanarReformation(Reformation):
    """One vessel as an image of its surroundings, made by :func:`lumencut.cpr`.

    Rows run from the vessel's first point at the top to its last one (projected: from the highest point to
    the lowest). The vessel lies in or about the middle column. No picture is mirrored. Where several points
    of the vessel share a row (projected), its arc length is that of the first of them.

    A pixel of a straightened or stretched image is folded if lines across the vessel meet before they reach
    it: the image runs backwards there, or repeats what another row shows nearer to the vessel. A pixel of a
    projected image is folded if several points of the vessel share its row.

    Every world point has a pixel: of several, the one nearest to the vessel. A point that the image does not
    show has the pixel where the viewer sees it (projected), of the nearest place of the surface (stretched),
    or of the section through the point with the nearest centre (straightened).

    Attributes
    ----------
    mode : {"projected", "stretched", "straightened"}
        How the vessel is laid out. Distances are true except in ``"projected"``.
    angle : float
        How far the viewer has moved to the right around the vessel or around up (radians).
    roll : numpy.ndarray, float64, shape (H,), or None
        The angle of each row (radians, without jumps at full turns), if the rows follow a side of the lumen.
    """

    _core: _lumencut.Cpr

    def __init__(
        self,
        renderer: Renderer,
        core: _lumencut.Cpr,
        given: Settings,
        parameters: dict[str, Any],
        rolled: _Rolled | None = None,
    ) -> None:
        self.mode: Mode = parameters["mode"]
        self.angle: float = parameters["angle"]
        recipe = ReformationRecipe(f"{self.mode} CPR", _AXES[self.mode], parameters, CprRequest.kind)
        super().__init__(renderer, core, given, recipe, measurable=self.mode != "projected")
        self.is_projection: bool = self.mode == "projected"
        self.roll: npt.NDArray[np.float64] | None = (
            None if rolled is None else np.interp(self.arc_length, *rolled)
        )

    def rotated(self, angle: float | None = None, *, degrees: float | None = None) -> PlanarReformation:
        """Return the same vessel seen from another side; renderer, volume and frames are reused.

        Unless a width was given, a projected or stretched image is as wide as the vessel from that side.

        Parameters
        ----------
        angle : float
            By how much more the viewer moves to the right (radians): around up as with
            :meth:`Camera.rotated`, and around the vessel where it is straightened.
        degrees : float
            The angle in degrees, instead of ``angle``.

        Raises
        ------
        CameraError
            For both angles or neither, an angle that is not finite, or if the rows follow a side of the
            lumen.
        """
        if self.roll is not None:
            found = f"a CPR whose rows follow the {self.recipe.parameters['roll']} side"
            raise CameraError("angle of the rotation", found, "one at an even angle", "make it without roll")
        turned = self.angle + rotation(angle, degrees)
        core = self._core.rotated(turned)
        parameters = {**self.recipe.parameters, "angle": turned}
        return PlanarReformation(self._renderer, core, self._given, parameters)

    def _title(self) -> str:
        """Return the mode with the angle."""
        if self.roll is not None:
            return f"{self.mode}, {self.recipe.parameters['roll']} side"
        return f"{self.mode} {round(math.degrees(self.angle)) % 360}°"

    def annotated(self, *, vessel_names: bool = True) -> npt.NDArray[np.uint8]:
        """Return the picture with labels as every reformation has them; see `Reformation.annotated`.

        If the rows follow a side of the lumen, a strip to the right of the picture shows their angle: from
        0 at its left edge to half of a turn at its right one.
        """
        image = super().annotated(vessel_names=vessel_names)
        return image if self.roll is None else np.hstack([image, _strip(self.roll)])

    def _edges(self) -> dict[str, str]:
        """Return the sides of the patient at the edges, if they are the same in all rows."""
        if self.mode == "straightened":
            return {}
        # Measured above the image: there the vessel continues straight, and each row has one point.
        origin, *ends = self.world_from_pixel([[0, -2], [1, -2], [0, -1]])
        right, down = np.array(ends) - origin
        named = ("left", "right", "top", "bottom") if self.mode == "projected" else ("left", "right")
        return {edge: letters for edge, letters in _lumencut.edge_letters(right, down) if edge in named}


def _strip(roll: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
    """Return a strip that shows angles (H,) as a light line on grey, RGBA, shape (H, 32, 4)."""
    strip = np.full((len(roll), _STRIP, 4), (40, 40, 40, 255), np.uint8)
    columns = (np.mod(roll, math.pi) / math.pi * _STRIP).astype(int) % _STRIP
    strip[np.arange(len(roll)), columns] = 255
    return strip


def cpr(
    volume: Any,
    vessel: Vessel,
    mode: Mode | Literal["tangential"] = "projected",
    width: float | None = None,
    pixel_spacing: float | None = None,
    angle: float = 0.0,
    up: npt.ArrayLike = HEAD,
    slab: SlabArgument = None,
    smoothing: float = 0.0,
    settings: Settings | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
    *,
    degrees: float | None = None,
    normal: npt.ArrayLike | None = None,
    roll: Literal["narrowest", "widest"] | None = None,
    profile: Profile | None = None,
    camera: Camera | None = None,
) -> PlanarReformation | TangentialReformation:
    """Return one vessel laid out as an image: Curved Planar Reformation (Kanitsar et al. 2002).

    A line is laid through each point of the vessel, and the lines become the rows of the image.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume
        The angiography.
    vessel : Vessel
        The centerline; :meth:`VesselTree.path` makes one of several vessels that meet.
    mode : {"projected", "stretched", "straightened", "tangential"}, default "projected"
        ``"projected"`` shows the vessel as the viewer sees it, rows by height. ``"stretched"`` unrolls the
        surface of the lines, so that distances on it are true. ``"straightened"`` has rows by arc length and
        the vessel in the middle column; the lines are perpendicular to it and do not turn about it
        (rotation-minimising frame, Wang et al. 2008). Only these two are measurable. ``"tangential"`` shows
        the vessel in the pixels of ``camera``, and around it the tissue at the depth of its nearest place
        (name by Mistelbauer et al. 2012, definition ours); see :class:`TangentialReformation`.
    width : float, optional
        Distance of the outermost columns (mm), at most; an odd number of pixels is taken. By default,
        the image shows 25 mm on each side of the vessel: 50 mm where it is straightened.
    pixel_spacing : float, optional
        Side of a pixel (mm); default: the smallest voxel side, at least 0.05 and at most 0.25 mm.
    angle : float, default 0
        By how much the viewer moves to the right (radians), from the front of the patient where ``up`` is the
        head: around ``up``, or around the vessel where it is straightened.
    up : array_like, shape (3,), default (0, 0, 1)
        Upwards in space (LPS); any length. At angle 0 the view runs to the patient's back as far as that is
        perpendicular to up; where up is the patient's front or back, to the head.
    slab : Slab, (mm, mode) or mm, optional
        Thickness of the surface, and which value of it is shown; by default as in the settings. It
        is thick along the view where projected, else perpendicular to the surface.
    smoothing : float, default 0
        Standard deviation of the Gaussian that smooths the centerline along its length (mm, 0 to 1000); its
        ends stay.
    settings : Settings, optional
        Window, opacity, background and slab count; silhouettes, context and samples do nothing here. A focus
        and chosen vessels are refused.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`lumencut.Renderer`.
    degrees : float, optional
        The angle in degrees, instead of ``angle``.
    normal : array_like, shape (3,), optional
        Direction to the viewer at the vessel's first point, at angle 0, for straightened images (LPS); any
        length. By default ``up`` determines it. A vessel that begins along the view is seen against ``up``
        there.
    roll : {"narrowest", "widest"}, optional
        Each section of the straightened vessel is seen from its own angle: from that at which its
        lumen is narrowest, or widest, through the vessel, so that no eccentric stenosis or slit hides in the
        wrong angle (ours). The vessel is measured for it. The angle changes by at most 3.75° each 0.5 mm, and
        is smoothed along the vessel by a Gaussian with a standard deviation of 2 mm;
        :attr:`PlanarReformation.roll` holds it.
    profile : Profile, optional
        The result of :func:`lumencut.measure` for this vessel, to avoid measuring again for a roll.

    camera : Camera, optional
        The view of ``"tangential"``, which takes no width, pixel spacing, angle, up, normal or roll; from the
        front, fitted to the vessel by default.

    Raises
    ------
    VesselTreeError
        For a vessel of another kind, without length, or wholly outside the volume.
    CameraError
        For vectors, an angle, a width or a pixel spacing that are invalid, a width beyond the diagonal of the
        volume, an image of too many pixels, a vessel that lies in one row of it, or a roll of another mode or
        beside an angle.
    SettingsError
        For another mode or device, a smoothing out of range, a slab that is invalid or not thicker than 0, or
        a focus.
    VolumeError
        For an image that is not a volume.
    """
    check_vessel(vessel)
    choice(SettingsError, "mode of the CPR", mode, ALL_MODES)
    renderer = Renderer(volume, VesselTree([vessel]), device)
    if mode == TANGENTIAL:
        placed = (width, pixel_spacing, angle, tuple(np.ravel(up).tolist()), degrees, normal, roll)
        if placed != (None, None, 0.0, HEAD, None, None, None):
            found = "a width, pixel spacing, angle, up, normal or roll with the mode 'tangential'"
            raise CameraError("view of the CPR", found, "camera= alone, which sets all of them")
        return TangentialRequest(camera, slab, smoothing, settings).of(renderer, vessel)
    if camera is not None:
        found = f"a camera with the mode {mode!r}"
        raise CameraError("camera of the CPR", found, "the mode 'tangential'", "leave out the camera")
    turned = one_angle(angle, degrees)
    asked = CprRequest(
        mode, width, pixel_spacing, turned, up, slab, smoothing, settings, normal, roll, profile
    )
    return asked.of(renderer, vessel)


@dataclass(frozen=True)
class CprRequest(ReformationRequest):
    """The parameters of :func:`cpr` in the modes that have rows."""

    kind, subject = "cpr", "CPR"
    stored = ("mode", "width", "pixel_spacing", "angle", "up", "smoothing", "normal", "roll")

    mode: Mode = "projected"
    width: float | None = None
    pixel_spacing: float | None = None
    angle: float = 0.0
    up: npt.ArrayLike = HEAD
    slab: SlabArgument = None
    smoothing: float = 0.0
    settings: Settings | None = None
    normal: npt.ArrayLike | None = None
    roll: Literal["narrowest", "widest"] | None = None
    profile: Profile | None = None

    def of(self, renderer: Renderer, vessel: Vessel) -> PlanarReformation:
        """Return the CPR of a vessel in the scene and window of a renderer."""
        volume = self._volume(renderer, vessel)
        choice(SettingsError, "mode of the CPR", self.mode, MODES)
        if self.normal is not None and self.mode != "straightened":
            found = f"a normal with the mode {self.mode!r}"
            raise CameraError("normal of the CPR", found, "the mode 'straightened'")
        given = flat_settings(self.settings, self.slab)
        asked = self.checked(pixel_spacing=pixel_side(volume))
        _check_width(asked["width"], volume)
        view = (asked["up"], asked["angle"], asked["normal"])
        pixels = (asked["width"], asked["pixel_spacing"])
        core = _lumencut.Cpr(vessel.points, asked["smoothing"], self.mode, view, pixels)
        if self.roll is None:
            return PlanarReformation(renderer, core, given, asked)
        rolled = _rolled(volume, vessel, asked, self.profile)
        return PlanarReformation(renderer, core.rolled(*rolled), given, asked, rolled)


def _rolled(volume: Volume, vessel: Vessel, parameters: dict[str, Any], profile: Profile | None) -> _Rolled:
    """Return arc lengths (mm), and the angles (radians) of the planes through the requested side."""
    from lumencut.measuring.sections import measure

    choice(CameraError, "roll of the CPR", parameters["roll"], ROLLS)
    for name, expected in (("mode", "straightened"), ("angle", 0.0), ("normal", None)):
        if parameters[name] != expected:
            found = f"a roll with the {name} {parameters[name]!r}"
            raise CameraError("roll of the CPR", found, f"{name} {expected!r}", f"leave out roll or {name}")
    known = profile or measure(volume, vessel)
    smoothing, up = parameters["smoothing"], parameters["up"]
    wall = _lumencut.LumenWall(volume, (vessel.points, vessel.radius), smoothing, up, known._core)
    return wall.roll(parameters["roll"])


def one_angle(angle: float, degrees: float | None) -> float:
    """Return the angle in radians; degrees may only be given with an angle of 0."""
    if degrees is not None and angle != 0:
        found = "an angle in radians and one in degrees"
        raise CameraError("angle of the CPR", found, "one of angle= (radians) and degrees=")
    return radians("angle of the CPR", angle, degrees)


def _check_width(width: float | None, volume: Volume) -> None:
    """Reject a width beyond the diagonal of the volume."""
    corners = volume.corners
    diagonal = float(np.linalg.norm(corners[:, None] - corners, axis=2).max())
    if width is not None and width > diagonal:
        expected = f"at most {diagonal:.4g} mm, the diagonal of the volume"
        raise CameraError("width of the CPR", f"{width:g} mm", expected)
