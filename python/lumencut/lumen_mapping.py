"""Makes a lumen map: measures the vessel, finds its wall and unrolls the wall."""

from __future__ import annotations

from typing import Any, Literal

import numpy.typing as npt

from lumencut import _lumencut
from lumencut._checks import choice, number, numbers
from lumencut._reformation_checks import check_vessel, flat_settings, pixel_side
from lumencut.errors import CameraError, MeasuringError, SettingsError, VesselTreeError, VolumeError
from lumencut.planar_reformation import one_angle
from lumencut.profile import Profile
from lumencut.renderer import Renderer
from lumencut.settings import Settings
from lumencut.slab import Slab
from lumencut.unrolled_wall import MODES, LumenMap, MappedVessel, Mode
from lumencut.vessel import Vessel
from lumencut.vessel_tree import VesselTree

_HEAD = (0.0, 0.0, 1.0)


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
    up: npt.ArrayLike = _HEAD,
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
    return lumen_map_of(
        Renderer(volume, VesselTree([vessel]), device),
        vessel,
        mode,
        pixel_spacing=pixel_spacing,
        angle=turned,
        overlap=overlap,
        band=band,
        show=show,
        calcium_level=calcium_level,
        profile=profile,
        tree=tree,
        up=up,
        smoothing=smoothing,
        settings=settings,
    )


def lumen_map_of(
    renderer: Renderer,
    vessel: Vessel,
    mode: Mode = "wall",
    *,
    pixel_spacing: float | None = None,
    angle: float | None = None,
    overlap: float = 0.0,
    band: tuple[float, float] = (-1.0, 3.0),
    show: Literal["max", "mean", "min"] = "max",
    calcium_level: float | None = None,
    profile: Profile | None = None,
    tree: VesselTree | None = None,
    up: npt.ArrayLike = _HEAD,
    smoothing: float = 0.0,
    settings: Settings | None = None,
) -> LumenMap:
    """Return the map of a vessel in the window of a renderer; parameters as for :func:`lumen_map`."""
    check_vessel(vessel)
    choice(SettingsError, "mode of the lumen map", mode, MODES)
    if not isinstance(profile, (Profile, type(None))):
        raise MeasuringError("profile of the lumen map", type(profile).__name__, "a Profile or None")
    if not isinstance(tree, (VesselTree, type(None))):
        raise VesselTreeError("tree of the lumen map", type(tree).__name__, "a VesselTree or None")
    low, high = numbers(SettingsError, "band of the lumen map", band, (2,)).tolist()
    if not -1e3 <= low < high <= 1e3:
        found = f"from {low:g} to {high:g} mm"
        raise SettingsError("band of the lumen map", found, "two distances that rise, within 1000 mm")
    grid = renderer.volume
    if grid is None:
        raise VolumeError("volume of the lumen map", "None", "a volume to show")
    smooth = number(SettingsError, "smoothing of the centerline", smoothing)
    upwards = numbers(CameraError, "up of the lumen map", up, (3,)).tolist()
    wanted = {
        "pixel_spacing": pixel_side(grid, pixel_spacing, "lumen map"),
        "angle": None if angle is None else number(CameraError, "angle of the lumen map", angle),
        "overlap": number(CameraError, "overlap of the lumen map", overlap),
        "band": [low, high],
        "show": show,
        "calcium_level": None
        if calcium_level is None
        else number(SettingsError, "calcium_level", calcium_level),
        "up": upwards,
        "smoothing": smooth,
    }
    known = profile or _measured(grid, vessel, tree)
    wall = _lumencut.LumenWall(
        grid, (vessel.points, vessel.radius), smooth, upwards, None if known is None else known._core
    )
    given = flat_settings(settings, Slab(high - low, show))
    return LumenMap(MappedVessel(renderer, wall, known, tree), given, mode, wanted)


def _measured(volume: Any, vessel: Vessel, tree: VesselTree | None) -> Profile | None:
    """Return the profile of the vessel; None if no lumen can be measured but the vessel has radii."""
    from lumencut.measuring import measure

    try:
        return measure(volume, vessel, tree=tree)
    except MeasuringError:
        if vessel.radius is None:
            raise
        return None
