"""Orientation of a view relative to the patient: the sides at its edges, and its name."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut

if TYPE_CHECKING:
    from lumencut.scene.camera import Camera

#: Angles that differ by less than this (degrees) are equal in the name of a view.
_SAME_ANGLE = 0.5


def sides(vector: npt.NDArray[np.float64]) -> str:
    """Return the letters of the sides of the patient that a vector (LPS) points to, the main one first.

    R and L are right and left, A and P anterior and posterior, S and I superior and inferior. Parts of the
    unit vector below 0.2 are not named.
    """
    return _lumencut.sides(np.asarray(vector, dtype=np.float64))


def edges(camera: Camera) -> dict[str, str]:
    """Return the sides of the patient that lie at the left, right, top and bottom edge of a view."""
    return dict(_lumencut.edge_letters(camera.right_axis, -camera.up))


def view_name(camera: Camera) -> str:
    """Return the name of a view.

    A view along an axis of the patient has its name, such as ``anterior``. All others are named by the angles
    of a C-arm with the same view: how far the viewer stands to the left (LAO) or right (RAO) of the patient's
    front, and how far towards the head (CRA) or the feet (CAU). These are the positioner angles of DICOM, in
    whole degrees; LAO and RAO go up to 180 degrees, at the patient's back. Where the head, or the front in
    views along the body, is not on top, the view is turned in its plane, by that many degrees
    counterclockwise.
    """
    from lumencut.scene.camera import VIEWS

    named = (name for name, (ahead, _) in VIEWS.items() if _angle(camera.direction, ahead) < _SAME_ANGLE)
    name = next(named, None)
    top = VIEWS["anterior" if name is None else name][1]
    # Direction of the head in the picture, counterclockwise from the top.
    turned = _whole_degrees(-np.dot(top, camera.right_axis), np.dot(top, camera.up))
    return (name or c_arm_angles(camera)) + (f" turned {turned}°" if turned else "")


def c_arm_angles(camera: Camera) -> str:
    """Return the angles at which a C-arm has the same view, "anterior" if both are 0."""
    viewer = -camera.direction
    to_the_left = _whole_degrees(viewer[0], -viewer[1])
    to_the_head = _whole_degrees(viewer[2], math.hypot(viewer[0], viewer[1]))
    parts = ((to_the_left, "LAO", "RAO"), (to_the_head, "CRA", "CAU"))
    words = [
        f"{above if degrees > 0 else below} {abs(degrees)}°" for degrees, above, below in parts if degrees
    ]
    return " ".join(words) or "anterior"


def _whole_degrees(opposite: float, adjacent: float) -> int:
    """Return the angle in whole degrees, from -179 to 180."""
    degrees = round(math.degrees(math.atan2(opposite, adjacent)))
    return 180 if degrees == -180 else degrees


def _angle(first: npt.NDArray[np.float64], other: tuple[float, float, float]) -> float:
    """Return the angle (degrees) between two vectors."""
    second = np.array(other)
    across, along = np.linalg.norm(np.cross(first, second)), np.dot(first, second)
    return math.degrees(math.atan2(across, along))
