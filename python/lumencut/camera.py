"""The orthographic camera: where the view lies in world space and how many pixels it has."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut._checks import integers, number, numbers
from lumencut.errors import CameraError
from lumencut.vessel_tree import VesselTree
from lumencut.volume import Volume

#: The six views of the body: direction from the viewer into the scene, and up (LPS).
VIEWS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = {
    "anterior": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "posterior": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "left": ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "right": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "superior": ((0.0, 0.0, -1.0), (0.0, -1.0, 0.0)),
    "inferior": ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),
}

#: What a fitted view leaves free on each side, as a fraction of the image.
_MARGIN = 0.06


@dataclass(frozen=True, eq=False)
class Camera:
    """An orthographic view.

    Parameters
    ----------
    center : array_like, shape (3,)
        The world point (mm, LPS) in the middle of the image at depth 0; rotations turn about it.
    direction : array_like, shape (3,)
        From the viewer into the scene; any length.
    up : array_like, shape (3,)
        Upwards in the image; need not be perpendicular to the direction, but not parallel to it.
    size : (int, int), default (512, 512)
        Width and height (pixels), 1 to 32768.
    pixel_spacing : float, default 1.0
        Side of a pixel (mm).

    Attributes
    ----------
    right_axis : numpy.ndarray, shape (3,)
        Unit vector to the right in the image; direction and up are made unit vectors perpendicular to it.

    Raises
    ------
    CameraError
        For vectors that are zero, parallel or not finite, or sizes out of range.
    """

    center: npt.NDArray[np.float64]
    direction: npt.NDArray[np.float64]
    up: npt.NDArray[np.float64]
    size: tuple[int, int] = (512, 512)
    pixel_spacing: float = 1.0
    right_axis: npt.NDArray[np.float64] = field(init=False)

    def __post_init__(self) -> None:
        for name in ("center", "direction", "up"):
            self._set(name, numbers(CameraError, f"{name} of the camera", getattr(self, name), (3,)))
        self._set("size", integers(CameraError, "size of the camera", self.size, 1, 32768, 2))
        self._set("pixel_spacing", number(CameraError, "pixel_spacing of the camera", self.pixel_spacing))
        for name, vector in zip(("direction", "right_axis", "up"), _lumencut.check_camera(self), strict=True):
            self._set(name, numbers(CameraError, name, vector, (3,)))

    def _set(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)

    @classmethod
    def fitted(
        cls,
        scene: VesselTree | Volume,
        direction: npt.ArrayLike,
        up: npt.ArrayLike,
        size: tuple[int, int] = (512, 512),
    ) -> Camera:
        """Return the view along ``direction`` in which all of ``scene`` just fits into ``size`` pixels."""
        if not isinstance(scene, (VesselTree, Volume)):
            raise CameraError("scene of the view", type(scene).__name__, "a VesselTree or a Volume")
        points = scene_points(scene)
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        ahead = numbers(CameraError, "direction of the camera", direction, (3,))
        view = cls(middle, ahead, numbers(CameraError, "up of the camera", up, (3,)), size, 1.0)
        flat = (points - middle) @ np.stack([view.right_axis, view.up]).T
        low, high = flat.min(axis=0), flat.max(axis=0)
        center = middle + (low + high) / 2 @ np.stack([view.right_axis, view.up])
        free = np.asarray(view.size) * (1 - 2 * _MARGIN)
        spacing = max(float(((high - low) / free).max()), 1e-3)
        return replace(view, center=center, pixel_spacing=spacing)

    @classmethod
    def named(cls, name: str, scene: VesselTree | Volume, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view of this name, one of :data:`VIEWS`."""
        if not (isinstance(name, str) and name in VIEWS):
            raise CameraError("name of the view", repr(name), "one of " + ", ".join(VIEWS))
        return cls.fitted(scene, *VIEWS[name], size)

    @classmethod
    def anterior(cls, scene: VesselTree | Volume, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from the front; the patient's left is on the right of the image."""
        return cls.named("anterior", scene, size)

    @classmethod
    def posterior(cls, scene: VesselTree | Volume, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from behind."""
        return cls.named("posterior", scene, size)

    @classmethod
    def left(cls, scene: VesselTree | Volume, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from the patient's left."""
        return cls.named("left", scene, size)

    @classmethod
    def right(cls, scene: VesselTree | Volume, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from the patient's right."""
        return cls.named("right", scene, size)

    @classmethod
    def superior(cls, scene: VesselTree | Volume, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from above, the patient's front on top."""
        return cls.named("superior", scene, size)

    @classmethod
    def inferior(cls, scene: VesselTree | Volume, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from below, the patient's front on top, as axial slices are shown."""
        return cls.named("inferior", scene, size)

    def rotated(
        self, angle: float, axis: Literal["up", "right", "direction"] | npt.ArrayLike = "up"
    ) -> Camera:
        """Return the view turned about its center.

        Parameters
        ----------
        angle : float
            Angle (radians), counterclockwise as seen against the axis.
        axis : {"up", "right", "direction"} or array_like of shape (3,), default "up"
            An axis of the view, or a vector in world space (LPS).
        """
        own = {"up": self.up, "right": self.right_axis, "direction": self.direction}
        vector = own.get(axis, axis) if isinstance(axis, str) else axis
        angle = number(CameraError, "angle of the rotation", angle)
        turn = _rotation(numbers(CameraError, "axis of the rotation", vector, (3,)), angle)
        return replace(self, direction=turn @ self.direction, up=turn @ self.up)

    def zoomed(self, factor: float) -> Camera:
        """Return the view magnified by ``factor`` about its center."""
        checked = number(CameraError, "factor of the zoom", factor)
        if not (np.isfinite(checked) and checked > 0):
            raise CameraError("factor of the zoom", f"{factor}", "a number above 0")
        return replace(self, pixel_spacing=self.pixel_spacing / checked)

    def panned(self, right: float, up: float) -> Camera:
        """Return the view moved by ``right`` and ``up`` (mm) in its plane."""
        shift = [number(CameraError, "shift of the camera", value) for value in (right, up)]
        if not np.isfinite(shift).all():
            raise CameraError("shift of the camera", f"{shift}", "finite distances in mm")
        return replace(self, center=self.center + shift[0] * self.right_axis + shift[1] * self.up)


def scene_points(scene: VesselTree | Volume) -> npt.NDArray[np.float64]:
    """Return the points (mm, LPS) that a view shows all of when it shows all of ``scene``, shape (n, 3)."""
    return scene.points if isinstance(scene, VesselTree) else scene.corners


def _rotation(axis: npt.NDArray[np.float64], angle: float) -> npt.NDArray[np.float64]:
    """Rotation matrix by Rodrigues' formula."""
    largest = float(np.abs(axis).max())
    if not (np.isfinite(angle) and 0 < largest < np.inf):
        raise CameraError(
            "rotation of the camera", f"angle {angle} about {axis.tolist()}", "a finite angle and axis"
        )
    x, y, z = (axis / largest) / np.linalg.norm(axis / largest)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)
