"""Turntables: the view turns about an axis, with the same pixel spacing in all frames."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator
from types import NoneType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import integers, number
from lumencut.errors import CameraError

if TYPE_CHECKING:
    from lumencut.pictures.frame import Frame
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings

Axis: TypeAlias = Literal["superior", "up", "right", "direction"] | npt.ArrayLike

MOST_FRAMES = 1_000_000
#: Degrees before a complete turn that its first frame follows.
_RUN_UP = 60.0


def turntable(
    renderer: Renderer,
    camera: Camera | None = None,
    settings: Settings | None = None,
    frames: int = 72,
    degrees: float = 360.0,
    axis: Axis = "superior",
) -> Iterator[Frame]:
    """Render a turn, one frame at a time.

    With the setting ``turning_limit``, each frame follows the one before; a complete turn begins as it ends.

    Parameters
    ----------
    renderer : Renderer
        The scene.
    camera : Camera, optional
        The first view; it turns about its center. From the front and fitted to the turn of the renderer's
        scene by default.
    settings : Settings, optional
        The settings; defaults if omitted.
    frames : int, default 72
        Number of frames. Complete turns omit the last one, which would repeat the first.
    degrees : float, default 360
        Total rotation of the viewer (degrees); from anterior about superior to the patient's left.
    axis : {"superior", "up", "right", "direction"} or array_like of shape (3,), default "superior"
        The axis of the patient or of the first view, or a vector (LPS).

    Yields
    ------
    Frame
        The next view.

    Raises
    ------
    CameraError
        For an axis that is no direction, or a number of frames below 1.
    """
    from lumencut.pictures.renderer import check_renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings

    check_renderer(renderer)
    if not isinstance(camera, (Camera, NoneType)):
        raise CameraError("camera", type(camera).__name__, "a Camera or None")
    if camera is None:
        camera = fitted_turn(Camera.anterior(renderer.scene), renderer.scene, degrees, axis)
    if isinstance(settings, Settings) and settings.turning_limit is not None and renderer.tree is not None:
        yield from _held(renderer, list(_views(camera, frames, degrees, axis)), settings, degrees)
    else:
        for view in _views(camera, frames, degrees, axis):
            yield renderer.render(view, settings)


def _held(renderer: Renderer, views: list[Camera], settings: Settings, degrees: float) -> Iterator[Frame]:
    """Render views that each follow the one before."""
    before = None
    if degrees != 0.0 and degrees % 360.0 == 0.0:
        for view in views[-math.ceil(len(views) * _RUN_UP / abs(degrees)) :]:
            before = renderer.cut_surface(view, settings, images=["depth"], before=before)
    for view in views:
        before = renderer.render(view, settings, before=before)
        yield before


def fitted_turn(camera: Camera, scene: Any, degrees: float = 360.0, axis: Axis = "superior") -> Camera:
    """Return the camera at the middle of the scene, with a pixel spacing at which all frames show all of it.

    Parameters
    ----------
    camera : Camera
        The first view; its direction, up and size are kept.
    scene : VesselTree, Vessel, Volume, or anything :func:`lumencut.render` takes as a volume
        The object to fit.
    degrees, axis
        As for :func:`turntable`.

    Raises
    ------
    CameraError
        For a scene of another kind, or an axis that is no direction.
    """
    from lumencut.scene.camera import Camera, checked_axis, scene_points

    if not isinstance(camera, Camera):
        raise CameraError("camera", type(camera).__name__, "a Camera")
    angle = number(CameraError, "degrees of the turntable", degrees)
    about = checked_axis(axis, ("superior", "up", "right", "direction"))
    return camera._moved(_lumencut.fitted_turn(camera, scene_points(scene), angle, about))


def frame_angles(frames: int, degrees: float) -> npt.NDArray[np.float64]:
    """Return the angles of the frames (radians), shape (frames,); a full turn omits its last frame."""
    (count,) = integers(CameraError, "frames of the turntable", [frames], 1, MOST_FRAMES, 1)
    angle = number(CameraError, "degrees of the turntable", degrees)
    return np.array(_lumencut.frame_angles(count, angle))


def _views(camera: Camera, frames: int, degrees: float, axis: Axis) -> Iterator[Camera]:
    about = (0.0, 0.0, 1.0) if isinstance(axis, str) and axis == "superior" else axis
    return (camera.rotated(float(angle), about) for angle in frame_angles(frames, degrees))


def save_animation(
    frames: Iterable[Frame],
    path: str | os.PathLike[str],
    fps: float = 12.0,
    *,
    annotate: bool = False,
    vessel_names: bool = False,
    study: Any = None,
    anonymous: bool = False,
    other_patient: bool = False,
    grey: bool = False,
    compress: bool = False,
) -> None:
    """Write frames as an animation that appears only when complete.

    Parameters
    ----------
    frames : iterable of Frame
        The frames, all of one size; a generator is read frame by frame.
    path : path-like
        ``.webp`` (small, slightly lossy), ``.png`` or ``.apng`` (lossless) or ``.mp4`` (needs the extra
        ``[video]``); ``.dcm``, a DICOM multi-frame Secondary Capture, in colours;
        a name with a number such as ``frame-%03d.png`` or a folder: one picture per frame.
    fps : float, default 12
        Frames per second, from 1/60 to 1000.
    annotate, vessel_names : bool, default False
        Labels on the frames, as for :meth:`Frame.save`.
    study, anonymous, other_patient, compress
        For ``.dcm``, as for :meth:`Frame.save`.
    grey : bool, default False
        For ``.dcm``: write grey frames; some programs read only these.

    Raises
    ------
    FormatError
        For an unknown extension, no frames, or frames of several sizes.
    SettingsError
        For frames per second beyond their range, or names of vessels without labels.
    FileError
        If the file cannot be written.
    MissingPackageError
        For a video without the extra ``[video]``.
    """
    from lumencut.pictures.animation import writer_for

    of_study = {"study": study, "anonymous": anonymous, "other_patient": other_patient}
    dicom = {**of_study, "grey": grey, "compress": compress}
    writer_for(path, annotate=annotate, vessel_names=vessel_names, dicom=dicom)(frames, fps)
