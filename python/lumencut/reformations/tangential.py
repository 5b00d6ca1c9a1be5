"""Tangential CPR: one vessel in a camera view, with the tissue at the same depth next to each place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lumencut import _lumencut
from lumencut.pictures.reformation_recipe import ReformationRecipe, camera_parameters
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import SlabArgument, flat_settings, rotation
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.request import ReformationRequest
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

_AXES = "As the camera sees it, each pixel as deep as the nearest place of the vessel; lengths are not true."


class TangentialReformation(Reformation):
    """One vessel in the pixels of a camera, made by :func:`lumencut.cpr` with the mode ``"tangential"``.

    Each pixel looks along its own ray at the depth of that place of the vessel which is nearest to it in the
    image. No pixel is folded: in space no place of the vessel is nearer to what a pixel shows. Where two
    stretches of the vessel are equally near, the image is torn. Every world point has the pixel where the
    camera sees it.

    Attributes
    ----------
    mode : str
        ``"tangential"``.
    camera : Camera
        The view.
    """

    mode = "tangential"
    is_projection = True

    def __init__(
        self, renderer: Renderer, vessel: Vessel, camera: Camera, smoothing: float, given: Settings
    ) -> None:
        self.camera: Camera = camera
        self._vessel, self._smoothing = vessel, smoothing
        core = _lumencut.tangential_layout(vessel.points, smoothing, camera)
        parameters = {"mode": self.mode, "camera": camera_parameters(camera), "smoothing": smoothing}
        recipe = ReformationRecipe("tangential CPR", _AXES, parameters, TangentialRequest.kind)
        super().__init__(renderer, core, given, recipe, measurable=False)

    def rotated(self, angle: float | None = None, *, degrees: float | None = None) -> TangentialReformation:
        """Return the same vessel with the camera turned to the right about its up axis.

        Parameters
        ----------
        angle : float
            The angle (radians), as for :meth:`Camera.rotated`.
        degrees : float
            The angle in degrees, instead of ``angle``.

        Raises
        ------
        CameraError
            For both angles or neither, or one that is not a finite number.
        """
        camera = self.camera.rotated(rotation(angle, degrees), "up")
        return TangentialReformation(self._renderer, self._vessel, camera, self._smoothing, self._given)

    def _edges(self) -> dict[str, str]:
        """Return the sides of the patient at the edges."""
        return dict(_lumencut.edge_letters(np.array(self.camera.right_axis), -np.array(self.camera.up)))


@dataclass(frozen=True)
class TangentialRequest(ReformationRequest):
    """The parameters of :func:`lumencut.cpr` in the mode ``"tangential"``."""

    kind, subject = "cpr", "CPR"
    stored = ("smoothing",)

    camera: Camera | None = None
    slab: SlabArgument = None
    smoothing: float = 0.0
    settings: Settings | None = None

    def of(self, renderer: Renderer, vessel: Vessel) -> TangentialReformation:
        """Return the tangential CPR of a vessel in the scene and window of a renderer."""
        self._check_camera(self.camera)
        self._volume(renderer, vessel)
        view = self.camera or Camera.anterior(VesselTree([vessel]))
        smooth = self.checked()["smoothing"]
        return TangentialReformation(renderer, vessel, view, smooth, flat_settings(self.settings, self.slab))
