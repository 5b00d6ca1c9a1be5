"""Flights: the view moves smoothly from one camera to another."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lumencut import _lumencut
from lumencut.base.checks import integers
from lumencut.errors import CameraError
from lumencut.pictures.turntables import MOST_FRAMES

if TYPE_CHECKING:
    from lumencut.pictures.frame import Frame
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings


def flight(
    renderer: Renderer,
    start: Camera,
    end: Camera,
    settings: Settings | None = None,
    frames: int = 36,
) -> Iterator[Frame]:
    """Render a flight from one view to another, one frame at a time.

    The speed is 0 at both ends. The view turns by the shortest rotation, in proportion to the distance
    covered, and the pixel spacing changes by equal factors over equal distances.

    Parameters
    ----------
    renderer : Renderer
        The scene.
    start, end : Camera
        The first and the last view, with equal sizes; the end may be ``Camera.refocused(tree, "LAD", size,
        start=start)``.
    settings : Settings, optional
        The settings; defaults if omitted.
    frames : int, default 36
        Number of frames, at least 2.

    Yields
    ------
    Frame
        The next view.

    Raises
    ------
    CameraError
        For invalid cameras, cameras of different sizes, or fewer than two frames.
    """
    from lumencut.pictures.renderer import check_renderer

    check_renderer(renderer)
    for view in flight_views(start, end, frames):
        yield renderer.render(view, settings)


def flight_views(start: Camera, end: Camera, frames: int) -> list[Camera]:
    """Return the views of a flight; parameters and errors are those of :func:`flight`."""
    from lumencut.scene.camera import Camera

    for view in (start, end):
        if not isinstance(view, Camera):
            raise CameraError("view of the flight", type(view).__name__, "a Camera")
    (count,) = integers(CameraError, "frames of the flight", [frames], 2, MOST_FRAMES, 1)
    return [start, *(start._moved(place) for place in _lumencut.flight(start, end, count)), end]
