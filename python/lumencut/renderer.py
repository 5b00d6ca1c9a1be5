"""Renderers: one scene, any number of views."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

import numpy as np

from lumencut import _lumencut
from lumencut.camera import Camera
from lumencut.errors import CameraError, SettingsError, VesselTreeError, VolumeError
from lumencut.frame import Frame
from lumencut.settings import Settings, Window
from lumencut.vessel_tree import VesselTree
from lumencut.volume import Volume


class Renderer:
    """Renders views of one volume and one vessel tree.

    What does not depend on the view is made once; a further view allocates nothing of the size of the volume
    or the tree. Views may be rendered from several threads; they take turns.

    Parameters
    ----------
    volume : Volume, or an image of SimpleITK, itk, nibabel or vtk, or None
        The angiography; without it only :meth:`cut_surface` works.
    tree : VesselTree
        Its centerlines.
    device : {"auto", "cpu"}, default "auto"
        Where to compute.

    Raises
    ------
    VolumeError, VesselTreeError, SettingsError
        For a volume, tree or device of another kind, or a tree that lies wholly outside the volume.
    """

    def __init__(self, volume: Any, tree: VesselTree, device: Literal["auto", "cpu"] = "auto") -> None:
        if not isinstance(tree, VesselTree):
            raise VesselTreeError(
                "tree", f"{type(tree).__name__}", "a VesselTree, such as read_centerlines returns"
            )
        if not (isinstance(device, str) and device in ("auto", "cpu")):
            raise SettingsError("device", repr(device), "'auto' or 'cpu'")
        self.volume = None if volume is None else as_volume(volume)
        self.tree = tree
        if self.volume is not None:
            _check_meeting(self.volume, tree)
        self._core = _lumencut.Renderer(tree._arrays())
        self._window: Window | None = None

    def render(self, camera: Camera | None = None, settings: Settings | None = None) -> Frame:
        """Return the picture of one view.

        Parameters
        ----------
        camera : Camera, optional
            The view; from the front, fitted to the tree, where not given.
        settings : Settings, optional
            The knobs; their defaults where not given.

        Raises
        ------
        VolumeError
            Without a volume.
        KeyboardInterrupt
            At Ctrl-C; the renderer can be used again.
        """
        if self.volume is None:
            raise VolumeError(
                "volume of the renderer", "None", "a volume to show", "use cut_surface for depth alone"
            )
        camera, settings = self._view(camera, settings)
        if settings.window is None:
            settings = replace(settings, window=self.window)
        return _frame(camera, self._core.render(self.volume, camera, settings))

    def cut_surface(self, camera: Camera | None = None, settings: Settings | None = None) -> Frame:
        """Return depth, vessel and distance of one view, without reading the volume."""
        camera, settings = self._view(camera, settings)
        return _frame(camera, self._core.render(None, camera, settings))

    def _view(self, camera: Camera | None, settings: Settings | None) -> tuple[Camera, Settings]:
        """The camera and the settings, or their defaults."""
        if not isinstance(camera, (Camera, type(None))):
            raise CameraError("camera", type(camera).__name__, "a Camera or None")
        if not isinstance(settings, (Settings, type(None))):
            raise SettingsError("settings", type(settings).__name__, "Settings or None")
        return camera or Camera.anterior(self.tree), settings or Settings()

    @property
    def window(self) -> Window:
        """The window that :meth:`render` uses where the settings name none; see :meth:`Window.from_data`."""
        if self._window is None:
            if self.volume is None:
                raise VolumeError("volume of the renderer", "None", "a volume to take the window from")
            self._window = Window.from_data(self.volume, self.tree)
        return self._window


def render(
    volume: Any, tree: VesselTree, camera: Camera | None = None, settings: Settings | None = None
) -> Frame:
    """Return the picture of one view of an angiography and its centerlines.

    Parameters
    ----------
    volume : Volume, or an image of SimpleITK, itk, nibabel or vtk
        The angiography.
    tree : VesselTree
        Its centerlines.
    camera : Camera, optional
        The view; from the front, fitted to the tree, where not given.
    settings : Settings, optional
        The knobs; their defaults, with a window from the data along the centerlines, where not given.
    """
    return Renderer(volume, tree).render(camera, settings)


def as_volume(image: Any) -> Volume:
    """Return ``image`` as a volume; see :func:`lumencut.volume_files.memory.as_volume`."""
    if isinstance(image, Volume):
        return image
    from lumencut.volume_files.memory import as_volume as from_memory

    return from_memory(image)


def _check_meeting(volume: Volume, tree: VesselTree) -> None:
    from lumencut.centerlines import check_space_once

    points = tree.points
    if not volume.contains(points).any():
        low, high = np.round(tree.bounds, 1).tolist()
        box = np.round([volume.corners.min(axis=0), volume.corners.max(axis=0)], 1).tolist()
        found = f"none of its {len(points)} points inside the volume (points from {low} to {high} mm)"
        flipped = volume.contains(points * (-1, -1, 1)).sum()
        mend = f'{flipped} points would be inside as RAS: read them with coordinates="ras"' if flipped else ""
        raise VesselTreeError("vessel tree", found, f"points within {box[0]} to {box[1]} mm", mend)
    check_space_once(tree, volume)


def _frame(camera: Camera, buffers: dict[str, Any]) -> Frame:
    own: dict[str, Any] = {name: buffers[name] for name in ("depth", "vessel", "distance", "timings")}
    own |= {f"_{name}": buffers.get(name) for name in ("image", "value")}
    return Frame(camera, **own)
