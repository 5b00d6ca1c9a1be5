"""The scene of a notebook: a volume with its vessels, and what clicks on its pictures mean."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.errors import VolumeError
from lumencut.pictures.frame import Frame
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.checked_settings import checked
from lumencut.scene.picking import brightest
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.window import Window

Point = npt.NDArray[np.float64]
DeviceName = Literal["auto", "cpu", "gpu"]


@dataclass(frozen=True)
class Place:
    """A place on a vessel: its id in the tree, and the arc length (mm)."""

    vessel: int
    at: float


@dataclass(frozen=True)
class Pick:
    """The world point of a pixel (mm, LPS), and the nearest place on its vessel."""

    point: Point
    place: Place | None


class Scene:
    """A volume, with or without vessels.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography.
    tree : VesselTree or None
        Its centerlines.
    device : {"auto", "cpu", "gpu"}
        The device that computes.
    profiles : iterable of Profile, or of (Profile, iterable of Stenosis), default ()
        What the setting ``rim`` shows.

    Raises
    ------
    VolumeError, VesselTreeError, SettingsError, MeasuringError, DeviceError
        As :class:`lumencut.Renderer`, and for no volume.
    """

    def __init__(
        self,
        volume: Any,
        tree: VesselTree | None,
        device: DeviceName,
        profiles: Iterable[Any] = (),
    ) -> None:
        if volume is None:
            raise VolumeError("volume of the notebook", "None", "a Volume, such as read_volume returns")
        self.device: DeviceName = device
        self._use(Renderer(volume, tree, device, profiles=profiles))

    def _use(self, renderer: Renderer) -> None:
        assert renderer.volume is not None
        self.renderer, self.volume, self.tree = renderer, renderer.volume, renderer.tree

    def with_tree(self, tree: VesselTree | None) -> Scene:
        """Return the same volume with another tree; errors as :meth:`Renderer.with_tree`."""
        other = object.__new__(Scene)
        other.device = self.device
        other._use(self.renderer.with_tree(tree))
        return other

    def window(self, settings: Settings) -> Window:
        """Return the window of a picture with these settings; without a tree, that of the context."""
        used = self.renderer.windowed(settings)
        window = used.context_window if self.tree is None else used.window
        assert isinstance(window, Window)
        return window

    def with_window(self, settings: Settings, window: Window | str | None) -> Settings:
        """Return the settings with another window."""
        if self.tree is None:
            return replace(settings, context_window=window)
        return replace(settings, window=window)

    def moving(
        self, camera: Camera, settings: Settings, progress: Callable[[int, int], object] | None = None
    ) -> Frame:
        """Return a view with only the picture, for fast movement."""
        quick = replace(settings, samples=1, edge_samples=1, context_preview=True)
        return self.renderer.render(camera, quick, images=["image"], progress=progress)

    def picked(self, camera: Camera, settings: Settings, pixel: tuple[float, float]) -> Pick:
        """Return the place that a pixel (column, row) of a view shows.

        It is a point of the cut surface (``Frame.position``) or, without a cut surface, the brightest place
        on the ray, as in the viewer.

        Raises
        ------
        TracingError
            For a ray that misses the volume and the cut surface.
        """
        width, height = camera.size
        column = min(max(round(pixel[0]), 0), width - 1)
        row = min(max(round(pixel[1]), 0), height - 1)
        if self.tree is None or not self._shows_cut(camera, settings, (column, row)):
            return self.at(brightest(self.volume, camera, pixel), camera.pixel_spacing)
        plain = replace(settings, samples=1)
        frame = self.renderer.render(camera, plain, images=["depth", "vessel"])
        point = frame.position[row, column]
        return Pick(point, self._place(int(frame.vessel[row, column]), point, camera.pixel_spacing))

    def _shows_cut(self, camera: Camera, settings: Settings, pixel: tuple[float, float]) -> bool:
        """Return whether the pixel shows the cut surface."""
        if settings.focus is None:
            return True
        used = checked(self.renderer._choosing(settings))
        return _lumencut.shows_cut(self.renderer._core, self.volume, camera, used, pixel)

    def at(self, point: Point, pixel_spacing: float) -> Pick:
        """Return a point with the nearest place of the first vessel that a click there may pick."""
        places = (self._place(vessel, point, pixel_spacing) for vessel in range(len(self.tree or ())))
        return Pick(point, next((place for place in places if place is not None), None))

    def _place(self, vessel: int, point: Point, pixel_spacing: float) -> Place | None:
        """Return the place on a vessel if the click is close enough to it."""
        if self.tree is None or vessel < 0:
            return None
        at, is_meant = self._nearest(vessel, point, pixel_spacing)
        return Place(vessel, at) if is_meant else None

    def nearest(self, vessel: int, point: Point) -> Place:
        """Return the place on a vessel that is nearest to a point, however far it is."""
        return Place(vessel, self._nearest(vessel, point, 1.0)[0])

    def _nearest(self, vessel: int, point: Point, pixel_spacing: float) -> tuple[float, bool]:
        assert self.tree is not None
        line = self.tree[vessel]
        coordinates = tuple(float(value) for value in point)
        return _lumencut.meant_place((line.points, line.radius), coordinates, pixel_spacing)
