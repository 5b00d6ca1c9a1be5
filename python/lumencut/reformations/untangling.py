"""Makes an untangled CPR of a tree."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, TypeVar

import numpy.typing as npt

from lumencut import _lumencut
from lumencut.errors import CameraError, VesselTreeError, VolumeError
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import SlabArgument, flat_settings
from lumencut.reformations.request import ReformationRequest, pixel_side
from lumencut.reformations.untangled_tree import UntangledTree
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree

_Laid = TypeVar("_Laid", bound=UntangledTree)


def untangled(
    volume: Any,
    tree: VesselTree,
    camera: Camera | None = None,
    width: float = 25.0,
    hull_margin: float = 2.0,
    smoothing: float = 4.0,
    pixel_spacing: float | None = None,
    root: npt.ArrayLike | None = None,
    slab: SlabArgument = None,
    settings: Settings | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> UntangledTree:
    """Return every vessel of a tree cut open in one image, without overlap: untangled CPR.

    Each vessel keeps its direction in the view, but has its true length, even if it runs along the view.
    Branches that would overlap are turned about their origin by the smallest angle that separates them.
    Kanitsar et al. 2003 (doi:10.1109/VISUAL.2003.1250353) show trees this way; we could read only their
    abstract, so layout and search are ours (docs/method/reformations.md).

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume
        The angiography.
    tree : VesselTree
        Its centerlines. Cycles are cut open where their longer way ends; parts that are not connected lie
        side by side. Above some 15 vessels a selection, such as ``tree.select``, is easier to read.
    camera : Camera, optional
        From where the tree is seen; its direction and up count, not its place, size or pixels. From the front
        by default.
    width : float, default 25
        How far from each vessel the image shows what surrounds it (mm), on each side.
    hull_margin : float, default 2
        Margin around the lumen that no other vessel may enter (mm).
    smoothing : float, default 4
        Standard deviation of the Gaussian that smooths the directions in which vessels are seen, along them
        (mm, 0 to 1000). Positions are not smoothed.
    pixel_spacing : float, optional
        Side of a pixel (mm); default: the smallest voxel side, at least 0.05 and at most 0.25 mm.
    root : array_like, shape (3,), optional
        A point (mm, LPS) near the end of the vessel from which the tree grows. By default, and for parts
        without it, the free end with the largest mean radius over 10 mm; on equal ones that of the smallest
        id, its first point before its last one.
    slab : Slab, (mm, mode) or mm, optional
        Thickness of the surface, and which value of it is shown; by default as in the settings.
    settings : Settings, optional
        Window, opacity, background and slab, and ``unknown_radius`` for vessels without radii. A focus and
        chosen vessels are refused.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that shows the volume, as for :class:`lumencut.Renderer`; the CPU finds the places of the
        pixels.

    Raises
    ------
    VesselTreeError
        For a tree of another kind, one that lies wholly outside the volume, a vessel without length, or a
        part that is one loop, without a free end to begin at, where ``root`` names none.
    CameraError
        For a camera of another kind, a width, margin, smoothing, root or pixel spacing that is invalid, or an
        image of too many pixels.
    SettingsError
        For another device, a slab that is invalid or not thicker than 0, or a focus.
    VolumeError
        For an image that is not a volume.
    KeyboardInterrupt
        At Ctrl-C.
    """
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("tree", type(tree).__name__, "a VesselTree, such as read_centerlines returns")
    asked = UntangledRequest(camera, width, hull_margin, smoothing, pixel_spacing, root, slab, settings)
    return asked.of(Renderer(volume, tree, device))


@dataclass(frozen=True)
class UntangledRequest(ReformationRequest):
    """The parameters of :func:`untangled`."""

    kind, subject = "untangled", "untangled CPR"
    stored = ("width", "hull_margin", "smoothing", "pixel_spacing", "root")

    of_settings: ClassVar[dict[str, str]] = {}

    camera: Camera | None = None
    width: float = 25.0
    hull_margin: float = 2.0
    smoothing: float = 4.0
    pixel_spacing: float | None = None
    root: npt.ArrayLike | None = None
    slab: SlabArgument = None
    settings: Settings | None = None

    def of(self, renderer: Renderer) -> UntangledTree:
        """Return the untangled tree of a renderer, in its window."""
        if renderer.volume is None or renderer.tree is None:
            missing = "a volume" if renderer.volume is None else "a tree"
            raise VolumeError("renderer of the untangled CPR", f"none with {missing}", "a volume and a tree")
        return self.laid_out(renderer, renderer.tree, pixel_side(renderer.volume), UntangledTree)

    def laid_out(
        self, renderer: Renderer, tree: VesselTree, side: float, kind: Callable[..., _Laid]
    ) -> _Laid:
        """Return the untangled tree as an object of a kind; `side` is the default side of a pixel (mm)."""
        if not isinstance(self.camera, (Camera, type(None))):
            raise CameraError("camera", type(self.camera).__name__, "a Camera or None")
        view = Camera.anterior(tree) if self.camera is None else self.camera
        given = flat_settings(self.settings, self.slab)
        asked = self.checked(pixel_spacing=side)
        *lengths, begin = asked.values()
        arrays = [(vessel.points, vessel.radius) for vessel in tree]
        core = _lumencut.Untangled(arrays, view, (*lengths, given.unknown_radius), begin)
        placed = {"view": list(view.direction), "up": list(view.up)}
        return kind(renderer, core, tree, given, {**placed, **asked})
