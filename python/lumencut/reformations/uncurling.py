"""Uncurl: one vessel with its surroundings between the camera view and the straightened CPR."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import integers, number
from lumencut.errors import CameraError, SettingsError
from lumencut.pictures.reformation_recipe import ReformationRecipe, camera_parameters
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import SlabArgument, check_vessel, flat_settings
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.request import ReformationRequest
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

_MOST_FRAMES = 10_000


class Uncurled(Reformation):
    """One vessel, partly straightened, in the pixels of a camera; made by :func:`lumencut.uncurl`.

    At an amount of 0 it is the tangential CPR, at 1 the straightened CPR in the middle of the image, seen
    from the camera's side of the vessel's first point. In between, the vessel keeps its length and bends
    less. A pixel is folded where another part of the vessel is nearer to what it shows. A world point that is
    not shown has no pixel (NaN).

    Attributes
    ----------
    amount : float
        How far the vessel is straightened, from 0 to 1.
    camera : Camera
        The view.
    width : float or None
        Width around the vessel that shows something (mm); None shows all.
    """

    _core: _lumencut.Uncurl

    def __init__(
        self,
        renderer: Renderer,
        vessel: Vessel,
        camera: Camera,
        amount: float,
        how: tuple[float | None, float],
        given: Settings,
    ) -> None:
        self.amount: float = amount
        self.camera: Camera = camera
        self.width: float | None
        self.width, smoothing = how
        self._vessel, self._how = vessel, how
        core = _lumencut.Uncurl(vessel.points, smoothing, camera, amount, self.width)
        parameters = {
            "camera": camera_parameters(camera),
            "amount": amount,
            "width": self.width,
            "smoothing": smoothing,
        }
        axes = _lumencut.axes_words("uncurled", amount)
        recipe = ReformationRecipe(f"uncurled {100 * amount:.0f} %", axes, parameters, UncurlRequest.kind)
        super().__init__(renderer, core, given, recipe, measurable=False)

    def changed(self, amount: float) -> Uncurled:
        """Return the same vessel straightened by another amount, from 0 to 1, with the same renderer.

        Raises
        ------
        SettingsError
            For an amount outside 0 to 1.
        """
        checked = number(SettingsError, "amount of the uncurling", amount)
        return Uncurled(self._renderer, self._vessel, self.camera, checked, self._how, self._given)


def uncurl(
    volume: Any,
    vessel: Vessel,
    camera: Camera | None = None,
    amount: float = 0.5,
    width: float | None = None,
    pixel_spacing: float | None = None,
    smoothing: float = 0.0,
    slab: SlabArgument = None,
    settings: Settings | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> Uncurled:
    """Return a vessel with its surroundings, straightened by an amount (ours).

    The curvature of the vessel, in the frame that does not turn about it, is made smaller by the amount, and
    the vessel is drawn again with it: its lengths stay true, and a helix stays a helix of the same torsion.
    Its line from end to end turns from its own direction to downwards. Each pixel finds the nearest place of
    the bent vessel in the image, and shows the tissue at the same offset from that place of the true vessel.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume
        The angiography.
    vessel : Vessel
        The centerline; :meth:`VesselTree.path` makes one of several vessels that meet.
    camera : Camera, optional
        The view; from the front by default, with room for the vessel at every amount.
    amount : float, default 0.5
        From 0, the tangential CPR of ``cpr(mode="tangential", camera=camera)``, to 1, the straightened CPR of
        ``cpr(mode="straightened", normal=-camera.direction)``.
    width : float, optional
        Width around the vessel that is shown (mm); everything by default.
    pixel_spacing : float, optional
        Side of a pixel (mm) instead of the camera's, whose image keeps the length of its sides.
    smoothing : float, default 0
        Standard deviation of the Gaussian that smooths the centerline along its length (mm, 0 to 1000).
    slab : Slab, (mm, mode) or mm, optional
        Thickness of the image along the view, in the true surroundings of each place; by default as in the
        settings.
    settings : Settings, optional
        Window, opacity and slab; a focus and chosen vessels are refused.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`lumencut.Renderer`.

    Raises
    ------
    VesselTreeError
        For a vessel of another kind, without length, or wholly outside the volume.
    CameraError
        For a camera of another kind, a width that is not above 0, or a pixel spacing that is invalid.
    SettingsError
        For an amount outside 0 to 1, a smoothing out of range, an invalid slab, or a focus.
    VolumeError
        For an image that is not a volume.
    """
    check_vessel(vessel)
    asked = UncurlRequest(camera, amount, width, pixel_spacing, smoothing, slab, settings)
    return asked.of(Renderer(volume, VesselTree([vessel]), device), vessel)


@dataclass(frozen=True)
class UncurlRequest(ReformationRequest):
    """The parameters of :func:`uncurl`."""

    kind, subject = "uncurl", "uncurling"
    stored = ("amount", "smoothing", "width", "pixel_spacing")

    camera: Camera | None = None
    amount: float = 0.5
    width: float | None = None
    pixel_spacing: float | None = None
    smoothing: float = 0.0
    slab: SlabArgument = None
    settings: Settings | None = None

    def of(self, renderer: Renderer, vessel: Vessel) -> Uncurled:
        """Return an uncurled vessel in the scene and window of a renderer."""
        self._check_camera(self.camera)
        self._volume(renderer, vessel)
        amount, smoothing, width, side = self.checked().values()
        view = self.camera or fitted_uncurling(Camera.anterior(VesselTree([vessel])), vessel, smoothing)
        if side is not None:
            view = _with_pixels(view, side)
        given = flat_settings(self.settings, self.slab)
        return Uncurled(renderer, vessel, view, amount, (width, smoothing), given)


def fitted_uncurling(camera: Camera, vessel: Vessel, smoothing: float = 0.0) -> Camera:
    """Return the camera in the middle of a vessel, with pixels at which it fits at every amount.

    Parameters
    ----------
    camera : Camera
        The view; its direction, up and size are kept.
    vessel : Vessel
        The vessel to uncurl.
    smoothing : float, default 0
        As for :func:`uncurl` (mm).
    """
    check_vessel(vessel)
    return camera._moved(_lumencut.fitted_uncurling(camera, vessel.points, smoothing))


def film_amounts(frames: int) -> npt.NDArray[np.float64]:
    """Return the amounts of a film's frames, shape (frames,): from 0 to 1, changing slowly at both ends."""
    (count,) = integers(CameraError, "frames of the uncurling", [frames], 2, _MOST_FRAMES, 1)
    at = np.linspace(0, 1, count)
    return at * at * (3 - 2 * at)


def uncurling(first: Uncurled, frames: int = 48) -> Iterator[Uncurled]:
    """Yield a vessel frame by frame as it is straightened, from an amount of 0 to 1; no frame is kept.

    Parameters
    ----------
    first : Uncurled
        The vessel at any amount, with the view, the width and the settings of all frames.
    frames : int, default 48
        How many frames, at least 2.
    """
    for amount in film_amounts(frames):
        yield first.changed(float(amount))


def _with_pixels(camera: Camera, spacing: float) -> Camera:
    """Return the same view with pixels of another size."""
    if not (np.isfinite(spacing) and spacing > 0):
        raise CameraError("pixel_spacing of the uncurling", f"{spacing:g} mm", "a length above 0 mm")
    width, height = (max(1, round(side * camera.pixel_spacing / spacing)) for side in camera.size)
    return replace(camera, size=(width, height), pixel_spacing=spacing)
