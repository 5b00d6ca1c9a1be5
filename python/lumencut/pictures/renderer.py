"""Renderers: one scene, any number of views."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import callback, choice
from lumencut.errors import CameraError, SettingsError, VesselTreeError, VolumeError
from lumencut.pictures.along_vessels import AlongVessels
from lumencut.pictures.frame import BLEND, IMAGES, Frame
from lumencut.pictures.frame_source import FrameSource, VesselEnd, frame_source, vessel_ends
from lumencut.scene.camera import Camera
from lumencut.scene.checked_settings import checked
from lumencut.scene.device import look_for_no_display
from lumencut.scene.settings import Settings
from lumencut.scene.tree_windows import SceneWindows
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_names import id_or_name
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.view_extent import PartsInView
from lumencut.scene.volume import Volume
from lumencut.scene.window import Window

#: The images that need a window.
_WINDOWED = frozenset(("image", "context"))

_OF_CUT_SURFACE = ("depth", "vessel", "distance", *BLEND)


class Renderer:
    """Renders views of one volume and one vessel tree, or of a volume alone.

    Everything that does not depend on the view is computed once; a further view allocates nothing of the size
    of the volume or the tree, unless a renderer made by :meth:`with_tree` rendered in between. Views may be
    rendered from several threads; they take turns.

    The voxels must not be changed after the first view with a context: data derived from them are reused. For
    changed voxels create a new renderer.

    Parameters
    ----------
    volume : Volume, an image of SimpleITK, itk, nibabel or vtk, datasets of pydicom, or None
        The angiography; without it only :meth:`cut_surface` works.
    tree : VesselTree or None
        Its centerlines; without them :meth:`render` shows the context alone, all of the volume.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes. ``"auto"`` uses the first hardware GPU of :func:`lumencut.devices`, or the
        CPU if there is none; if the GPU fails, or lacks memory for the scene, the CPU renders that view and
        all further ones, with one :class:`DeviceWarning`. ``"gpu"`` uses the first GPU, even a software one,
        and raises its errors. Pictures differ only by rounding.
    profiles : iterable of Profile, or of (Profile, iterable of Stenosis), default ()
        What the setting ``rim`` shows: profiles of vessels of the tree, with their graded stenoses.

    Raises
    ------
    VolumeError, VesselTreeError, SettingsError
        For a volume, tree or device of another kind, neither a volume nor a tree, or a tree that lies wholly
        outside the volume.
    MeasuringError
        For profiles of other vessels.
    DeviceError
        For the device ``"gpu"`` where there is no GPU, or none that can be used.
    """

    def __init__(
        self,
        volume: Any,
        tree: VesselTree | None = None,
        device: Literal["auto", "cpu", "gpu"] = "auto",
        *,
        profiles: Iterable[Any] = (),
    ) -> None:
        _check_kind(tree)
        choice(SettingsError, "device", device, ("auto", "cpu", "gpu"))
        if volume is not None:
            from lumencut.scene.images import as_volume

            volume = as_volume(volume)
        self._set_scene(volume, tree, profiles)
        self._windows = SceneWindows(volume, tree)
        if device != "cpu":
            look_for_no_display()
        self._core = _lumencut.Renderer(None if tree is None else tree._arrays(), device)

    def _set_scene(
        self, volume: Volume | None, tree: VesselTree | None, profiles: Iterable[Any] = ()
    ) -> None:
        """Set the scene; it must not be empty, and tree and volume must overlap."""
        scene = volume if tree is None else tree
        if scene is None:
            raise VolumeError("scene of the renderer", "neither a volume nor a tree", "one of them or both")
        if volume is not None and tree is not None:
            from lumencut.scene.placement import check_meeting

            check_meeting(volume, tree)
        elif tree is not None:
            from lumencut.scene.line_doubts import check_lines_once

            check_lines_once(tree[:])
        self._volume, self._tree, self._scene = volume, tree, scene
        self._along = AlongVessels(tree, profiles)

    def with_tree(self, tree: VesselTree | None, *, profiles: Iterable[Any] = ()) -> Renderer:
        """Return a renderer of the same volume on the same device with another tree, or without one.

        Data of the volume are reused: on a GPU its voxels are not sent again, and if the settings name no
        window, that of this renderer is used, so that brightness does not change with the tree. Both
        renderers can be used; their views take turns. `profiles` are those of the other tree.

        Raises
        ------
        VesselTreeError
            For a tree of another kind, or one that lies wholly outside the volume.
        VolumeError
            For no tree where there is no volume either.
        """
        _check_kind(tree)
        other = object.__new__(Renderer)
        other._set_scene(self._volume, tree, profiles)
        return self._sharing(other)

    def _with_part(self, vessels: Iterable[Vessel]) -> Renderer:
        """Return a renderer of some vessels of the tree, which are not compared with the volume again."""
        tree = VesselTree(vessels)
        other = object.__new__(Renderer)
        other._volume, other._tree, other._scene = self._volume, tree, tree
        other._along = AlongVessels(tree, ())
        return self._sharing(other)

    def _sharing(self, other: Renderer) -> Renderer:
        """Share the device and the windows with another renderer of the same volume."""
        other._core = self._core.with_tree(None if other._tree is None else other._tree._arrays())
        other._windows = self._windows
        return other

    def __repr__(self) -> str:
        return f"Renderer({self._volume!r}, {self._tree!r}, on {self.device!r})"

    @property
    def volume(self) -> Volume | None:
        """The angiography."""
        return self._volume

    @property
    def tree(self) -> VesselTree | None:
        """Its centerlines."""
        return self._tree

    @property
    def device(self) -> str:
        """The device that computes: ``"cpu"``, or the name of the GPU as in :func:`lumencut.devices`."""
        return self._core.device

    @property
    def scene(self) -> VesselTree | Volume:
        """The object that views are fitted to: the tree, or the volume if there is no tree."""
        return self._scene

    def render(
        self,
        camera: Camera | None = None,
        settings: Settings | None = None,
        *,
        images: Iterable[str] | None = None,
        progress: Callable[[int, int], object] | None = None,
        before: Frame | None = None,
    ) -> Frame:
        """Return the picture of one view.

        Parameters
        ----------
        camera : Camera, optional
            The view; from the front, fitted to the tree or else the volume by default.
        settings : Settings, optional
            The settings; defaults if omitted. Without a tree those of the cut surface do nothing.
        images : iterable of str, optional
            The images that the frame is to have, of ``"image"``, ``"depth"``, ``"vessel"``, ``"distance"``,
            ``"value"`` and ``"context"``; all by default. On a GPU each omitted image saves its transfer.
            ``Frame.position`` needs the depth. The distance is computed at once if it is named here; by
            default ``Frame.distance`` may compute it on first use.
        progress : callable, optional
            Called with (done, total) about every 50 ms, and once at the end: how much of the view is
            rendered, in parts of which the total is always 1000. A GPU reports nothing before the end of each
            sample. An exception from it ends the rendering.
        before : Frame, optional
            The frame before in a turn, with its depth, for the setting ``turning_limit``.

        Raises
        ------
        VolumeError
            Without a volume.
        VesselTreeError
            For a name or an id in ``focus_vessels`` that no vessel has; the error lists near names.
        SettingsError
            For an image of another name, without a tree for settings without a context, or for a
            ``context_step`` too small for the volume.
        MeasuringError
            For a rim of values that the vessels do not have.
        DeviceError
            With the device ``"gpu"`` where the GPU fails or has no room; a further view starts it again.
        KeyboardInterrupt
            At Ctrl-C; the renderer can be used again.
        """
        if self._volume is None:
            raise VolumeError(
                "volume of the renderer", "None", "a volume to show", "use cut_surface for depth alone"
            )
        camera, settings = self._view(camera, settings)
        if settings.context is None and self._tree is None:
            mend = "give the renderer a tree, or the settings a context such as 'mida'"
            raise SettingsError("context", "None without a vessel tree", "something to show", mend)
        asked = None if images is None else _names(images)
        settings, source = self._with_source(settings, asked)
        names = asked if asked is not None else self._at_once(settings)
        callback(SettingsError, "progress", progress)
        along = self._along.of_rim(settings)
        core, volume = self._parts.shown(self._volume, self._tree is not None, camera, settings)
        last = _before(before)
        buffers = core.render(volume, camera, checked(settings), names, progress, None, along, last)
        return self._frame(camera, settings, buffers, asked, source)

    def cut_surface(
        self,
        camera: Camera | None = None,
        settings: Settings | None = None,
        *,
        images: Iterable[str] | None = None,
        before: Frame | None = None,
    ) -> Frame:
        """Return depth, vessel and distance of one view, without reading the volume.

        Parameters
        ----------
        camera, settings
            As for :meth:`render`.
        images : iterable of str, optional
            The images that the frame is to have, of ``"depth"``, ``"vessel"``, ``"distance"``, ``"cost"``,
            ``"level"`` and ``"piece"``; the first three by default.
        before : Frame, optional
            As for :meth:`render`.

        Raises
        ------
        VesselTreeError
            Without a tree.
        SettingsError
            For an image of another name.
        DeviceError, KeyboardInterrupt
            As for :meth:`render`.
        """
        if self._tree is None:
            raise VesselTreeError(
                "tree of the renderer", "None", "a tree to cut along", "use render for the context alone"
            )
        camera, settings = self._view(camera, settings)
        asked = None if images is None else _names(images, _OF_CUT_SURFACE)
        names = asked if asked is not None else self._at_once(settings)
        last = _before(before)
        buffers = self._core.render(None, camera, checked(settings), names, None, None, None, last)
        if asked is not None:
            buffers = {name: buffers[name] for name in (*asked, "timings")}
        return self._frame(camera, settings, buffers, asked)

    def _by(
        self,
        method: tuple[Any, ...],
        camera: Camera | None,
        settings: Settings | None,
        images: Iterable[str] | None = None,
    ) -> Frame:
        """Return one view by a reformation, given its name and its numbers for the extension module."""
        if self._tree is None:
            raise VesselTreeError("tree of the renderer", "None", "a tree to lay the image through")
        camera, settings = self._view(camera, settings)
        asked = None if images is None else _names(images)
        settings, source = self._with_source(settings, asked, method[0])
        names = [name for name in IMAGES if name != "distance"] if asked is None else asked
        core, used = self._core, checked(settings)
        buffers = core.render(self._volume, camera, used, names, None, method)
        arrays = {f"_{name}": array for name, array in buffers.items() if name != "timings"}
        if asked is None:
            arrays["_distance"] = lambda: core.render(None, camera, used, ["distance"])["distance"]
        requested = None if asked is None else tuple(asked)
        return Frame(camera, buffers["timings"], **arrays, _asked=requested, _source=source)

    @functools.cached_property
    def _parts(self) -> PartsInView:
        """The parts of a pyramid that views show."""
        return PartsInView(self._core)

    def _with_source(
        self, settings: Settings, asked: list[str] | None, method: str = "csr"
    ) -> tuple[Settings, FrameSource | None]:
        """Return the settings with windows, and the source of a picture, if a requested image needs them.

        Depth, vessel, distance and value need no window.
        """
        if self._volume is None or (asked is not None and not _WINDOWED.intersection(asked)):
            return settings, None
        used = self.windowed(settings)
        legend = self._along.legend(settings) if method == "csr" else None
        return used, frame_source(used, self._volume, self._tree, self._vessel_ends, method, legend)

    def _at_once(self, settings: Settings) -> list[str] | None:
        """Return the images to compute if none are named; None means all."""
        if self._tree is None or settings.level_choice != "own":
            return None
        # All except the distance, which no other image needs and which is rarely used.
        return [name for name in IMAGES if name != "distance"]

    def _frame(
        self,
        camera: Camera,
        settings: Settings,
        buffers: dict[str, Any],
        asked: list[str] | None,
        source: FrameSource | None = None,
    ) -> Frame:
        """Return the frame with some images; a missing distance is computed on first use."""
        arrays = {f"_{name}": array for name, array in buffers.items() if name != "timings"}
        if asked is None and self._at_once(settings) is not None:
            core = self._core
            arrays["_distance"] = lambda: core.render(None, camera, checked(settings), ["distance"])[
                "distance"
            ]
        names = None if asked is None else tuple(asked)
        return Frame(camera, buffers["timings"], **arrays, _asked=names, _source=source)

    def _view(self, camera: Camera | None, settings: Settings | None) -> tuple[Camera, Settings]:
        """Return the camera and the settings, or their defaults."""
        if not isinstance(camera, (Camera, type(None))):
            raise CameraError("camera", type(camera).__name__, "a Camera or None")
        if not isinstance(settings, (Settings, type(None))):
            raise SettingsError("settings", type(settings).__name__, "Settings or None")
        return camera or Camera.anterior(self._scene), self._choosing(settings or Settings())

    def _choosing(self, settings: Settings) -> Settings:
        """Return the settings with ids instead of names; a word of digits that is a name is not an id."""
        words, tree = settings.focus_vessels, self._tree
        if not words:
            return settings
        if tree is None:
            expected = "a scene with centerlines"
            mend = "give centerlines, or leave the focus_vessels out"
            found = "chosen vessels for a scene without centerlines"
            raise SettingsError("focus_vessels", found, expected, mend)
        ids = tuple(tree.ids(*(id_or_name(tree, word) for word in words)))
        return settings if ids == words else replace(settings, focus_vessels=ids)

    def windowed(self, settings: Settings) -> Settings:
        """Return the settings as :meth:`render` uses them: missing windows come from the data.

        Raises
        ------
        VolumeError
            Without a volume.
        """
        if not isinstance(settings, Settings):
            raise SettingsError("settings", type(settings).__name__, "Settings")
        return self._windows.used(settings, has_tree=self._tree is not None)

    @property
    def window(self) -> Window:
        """The window of cut surface and context if the settings name none; see :meth:`Window.from_data`.

        Contexts of minimum and mean have their own, see :meth:`windowed`.
        """
        return self._windows.main

    @functools.cached_property
    def _vessel_ends(self) -> tuple[VesselEnd, ...]:
        return () if self._tree is None else vessel_ends(self._tree)


def check_renderer(renderer: Any) -> None:
    """Reject anything but a renderer."""
    if not isinstance(renderer, Renderer):
        raise SettingsError("renderer", type(renderer).__name__, "a Renderer")


def _before(frame: Frame | None) -> tuple[Camera, npt.NDArray[np.float32]] | None:
    """Return camera and depth of the frame before in a turn."""
    if frame is None:
        return None
    if not isinstance(frame, Frame) or not frame.has("depth"):
        found = "a frame without depth" if isinstance(frame, Frame) else type(frame).__name__
        raise SettingsError("before", found, "a Frame of a cut surface, with its depth, or None")
    return frame.camera, frame.depth


def _check_kind(tree: Any) -> None:
    if not isinstance(tree, (VesselTree, type(None))):
        expected = "a VesselTree, such as read_centerlines returns, or None"
        raise VesselTreeError("tree", type(tree).__name__, expected)


def _names(images: Iterable[str], known: tuple[str, ...] = IMAGES) -> list[str]:
    if not isinstance(images, Iterable):
        raise SettingsError("images of the frame", repr(images), f"names of {', '.join(known)}")
    names = [images] if isinstance(images, str) else list(images)
    for name in names:
        choice(SettingsError, "image of the frame", name, known)
    return names
