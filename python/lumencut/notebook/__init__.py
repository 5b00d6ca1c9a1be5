"""A view of vessels in a notebook that can be turned there: `lumencut.show`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from lumencut.errors import MissingPackageError
from lumencut.notebook.scene import DeviceName, Scene

if TYPE_CHECKING:
    from lumencut.notebook.widget import VesselWidget
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel_tree import VesselTree


def show(
    volume: Any,
    tree: VesselTree | None = None,
    camera: Camera | None = None,
    settings: Settings | None = None,
    *,
    size: tuple[int, int] = (512, 512),
    trace: bool = False,
    linked: bool = True,
    names: bool = True,
    profiles: Iterable[Any] = (),
    device: DeviceName = "auto",
    **changes: Any,
) -> VesselWidget:
    """Return a view of an angiography for a notebook, turned with the mouse as in the viewer.

    The kernel renders the pictures; the volume stays in the kernel and no server is contacted. Drags turn
    (left), pan (middle, or Shift) and change the window (right, or Ctrl); the wheel zooms. A click, or a
    double click, puts the cross-hair there and picks the vessel. docs/notebook.md lists all actions.

    The widget that is returned has the traits ``camera``, ``settings``, ``picked``, ``vessel``, ``tree`` and
    ``picture``; see :class:`lumencut.notebook.widget.VesselWidget`.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography.
    tree : VesselTree, optional
        Its centerlines; by default the view shows the context alone.
    camera : Camera, optional
        The first view; from the front, fitted to the tree or else the volume by default.
    settings : Settings, optional
        The settings; defaults if omitted, and a MIP where vessels are traced.
    size : (int, int), default (512, 512)
        Width and height of the picture (pixels, at most 4096), where no camera is given.
    trace : bool, default False
        Whether clicks set points of vessels, which are traced through them: a click sets a point, a double
        click ends the vessel, Backspace takes the last point away. ``widget.tree`` has the vessels.
    linked : bool, default True
        Whether to show the picked vessel straightened next to the view, with the section across it.
    names : bool, default True
        Whether to write the names of the vessels into the picture.
    profiles : iterable of Profile, or of (Profile, iterable of Stenosis), default ()
        What the setting ``rim`` shows, as for :class:`lumencut.Renderer`.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`lumencut.Renderer`.
    **changes
        Settings to change, by name, such as ``context="dvr"``.

    Raises
    ------
    MissingPackageError
        Without the package anywidget, which the extra ``lumencut[notebook]`` installs.
    VolumeError, VesselTreeError, CameraError, SettingsError, MeasuringError, DeviceError
        As :class:`lumencut.Renderer` and :meth:`Renderer.render`, whose first picture is made at once.
    """
    try:
        from lumencut.notebook.widget import VesselWidget
    except ModuleNotFoundError as error:
        mend = "pip install 'lumencut[notebook]', then restart the kernel"
        raise MissingPackageError("show", f"no package {error.name}", "the extra [notebook]", mend) from error
    from lumencut.notebook.first_view import FirstView

    scene = Scene(volume, tree, device, profiles)
    view = FirstView.of(scene, camera, settings, size, changes, is_traced=trace)
    return VesselWidget(view, trace=trace, linked=linked, names=names)
