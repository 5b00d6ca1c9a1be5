"""One view of a scene without a renderer to keep."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from lumencut.pictures.frame import Frame
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree


def render(
    volume: Any,
    tree: VesselTree | None = None,
    camera: Camera | None = None,
    settings: Settings | None = None,
    *,
    profiles: Iterable[Any] = (),
    progress: Callable[[int, int], object] | None = None,
) -> Frame:
    """Return the picture of one view of an angiography and its centerlines.

    Parameters
    ----------
    volume : Volume, an image of SimpleITK, itk, nibabel or vtk, or datasets of pydicom
        The angiography.
    tree : VesselTree, optional
        Its centerlines; the context alone is shown by default.
    camera : Camera, optional
        The view; from the front, fitted to the tree or else the volume by default.
    settings : Settings, optional
        The settings; by default with windows from the data.
    profiles : iterable of Profile, or of (Profile, iterable of Stenosis), default ()
        What the setting ``rim`` shows, as for :class:`Renderer`.
    progress : callable, optional
        Called with (done, total) while it renders, as by :meth:`Renderer.render`.
    """
    return Renderer(volume, tree, profiles=profiles).render(camera, settings, progress=progress)
