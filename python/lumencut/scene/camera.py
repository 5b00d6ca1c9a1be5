"""The orthographic camera: its position and direction in world space, and its number of pixels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, field
from typing import Any, Literal, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import integers, number, numbers
from lumencut.base.pickles import by_name
from lumencut.base.values import Value, content_of
from lumencut.errors import CameraError, VesselTreeError
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

#: The six views of the body: direction from the viewer into the scene, and up (LPS).
VIEWS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = _lumencut.VIEWS

Scene: TypeAlias = VesselTree | Vessel | Volume | Any


@by_name
@dataclass(frozen=True, eq=False)
class Camera(Value):
    """An orthographic view; two cameras are equal if position, directions and pixels are equal.

    Parameters
    ----------
    center : array_like, shape (3,)
        The world point (mm, LPS) in the middle of the image, at depth 0; rotations turn about this point.
    direction : array_like, shape (3,)
        The direction from the viewer into the scene; a vector of any length.
    up : array_like, shape (3,)
        The upward direction in the image; not parallel to ``direction``, and made perpendicular to it.
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

    def _content(self) -> tuple[Any, ...]:
        vectors = (self.center, self.direction, self.up, self.right_axis)
        return (*map(content_of, vectors), self.size, self.pixel_spacing)

    def _set(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)

    def _moved(self, place: dict[str, Any]) -> Camera:
        """Return the camera at another position; its unit axes are copied without normalising them again."""
        moved = copy(self)
        moved._set("pixel_spacing", place["pixel_spacing"])
        for name in ("center", "direction", "right_axis", "up"):
            moved._set(name, numbers(CameraError, name, place[name], (3,)))
        return moved

    @classmethod
    def fitted(
        cls,
        scene: Scene,
        direction: npt.ArrayLike,
        up: npt.ArrayLike,
        size: tuple[int, int] = (512, 512),
    ) -> Camera:
        """Return the view along ``direction`` with the largest scale at which all of ``scene`` is visible.

        Parameters
        ----------
        scene : VesselTree, Vessel, Volume, or anything :func:`lumencut.render` takes as a volume
            The objects to fit: ``tree["LAD"]`` zooms to one vessel.
        direction : array_like, shape (3,)
            The direction from the viewer into the scene; a vector of any length.
        up : array_like, shape (3,)
            The upward direction in the image.
        size : (int, int), default (512, 512)
            Width and height (pixels).

        Raises
        ------
        CameraError
            For a scene of an unsupported type, or an invalid vector or size.
        VolumeError
            For an image that is not a volume, such as one of several time points.
        """
        points = scene_points(scene)
        ahead = numbers(CameraError, "direction of the camera", direction, (3,))
        view = cls(np.zeros(3), ahead, numbers(CameraError, "up of the camera", up, (3,)), size)
        return view._moved(_lumencut.fitted(view, points))

    @classmethod
    def named(cls, name: str, scene: Scene, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view with this name, one of :data:`VIEWS`."""
        if not (isinstance(name, str) and name in VIEWS):
            raise CameraError("name of the view", repr(name), "one of " + ", ".join(VIEWS))
        return cls.fitted(scene, *VIEWS[name], size)

    @classmethod
    def anterior(cls, scene: Scene, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from the front; the patient's left is on the right of the image."""
        return cls.named("anterior", scene, size)

    @classmethod
    def posterior(cls, scene: Scene, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from behind."""
        return cls.named("posterior", scene, size)

    @classmethod
    def left(cls, scene: Scene, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from the patient's left."""
        return cls.named("left", scene, size)

    @classmethod
    def right(cls, scene: Scene, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from the patient's right."""
        return cls.named("right", scene, size)

    @classmethod
    def superior(cls, scene: Scene, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from above, the patient's front on top."""
        return cls.named("superior", scene, size)

    @classmethod
    def inferior(cls, scene: Scene, size: tuple[int, int] = (512, 512)) -> Camera:
        """Return the fitted view from below, the patient's front on top, as axial slices are shown."""
        return cls.named("inferior", scene, size)

    @classmethod
    def about(
        cls,
        vessel: Vessel,
        at: float,
        angle: float | None = None,
        *,
        degrees: float | None = None,
        size: tuple[int, int] = (512, 512),
    ) -> Camera:
        """Return the view centred on a point of a vessel, with the vessel running upwards.

        Each angle shows another diameter of the vessel at that point. The picture extends eight radii of the
        vessel to each side (8 mm if its radius is unknown).

        Parameters
        ----------
        vessel : Vessel
            The vessel, such as ``tree["LAD"]``.
        at : float
            The arc length of the point (mm from the vessel's first point).
        angle : float, default 0
            How far the viewer moves about the vessel (radians), with the sign of :meth:`rotated` about "up".
            Of all these views, 0 is the one nearest to the anterior view with the head up.
        degrees : float
            The angle in degrees, instead of ``angle``.
        size : (int, int), default (512, 512)
            Width and height (pixels).

        Raises
        ------
        CameraError
            For an invalid vessel, a point beyond its ends, both angles, or an infinite angle.
        VesselTreeError
            For a vessel without length.
        """
        if not isinstance(vessel, Vessel):
            raise CameraError("vessel of the view", type(vessel).__name__, "a Vessel, such as tree['LAD']")
        turn = 0.0 if angle is None and degrees is None else _radians(angle, degrees)
        ahead, up = map(np.array, VIEWS["anterior"])
        view = cls(np.zeros(3), ahead, up, size)
        place = number(CameraError, "place of the view", at)
        return view._moved(_lumencut.about((vessel.points, vessel.radius), place, turn, view.size))

    @classmethod
    def refocused(
        cls,
        tree: VesselTree,
        vessel: Vessel | SupportsIndex | str,
        size: tuple[int, int] = (512, 512),
        *,
        start: Camera | None = None,
    ) -> Camera:
        """Return the view that shows most of a vessel, fitted to everything within two radii of the vessel.

        Of 256 directions all around, it has the largest projected length of the vessel; parts hidden behind
        the vessel itself do not count. A direction opposite to ``start`` is penalised by a fifth of the
        vessel's length.

        Parameters
        ----------
        tree : VesselTree
            The vessels.
        vessel : Vessel, int or str
            The vessel, or its id or name in the tree.
        size : (int, int), default (512, 512)
            Width and height (pixels).
        start : Camera, optional
            The previous view; by default the anterior one.

        Raises
        ------
        VesselTreeError
            For an id or a name that no vessel has (the error lists similar ones), or a vessel without length.
        """
        if not (start is None or isinstance(start, Camera)):
            raise CameraError("start (the view before)", type(start).__name__, "a Camera or None")
        if not isinstance(tree, VesselTree):
            raise VesselTreeError("vessel tree", type(tree).__name__, "a VesselTree")
        chosen = vessel if isinstance(vessel, Vessel) else tree[tree._id(vessel)]
        ahead = np.array(VIEWS["anterior"][0]) if start is None else start.direction
        view = cls(np.zeros(3), ahead, np.array(upright(ahead)), size)
        return view._moved(_lumencut.refocused(view, (chosen.points, chosen.radius)))

    def rotated(
        self,
        angle: float | None = None,
        axis: Literal["up", "right", "direction"] | npt.ArrayLike = "up",
        *,
        degrees: float | None = None,
    ) -> Camera:
        """Return the view turned about its center.

        Parameters
        ----------
        angle : float
            Angle (radians), counterclockwise as seen against the axis.
        axis : {"up", "right", "direction"} or array_like of shape (3,), default "up"
            An axis of the view, or a vector in world space (LPS).
        degrees : float
            The angle in degrees, instead of ``angle``.

        Raises
        ------
        CameraError
            For both angles or none, an angle that is not a number, or an axis that is not a direction.
        """
        about = checked_axis(axis, ("up", "right", "direction"))
        return self._moved(_lumencut.rotated(self, _radians(angle, degrees), about))

    def zoomed(self, factor: float) -> Camera:
        """Return the view magnified by ``factor`` about its center."""
        checked = number(CameraError, "factor of the zoom", factor)
        if not (np.isfinite(checked) and checked > 0):
            raise CameraError("factor of the zoom", f"{factor}", "a number above 0")
        return self._moved(_lumencut.zoomed(self, checked))

    def panned(self, right: float, up: float) -> Camera:
        """Return the view moved within its plane, to the right by ``right`` and upwards by ``up`` (mm)."""
        shift = [number(CameraError, "shift of the camera", value) for value in (right, up)]
        if not np.isfinite(shift).all():
            raise CameraError("shift of the camera", f"{shift}", "finite distances in mm")
        return self._moved(_lumencut.panned(self, *shift))

    def project(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return the pixels and depths of world points.

        This inverts ``Frame.position``: a point that a frame shows in row j and column i is projected to
        (i, j) and the depth there.

        Parameters
        ----------
        points : array_like, shape (n, 3) or (3,)
            World points (mm, LPS).

        Returns
        -------
        numpy.ndarray, shape (n, 3)
            For each point its column and its row (pixels, with fractions), and its depth (mm), which grows
            away from the viewer and is 0 at the camera's center. Pixel centres have integer coordinates; the
            first one is at (0, 0), so the image extends from -0.5 to width - 0.5 and height -
            0.5. Points outside the image are projected too.

        Raises
        ------
        CameraError
            For points of another shape, or with coordinates that are not numbers.
        """
        try:
            shape = (3,) if np.ndim(points) == 1 else (-1, 3)
        except ValueError:  # lists of several lengths
            shape = (-1, 3)
        offset = numbers(CameraError, "points to project", points, shape).reshape(-1, 3) - self.center
        width, height = self.size
        column = offset @ self.right_axis / self.pixel_spacing + (width - 1) / 2
        row = (height - 1) / 2 - offset @ self.up / self.pixel_spacing
        return np.stack([column, row, offset @ self.direction], axis=1)


def _radians(angle: float | None, degrees: float | None) -> float:
    """Return the angle of a rotation in radians; it is given either in radians or in degrees."""
    if (angle is None) == (degrees is None):
        found = "neither" if angle is None else "an angle in radians and one in degrees"
        raise CameraError("angle of the rotation", found, "one of angle= (radians) and degrees=")
    if degrees is not None:
        return math.radians(number(CameraError, "degrees of the rotation", degrees))
    return number(CameraError, "angle of the rotation", angle)


def upright(direction: Sequence[float] | npt.NDArray[np.float64]) -> tuple[float, float, float]:
    """Return the up vector of a view along ``direction``, shape (3,).

    Up is towards the head; if the view runs along the body, up is towards the patient's front.
    """
    across = math.hypot(direction[0], direction[1])
    return (0.0, 0.0, 1.0) if across > 0.05 * abs(direction[2]) else (0.0, -1.0, 0.0)


def scene_points(scene: Scene) -> npt.NDArray[np.float64]:
    """Return the points (mm, LPS) that a view must contain to show all of ``scene``, shape (n, 3)."""
    if isinstance(scene, (VesselTree, Vessel)):
        return scene.points
    from lumencut.scene.images import as_volume, is_image

    if not is_image(scene):
        found = (
            f"a bare array of shape {scene.shape}" if isinstance(scene, np.ndarray) else type(scene).__name__
        )
        raise CameraError(
            "scene of the view", found, "a VesselTree, a Vessel, a Volume or an image that render takes"
        )
    return as_volume(scene).corners


def checked_axis(axis: Any, names: tuple[str, ...]) -> str | npt.NDArray[np.float64]:
    """Return ``axis`` if it is one of the names; otherwise return it as a vector of shape (3,)."""
    if isinstance(axis, str) and axis in names:
        return axis
    return numbers(CameraError, "axis of the rotation", axis, (3,))
