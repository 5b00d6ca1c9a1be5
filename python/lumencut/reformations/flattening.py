"""Free-form flattening: the surface through several curves as an image."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice, numbers
from lumencut.errors import SettingsError, VesselTreeError
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import SlabArgument, flat_settings
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.request import ReformationRequest, pixel_side
from lumencut.scene.settings import Settings
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

KEPT = ("lines", "rows")

_AXES = {
    "lines": "Down: along the curve in the middle, in mm. Across: along each line to its sides, in mm.",
    "rows": "Across: along the line in the middle, in mm. Down: along each curve from there, in mm.",
}


class FlattenedSurface(Reformation):
    """A surface through several curves as an image (H, W), made by :func:`lumencut.flatten`.

    Rows run with the given curves, columns from the first curve to the last one. Pixels beyond the surface
    show nothing. A world point has the pixel of the nearest point of the surface, NaN beyond its border. A
    pixel is folded where the surface turns back behind itself.

    Attributes
    ----------
    keep : {"lines", "rows"}
        Along which curves lengths are true.
    """

    _arrays = (*Reformation._arrays, "distortion")

    def __init__(
        self, renderer: Renderer, core: _lumencut.Flattened, given: Settings, parameters: dict[str, Any]
    ) -> None:
        self.keep: str = parameters["keep"]
        recipe = ReformationRecipe("flattening", _AXES[self.keep], parameters, "flatten")
        super().__init__(renderer, core, given, recipe, measurable=True)

    @functools.cached_property
    def distortion(self) -> npt.NDArray[np.float32]:
        """Area of the surface in a pixel by the area of the pixel, minus 1: 0 where nothing is distorted.

        Float32, shape (H, W), NaN beyond the surface. With E, F and G of the first fundamental form it is
        √(EG − F²) − 1.
        """
        down, across = self._tangents
        area: npt.NDArray[np.float64] = np.linalg.norm(np.cross(down, across), axis=-1)
        return np.asarray(area - 1.0, np.float32)

    @functools.cached_property
    def shear(self) -> npt.NDArray[np.float32]:
        """Size of F, the product of both tangents: 0 where rows and columns cross at a right angle.

        Float32, shape (H, W), NaN beyond the surface.
        """
        down, across = self._tangents
        return np.asarray(np.abs((down * across).sum(axis=-1)), np.float32)

    @functools.cached_property
    def _tangents(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Change of the position down and across, per mm of the image."""
        height, width = self.position.shape[:2]
        down, across = np.full_like(self.position, np.nan), np.full_like(self.position, np.nan)
        if height > 1:
            down = np.gradient(self.position, self.pixel_spacing, axis=0)
        if width > 1:
            across = np.gradient(self.position, self.pixel_spacing, axis=1)
        return down, across

    def __repr__(self) -> str:
        """Return the size."""
        width, height = self.size
        return f"FlattenedSurface({width} × {height} pixels, keep {self.keep!r})"


def flatten(
    volume: Any,
    curves: VesselTree | Sequence[Vessel | npt.ArrayLike],
    keep: Literal["lines", "rows"] = "lines",
    pixel_spacing: float | None = None,
    *,
    slab: SlabArgument = None,
    settings: Settings | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
) -> FlattenedSurface:
    """Return the surface through two or more curves as a flat image, such as both rims of a jaw.

    Each curve runs from 0 to 1 by shares of its length. A line crosses all curves at equal shares: it is
    straight between two curves, and a natural cubic spline through more. With ``keep="lines"`` lengths are
    true along every line, and along the curve in the middle of all lines. With ``keep="rows"`` they are true
    along every curve, and along the line in the middle. Angles are true where these cross at a right angle.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume
        The scan.
    curves : VesselTree, or sequence of Vessel or array_like of shape (n, 3)
        The curves from one side of the surface to the other (mm, LPS). A curve that runs against the one
        before it is turned.
    keep : {"lines", "rows"}, default "lines"
        Along which curves lengths are true.
    pixel_spacing : float, optional
        Side of a pixel (mm); default: the smallest voxel side, at least 0.05 and at most 0.25 mm.
    slab : Slab, (mm, mode) or mm, optional
        Thickness across the surface, and which value of it is shown; by default as in the settings.
    settings : Settings, optional
        Window, opacity, background and slab.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`lumencut.Renderer`.

    Raises
    ------
    VesselTreeError
        For less than two curves, a curve without length, and neighbouring curves that cross.
    CameraError
        For an invalid pixel spacing, or an image of too many pixels.
    SettingsError
        For another word for `keep`.
    VolumeError
        For an image that is not a volume.
    """
    asked = FlattenRequest(keep, pixel_spacing, slab, settings)
    return asked.of(Renderer(volume, None, device), _lines(curves))


@dataclass(frozen=True)
class FlattenRequest(ReformationRequest):
    """The parameters of :func:`flatten`."""

    kind, subject = "flatten", "flattening"
    stored = ("keep", "pixel_spacing")

    keep: Literal["lines", "rows"] = "lines"
    pixel_spacing: float | None = None
    slab: SlabArgument = None
    settings: Settings | None = None

    def of(self, renderer: Renderer, lines: Sequence[npt.NDArray[np.float64]]) -> FlattenedSurface:
        """Return the surface through some curves in the scene and window of a renderer."""
        choice(SettingsError, "keep of the flattening", self.keep, KEPT)
        assert renderer.volume is not None
        asked = self.checked(pixel_spacing=pixel_side(renderer.volume))
        core = _lumencut.Flattened(list(lines), self.keep, asked["pixel_spacing"])
        given = flat_settings(self.settings, self.slab)
        # Curves need not run in a lumen, so the window comes from the whole volume.
        if given.window is None:
            given = replace(given, window=renderer.window)
        return FlattenedSurface(renderer, core, given, asked)


def _lines(curves: Any) -> list[npt.NDArray[np.float64]]:
    """Return the points of each curve."""
    if not isinstance(curves, Iterable):
        raise VesselTreeError("curves of the flattening", type(curves).__name__, "two or more curves")
    subject = "curve of the flattening"
    return [
        one.points if isinstance(one, Vessel) else numbers(VesselTreeError, subject, one, (-1, 3))
        for one in curves
    ]
