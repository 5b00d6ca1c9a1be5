"""Every knob of the method, with its unit and its default."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from lumencut import _lumencut
from lumencut._checks import choice, integers, number
from lumencut.errors import SettingsError
from lumencut.transfer import TransferFunction
from lumencut.window import Opacity, Window

ContextName: TypeAlias = Literal["mida", "dvr", "mip", "minip", "average"]


@dataclass(frozen=True)
class Slab:
    """A thick cut surface.

    Parameters
    ----------
    thickness : float
        The whole slab along the view direction, the cut surface in its middle (mm, 0 to 1000): 4 mm show what
        is up to 2 mm before and 2 mm behind.
    mode : {"max", "mean", "min"}, default "max"
        Which of the values along the view direction is shown.

    Raises
    ------
    SettingsError
        For a thickness out of range or an unknown mode.
    """

    thickness: float
    mode: Literal["max", "mean", "min"] = "max"

    def __post_init__(self) -> None:
        object.__setattr__(self, "thickness", number(SettingsError, "slab thickness", self.thickness))
        choice(SettingsError, "slab mode", self.mode, _lumencut.SLAB_MODES)
        Settings(slab=self)


@dataclass(frozen=True)
class Settings:
    """How the cut surface is made and shown (Auzinger et al. 2013, section 3), and what is behind it.

    Parameters
    ----------
    cost_weight : float, default 10
        λ: what one millimetre beyond a vessel's wall costs in millimetres of depth (Eq. 2).
    preserve_lumen : bool, default True
        Count the distance from the wall instead of from the centerline, where radii are known.
    lumen_first : bool, default False
        Let every lumen beat every surrounding, whatever the depth.
    lumen_margin : float, default 0
        How far beyond the wall ``lumen_first`` reaches (mm).
    levels : int, default 6
        N: the number of levels of detail beyond the finest, 0 to 15.
    level_distance : float, default 8
        σ: how far from the vessels one level of detail reaches (mm per level).
    depth_filter : bool, default True
        Smooth the depth with a 7 × 7 Gaussian before it is used.
    window : Window, optional
        Intensities that map to black and white; taken from the data along the centerlines where not given.
    opacity : Opacity, optional
        Intensities that map to transparent and opaque; everything is opaque where not given.
    silhouettes : bool, default True
        Draw lines where the cut surface leaps.
    silhouette_slope : float, default 24
        Slope of the cut surface (mm depth per mm) at which a silhouette has half its strength.
    silhouette_color : (int, int, int), default (255, 220, 0)
        RGB, 0 to 255.
    background : (int, int, int, int), default (0, 0, 0, 255)
        RGBA, 0 to 255, where there is nothing to show.
    slab : Slab, optional
        Show the largest, mean or smallest value of a slab around the cut surface; one point deep where not
        given.
    context : {"mida", "dvr", "mip", "minip", "average"} or None, default "mida"
        How the volume is shown where the cut surface is outside it, and behind where it is transparent:
        maximum intensity difference accumulation, direct volume rendering, the largest, the smallest or the
        mean value. None shows the background there.
    context_gamma : float, default 0
        Only for ``"mida"``: −1 is DVR, 0 MIDA, 1 MIP, between them a blend.
    context_window : Window, optional
        Intensities from 0 to 1 for the differences of MIDA, and from black to white for minimum and mean; the
        named transfer functions lie within it. Taken from the data where not given, whatever ``window`` is:
        for minimum and mean :meth:`Window.whole`, for the others :meth:`Window.from_data`.
    context_transfer : {"grey", "angio", "bone", "soft-tissue"} or TransferFunction, optional
        Colours and opacities of MIDA, DVR and MIP; minimum and mean ignore it. ``"grey"`` for ``"mip"`` and
        ``"angio"`` for the others where not given.
    context_step : float, optional
        The longest distance between samples along a ray (mm, 0.001 to 1000); where not given
        the smallest side of a voxel, and half of it for MIDA and DVR unless they are a preview.
    context_shading : bool, default False
        Shade MIDA and DVR by the gradient, with light from the viewer.
    context_preview : bool, default False
        Trace one ray for each square of four pixels: quicker and coarser.

    Raises
    ------
    SettingsError
        For a setting outside its range.
    """

    cost_weight: float = 10.0
    preserve_lumen: bool = True
    lumen_first: bool = False
    lumen_margin: float = 0.0
    levels: int = 6
    level_distance: float = 8.0
    depth_filter: bool = True
    window: Window | None = None
    opacity: Opacity | None = None
    silhouettes: bool = True
    silhouette_slope: float = 24.0
    silhouette_color: tuple[int, int, int] = (255, 220, 0)
    background: tuple[int, int, int, int] = (0, 0, 0, 255)
    slab: Slab | None = None
    context: ContextName | None = "mida"
    context_gamma: float = 0.0
    context_window: Window | None = None
    context_transfer: str | TransferFunction | None = None
    context_step: float | None = None
    context_shading: bool = False
    context_preview: bool = False

    def __post_init__(self) -> None:
        for name in ("cost_weight", "lumen_margin", "level_distance", "silhouette_slope", "context_gamma"):
            self._set(name, number(SettingsError, name, getattr(self, name)))
        for name in ("preserve_lumen", "lumen_first", "depth_filter", "silhouettes"):
            self._set_flag(name)
        self._set("levels", integers(SettingsError, "levels", [self.levels], 0, 15, 1)[0])
        for name, channels in (("silhouette_color", 3), ("background", 4)):
            self._set(name, integers(SettingsError, name, getattr(self, name), 0, 255, channels))
        kinds = (("window", Window), ("opacity", Opacity), ("slab", Slab), ("context_window", Window))
        for name, kind in kinds:
            if not isinstance(getattr(self, name), (kind, type(None))):
                raise SettingsError(name, repr(getattr(self, name)), f"a {kind.__name__} or None")
        self._check_context()
        _lumencut.check_settings(self)

    def _check_context(self) -> None:
        for name in ("context_shading", "context_preview"):
            self._set_flag(name)
        if self.context is not None:
            choice(SettingsError, "context", self.context, _lumencut.CONTEXTS, " or None")
        if not isinstance(self.context_transfer, (TransferFunction, type(None))):
            others = ", a TransferFunction or None"
            choice(SettingsError, "context_transfer", self.context_transfer, _lumencut.PRESETS, others)
        if self.context_step is not None:
            self._set("context_step", number(SettingsError, "context_step", self.context_step))

    def _set_flag(self, name: str) -> None:
        if not isinstance(getattr(self, name), (bool, np.bool_)):
            raise SettingsError(name, repr(getattr(self, name)), "True or False")
        self._set(name, bool(getattr(self, name)))

    def _set(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)
