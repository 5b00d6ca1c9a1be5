"""Turns about a place on a vessel, and the diameter that each view of them cuts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.errors import VolumeError
from lumencut.pictures.lettering import SMALLEST_SIDE, Sheet
from lumencut.pictures.turntables import turntable

if TYPE_CHECKING:
    from lumencut.pictures.frame import Frame
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel import Vessel
    from lumencut.scene.volume import Volume


def turn_about(
    renderer: Renderer,
    camera: Camera,
    radius: float,
    settings: Settings | None = None,
    frames: int = 72,
    degrees: float = 360.0,
) -> Iterator[Frame]:
    """Render a turn about the place of a :meth:`Camera.about`, with the diameters written on each frame.

    Parameters
    ----------
    renderer : Renderer
        The scene.
    camera : Camera
        The first view.
    radius : float
        The radius of the vessel at the place (mm), from :func:`radius_at`.
    settings : Settings, optional
        The settings; defaults if omitted.
    frames : int, default 72
        Number of frames.
    degrees : float, default 360
        Total rotation of the viewer (degrees).

    Raises
    ------
    VolumeError
        For a renderer without a volume.

    Yields
    ------
    Frame
        The next view. Its picture says the diameter of this cut, and the least and the largest so far (mm).
    """
    if renderer.volume is None:
        raise VolumeError("turn about a place", "no volume", "an angiography, to measure diameters")
    turn = turntable(renderer, camera, settings, frames, degrees, "up")
    return _written(turn, renderer.volume, radius)


def radius_at(vessel: Vessel, at: float) -> float:
    """Return the radius of a vessel (mm) at an arc length (mm); 1 mm if unknown."""
    return _lumencut.radius_at((vessel.points, vessel.radius), at)


def cut_diameter(volume: Volume, camera: Camera, radius: float) -> float:
    """Return the diameter of a vessel (mm) in the cut of a view about a place; NaN without two walls.

    It is measured along the line through the camera's center to the right: within the lumen the line lies in
    the cut, and no other vessel of the picture lies on it unless it touches this one. On each side the wall
    is where values first pass halfway between the lumen (their median within half a radius of the middle) and
    the value within three radii that differs from it most towards the tissue. A wall beyond 1.5 radii would
    belong to a touching vessel: the diameter is then NaN, too.

    Parameters
    ----------
    volume : Volume
        The angiography.
    camera : Camera
        The view, whose center is the place and whose up axis is the direction of the vessel.
    radius : float
        The approximate radius of the vessel (mm).
    """
    return _lumencut.cut_diameter(volume, camera, radius)


def _written(turn: Iterable[Frame], volume: Volume, radius: float) -> Iterator[Frame]:
    """Yield the frames with the diameters written into the lower right corner."""
    seen: list[float] = []
    for frame in turn:
        diameter = cut_diameter(volume, frame.camera, radius)
        if np.isfinite(diameter):
            seen.append(diameter)
        yield replace(frame, _image=_with_diameters(frame.image, diameter, seen))


def _with_diameters(
    image: npt.NDArray[np.uint8], diameter: float, seen: list[float]
) -> npt.NDArray[np.uint8]:
    if min(image.shape[:2]) < SMALLEST_SIDE:
        return image
    sheet = Sheet(image)
    lines = [f"this cut {_millimetres(diameter)}"]
    if seen:
        lines += [f"least so far {_millimetres(min(seen))}", f"largest so far {_millimetres(max(seen))}"]
    width, height = sheet.size
    for number, line in enumerate(reversed(lines)):
        place = (width - sheet.margin, height - sheet.margin - number * sheet.line_height)
        sheet.write(line, place, "rd")
    return sheet.pixels()


def _millimetres(length: float) -> str:
    return f"{length:.1f} mm" if np.isfinite(length) else "not seen"
