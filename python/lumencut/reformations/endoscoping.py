"""Makes an endoscopy: measures the vessel, finds its wall, and looks at it from inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy.typing as npt

from lumencut.base.checks import choice, flag, integers
from lumencut.errors import CameraError, SettingsError
from lumencut.measuring.profile import Profile
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import check_vessel, flat_settings
from lumencut.reformations.endoscopic_view import Endoscopy, Lens, SeenVessel, finite
from lumencut.reformations.lumen_mapping import found_wall
from lumencut.reformations.request import HEAD, ReformationRequest
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree


def endoscopy(
    volume: Any,
    vessel: Vessel,
    at: float,
    lens: Lens = "perspective",
    field_of_view: float | None = None,
    size: tuple[int, int] = (512, 512),
    roll: float = 0.0,
    *,
    backwards: bool = False,
    profile: Profile | None = None,
    tree: VesselTree | None = None,
    up: npt.ArrayLike = HEAD,
    smoothing: float = 0.0,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> Endoscopy:
    """Return a vessel as an eye on its centerline sees it from inside.

    The wall is that of :func:`lumencut.lumen_map`: the measured contour. Through the openings of branches and
    beyond the ends of the vessel, rays go on to where values fall halfway from the lumen to its surroundings.
    The eye looks two radii along the centerline, at least 5 mm; the picture's top is the viewer's side of the
    straightened CPR. The definition is ours.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume
        The angiography.
    vessel : Vessel
        The centerline; :meth:`VesselTree.path` makes one of several vessels that meet.
    at : float
        The place of the eye along the vessel (mm).
    lens : {"perspective", "fisheye"}, default "perspective"
        ``"perspective"`` keeps straight lines straight. With ``"fisheye"``, angles from the middle are
        distances in a round image.
    field_of_view : float, optional
        The angle across the smaller side of the image (radians); default: 100° in perspective, 180° with
        ``"fisheye"``.
    size : (int, int), default (512, 512)
        Width and height (pixels).
    roll : float, default 0
        Turn of the picture clockwise (radians).
    backwards : bool, default False
        Whether the eye looks towards the start of the vessel.
    profile : Profile, optional
        The result of :func:`lumencut.measure` for this vessel, to avoid measuring again.
    tree : VesselTree, optional
        Vessels whose openings are named: :attr:`Endoscopy.ostia`.
    up : array_like, shape (3,), default (0, 0, 1)
        Upwards in space (LPS), as for :func:`lumencut.cpr`.
    smoothing : float, default 0
        Standard deviation of the Gaussian that smooths the centerline along its length (mm).
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`lumencut.Renderer`.

    Raises
    ------
    VesselTreeError
        For a vessel of another kind or without length, and for one without radii whose lumen cannot be
        measured either.
    CameraError
        For a place beyond the vessel, and a field of view, size or roll that cannot be.
    SettingsError
        For another lens, or a smoothing out of range.
    MeasuringError
        For an invalid profile.
    VolumeError
        For an image that is not a volume.

    Warns
    -----
    LineWarning
        If the eye lies outside the lumen, or the lumen is narrower than a voxel.
    """
    check_vessel(vessel)
    asked = EndoscopyRequest(at, lens, field_of_view, size, roll, backwards, profile, tree, up, smoothing)
    made = asked.of(Renderer(volume, VesselTree([vessel]), device), vessel)
    made.warn()
    return made


@dataclass(frozen=True)
class EndoscopyRequest(ReformationRequest):
    """The parameters of :func:`endoscopy`."""

    kind, subject = "endoscopy", "endoscopy"
    stored = ("at", "lens", "field_of_view", "size", "roll", "backwards", "up", "smoothing")

    at: float
    lens: Lens = "perspective"
    field_of_view: float | None = None
    size: tuple[int, int] = (512, 512)
    roll: float = 0.0
    backwards: bool = False
    profile: Profile | None = None
    tree: VesselTree | None = None
    up: npt.ArrayLike = HEAD
    smoothing: float = 0.0

    def of(self, renderer: Renderer, vessel: Vessel) -> Endoscopy:
        """Return what an eye in a vessel sees, in the scene of a renderer."""
        grid = self._volume(renderer, vessel)
        choice(SettingsError, "lens of the endoscopy", self.lens, ("perspective", "fisheye"))
        flag(CameraError, "backwards", self.backwards)
        finite("at", self.at)
        finite("roll", self.roll)
        integers(CameraError, "size of the endoscopy", self.size, 1, 32768, 2)
        asked = self.checked()
        wall, known = found_wall(grid, vessel, self, asked)
        seen = SeenVessel(renderer, wall.inside(), known, self.tree)
        return Endoscopy(seen, flat_settings(None), asked)


def flight(first: Endoscopy, to: float, speed: float, fps: float) -> list[float]:
    """Return the places (mm) of the frames of a flight from a view to a place, at most this fast (mm/s).

    The flight slows down where the eye would turn by more than 60° per second.
    """
    return first._seen.inside.flight((first.at, finite("to", to)), finite("speed", speed), fps)
