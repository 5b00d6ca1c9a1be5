"""Makes a lumen map: measures the vessel, finds its wall and unrolls the wall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice
from lumencut.errors import MeasuringError, SettingsError, VesselTreeError
from lumencut.measuring.profile import Profile
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import check_vessel, flat_settings
from lumencut.reformations.planar_reformation import one_angle
from lumencut.reformations.request import HEAD, ReformationRequest, pixel_side
from lumencut.reformations.unrolled_wall import MODES, LumenMap, MappedVessel, Mode
from lumencut.scene.settings import Settings
from lumencut.scene.slab import Slab
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree


def lumen_map(
    volume: Any,
    vessel: Vessel,
    mode: Mode = "wall",
    pixel_spacing: float | None = None,
    angle: float | None = None,
    overlap: float = 0.0,
    *,
    band: tuple[float, float] = (-1.0, 3.0),
    show: Literal["max", "mean", "min"] = "max",
    calcium_level: float | None = None,
    profile: Profile | None = None,
    tree: VesselTree | None = None,
    up: npt.ArrayLike = HEAD,
    smoothing: float = 0.0,
    settings: Settings | None = None,
    degrees: float | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> LumenMap:
    """Return the wall of a vessel cut open along it and unrolled.

    Rays are cast from the centerline in all directions of each section. The wall is the measured contour. In
    sections without a contour it is where values first fall halfway to those outside the vessel; if no lumen
    can be measured, it is the radius of the centerline. A ray that meets no wall within 1.6 radii leaves
    through the opening of a branch, which is drawn as a hole. Casting rays radially from a curve follows
    Lampe et al. 2009 (doi:10.1109/TVCG.2009.136); the formulas are ours.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume
        The angiography.
    vessel : Vessel
        The centerline; :meth:`VesselTree.path` makes one of several vessels that meet.
    mode : {"wall", "radius", "thickness", "shaded"}, default "wall"
        ``"wall"`` shows the volume at the wall: calcium, struts of stents. ``"radius"`` shows how far the
        wall is from the centerline, in colour. ``"thickness"`` shows how thick calcium or metal lies at the
        wall, in colour. ``"shaded"`` shows the wall as a surface, lit from inside.
    pixel_spacing : float, optional
        Side of a pixel (mm), along the vessel and around it at the mean radius; default: the smallest voxel
        side, at least 0.05 and at most 0.25 mm.
    angle : float, optional
        The direction of the middle column around the vessel (radians); 0 is to the right of the straightened
        CPR at angle 0. By default, the side with most calcium is in the middle, so that the cut does not
        run through it; 0 if there is no calcium.
    overlap : float, default 0
        The angle by which the map repeats the other side beyond each edge (radians, 0 to 3), dimmed.
    band : (float, float), default (-1, 3)
        Range beyond the wall that ``"wall"`` and ``"thickness"`` search (mm).
    show : {"max", "mean", "min"}, default "max"
        Which value of the band ``"wall"`` shows.
    calcium_level : float, optional
        Level from which something at the wall counts as calcium or metal, in the volume's unit; by default
        the lumen's level plus half of its contrast, at least 130.
    profile : Profile, optional
        The result of :func:`lumencut.measure` for this vessel, to avoid measuring again.
    tree : VesselTree, optional
        Vessels whose openings are named: :attr:`LumenMap.ostia`.
    up : array_like, shape (3,), default (0, 0, 1)
        Upwards in space (LPS), as for :func:`lumencut.cpr`.
    smoothing : float, default 0
        Standard deviation of the Gaussian that smooths the centerline along its length (mm).
    settings : Settings, optional
        Window, opacity and background of ``"wall"``.
    degrees : float, optional
        The angle in degrees, instead of ``angle``.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`lumencut.Renderer`.

    Raises
    ------
    VesselTreeError
        For a vessel of another kind or without length, and for one without radii whose lumen cannot be
        measured either.
    CameraError
        For a pixel spacing, angle, overlap or up that is invalid, or an image of too many pixels.
    SettingsError
        For another mode, a band that does not rise, or a smoothing out of range.
    MeasuringError
        For an invalid profile, and for ``"thickness"`` if the level of calcium is unknown.
    VolumeError
        For an image that is not a volume.
    """
    check_vessel(vessel)
    turned = (
        one_angle(0.0 if angle is None else angle, degrees)
        if angle is not None or degrees is not None
        else None
    )
    shown = (mode, pixel_spacing, turned, overlap, band, show, calcium_level)
    asked = LumenMapRequest(*shown, profile, tree, up, smoothing, settings)
    return asked.of(Renderer(volume, VesselTree([vessel]), device), vessel)


@dataclass(frozen=True)
class LumenMapRequest(ReformationRequest):
    """The parameters of :func:`lumen_map`."""

    kind, subject = "map", "lumen map"
    stored = ("pixel_spacing", "angle", "overlap", "band", "show", "calcium_level", "up", "smoothing")

    mode: Mode = "wall"
    pixel_spacing: float | None = None
    angle: float | None = None
    overlap: float = 0.0
    band: tuple[float, float] = (-1.0, 3.0)
    show: Literal["max", "mean", "min"] = "max"
    calcium_level: float | None = None
    profile: Profile | None = None
    tree: VesselTree | None = None
    up: npt.ArrayLike = HEAD
    smoothing: float = 0.0
    settings: Settings | None = None

    def of(self, renderer: Renderer, vessel: Vessel) -> LumenMap:
        """Return the map of a vessel in the window of a renderer."""
        grid = self._volume(renderer, vessel)
        choice(SettingsError, "mode of the lumen map", self.mode, MODES)
        asked = self.checked(pixel_spacing=pixel_side(grid))
        low, high = asked["band"]
        if not -1e3 <= low < high <= 1e3:
            found = f"from {low:g} to {high:g} mm"
            raise SettingsError("band of the lumen map", found, "two distances that rise, within 1000 mm")
        wall, known = found_wall(grid, vessel, self, asked)
        given = flat_settings(self.settings, Slab(high - low, self.show))
        return LumenMap(MappedVessel(renderer, wall, known, self.tree), given, self.mode, asked)


def found_wall(
    volume: Any, vessel: Vessel, asked: Any, checked: dict[str, Any]
) -> tuple[_lumencut.LumenWall, Profile | None]:
    """Return the wall of a vessel for a request with checked parameters, and the profile, if any."""
    profile, tree = asked.profile, asked.tree
    if not isinstance(profile, (Profile, type(None))):
        raise MeasuringError(f"profile of the {asked.subject}", type(profile).__name__, "a Profile or None")
    if not isinstance(tree, (VesselTree, type(None))):
        raise VesselTreeError(f"tree of the {asked.subject}", type(tree).__name__, "a VesselTree or None")
    known = profile or _measured(volume, vessel, tree)
    core = None if known is None else known._core
    arrays = (vessel.points, vessel.radius)
    return _lumencut.LumenWall(volume, arrays, checked["smoothing"], checked["up"], core), known


def _measured(volume: Any, vessel: Vessel, tree: VesselTree | None) -> Profile | None:
    """Return the profile of the vessel; None if no lumen can be measured but the vessel has radii."""
    from lumencut.measuring.sections import measure

    try:
        return measure(volume, vessel, tree=tree)
    except MeasuringError:
        if vessel.radius is None:
            raise
        return None
