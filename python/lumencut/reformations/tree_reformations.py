"""Reformations of a whole vessel tree in one view: mpCPR and CR, the methods that CSR is compared with."""

from __future__ import annotations

from typing import Any, Literal

from lumencut import _lumencut
from lumencut.base.checks import number
from lumencut.errors import SettingsError, VesselTreeError
from lumencut.pictures.frame import Frame
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree

#: The thresholds of CR (pixels), as in the picture of the neck in the CSR paper (Fig. 8).
RADIUS_OFFSET, ARC_THRESHOLD = 50.0, 150.0

MPCPR = ("mpcpr",)


def cr_method(
    radius_offset: float = RADIUS_OFFSET, arc_threshold: float = ARC_THRESHOLD
) -> tuple[str, float, float]:
    """Return CR with its thresholds (pixels) in the renderer's form; reject invalid thresholds."""
    offset = number(SettingsError, "radius_offset", radius_offset)
    threshold = number(SettingsError, "arc_threshold", arc_threshold)
    _lumencut.check_cr(offset, threshold)
    return ("cr", offset, threshold)


def mpcpr(
    volume: Any,
    tree: VesselTree,
    camera: Camera | None = None,
    settings: Settings | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> Frame:
    """Return a multipath curved planar reformation (mpCPR): the projected CPRs of all vessels in one image.

    With v the direction of view and u upwards in the image, each vessel c(t) is cut along the surface c(t) +
    s·(v × u). So every row of the image is one row of each vessel that it crosses, and is split midway
    between neighbouring vessels; on equal distance the one nearer to the viewer is shown. A vessel that runs
    along the rows and along the view at once appears thinner than it is: that is part of the method.
    Kanitsar et al. 2003, doi:10.1109/VISUAL.2003.1250353.

    Parameters
    ----------
    volume : Volume, an image of SimpleITK, itk, nibabel or vtk, datasets of pydicom, or None
        The angiography; without it the frame has only depth and vessel.
    tree : VesselTree
        Its centerlines.
    camera : Camera, optional
        The view; from the front, fitted to the tree by default.
    settings : Settings, optional
        The settings; by default with windows from the data and without silhouettes, which the method does not
        have. Those of the cut surface of CSR have no effect
        except ``centerline_smoothing``, ``silhouette_rule``, and ``unknown_radius``, which defines the lumen
        for silhouettes. There is no depth filter, silhouettes have no reach, and a focus and chosen
        vessels are refused.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that shows the volume, as for :class:`Renderer`; the CPU finds the places of the pixels.

    Returns
    -------
    Frame
        Its images are those of every frame, each (H, W). In rows that no vessel crosses there is nothing:
        ``vessel`` is -1, ``depth``, ``position`` and ``value`` are NaN, and the picture shows the context, or
        else the background. ``folded`` shows where several points of one vessel share the row, of which the
        nearest along the row is shown.

    Raises
    ------
    VesselTreeError
        For a tree of another kind, one that lies wholly outside the volume, or a vessel without length.
    CameraError, SettingsError, VolumeError, DeviceError
        As for :meth:`Renderer.render`.
    KeyboardInterrupt
        At Ctrl-C.
    """
    return _renderer(volume, tree, device)._by(MPCPR, camera, _or_default(settings))


def cr(
    volume: Any,
    tree: VesselTree,
    camera: Camera | None = None,
    settings: Settings | None = None,
    radius_offset: float = RADIUS_OFFSET,
    arc_threshold: float = ARC_THRESHOLD,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> Frame:
    """Return a Centerline Reformation (CR): every pixel takes the depth of the nearest projected centerline.

    Vessels in front stay visible within a disc around them. Of all stretches of the tree whose disc holds
    a pixel, the foremost one is shown there, by its point nearest in the image. A larger offset keeps more of
    the surroundings of the vessels in front, and cuts off more of those behind. Mistelbauer et al.,
    "Centerline Reformations of Complex Vascular Structures", IEEE PacificVis 2012; the rule is in
    docs/method/reformations.md.

    Parameters
    ----------
    volume, tree, camera, settings, device
        As for :func:`mpcpr`.
    radius_offset : float, default 50
        Radius of the disc beyond that of its vessel (pixels), 0 or more.
    arc_threshold : float, default 150
        Largest distance along the tree, through its junctions, between two places of one stretch (pixels of
        arc length), 0 or more. Within a stretch the nearer one in the image is shown, regardless of the
        depth.

    Returns
    -------
    Frame
        Its images are those of every frame, each (H, W), in every pixel.

    Raises
    ------
    SettingsError
        For a focus or chosen vessels, or a threshold that is negative, not finite or above a million pixels.
    VesselTreeError, CameraError, VolumeError, DeviceError, KeyboardInterrupt
        As for :func:`mpcpr`.
    """
    method = cr_method(radius_offset, arc_threshold)
    return _renderer(volume, tree, device)._by(method, camera, _or_default(settings))


def _or_default(settings: Settings | None) -> Settings:
    return Settings(silhouettes=False) if settings is None else settings


def _renderer(volume: Any, tree: Any, device: Literal["auto", "cpu", "gpu"]) -> Renderer:
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("tree", type(tree).__name__, "a VesselTree, such as read_centerlines returns")
    return Renderer(volume, tree, device)
