"""Every knob of the method, with its unit and its default."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lumencut import _lumencut
from lumencut._checks import integers, number
from lumencut.errors import SettingsError, VesselTreeError, VolumeError

if TYPE_CHECKING:
    from lumencut.vessel_tree import VesselTree
    from lumencut.volume import Volume

#: How far beyond the wall a window's tissue is looked for, and the radius where it is unknown (mm).
_BESIDE, _UNKNOWN_RADIUS = 10.0, 10.0
#: The largest level and width that a window can have.
_LARGEST = 1e12


@dataclass(frozen=True)
class Window:
    """Intensities shown from black to white: ``level`` ± ``width`` / 2, in the volume's unit (HU for CT)."""

    level: float
    width: float

    def __post_init__(self) -> None:
        for name in ("level", "width"):
            object.__setattr__(self, name, number(SettingsError, f"window {name}", getattr(self, name)))
        Settings(window=self)  # The ranges are known to the settings.

    @classmethod
    def from_data(cls, volume: Volume, tree: VesselTree) -> Window:
        """Return a window that shows lumen as middle grey, tissue darker, calcifications and stents brighter.

        The median along the centerlines stands for the lumen, the median 10 mm beyond the vessels' walls for
        the tissue around it; the window is centred on the lumen, three times as wide as their difference.

        Raises
        ------
        VolumeError
            For what is no volume, or values beyond all windows.
        VesselTreeError
            For what is no tree.
        """
        from lumencut.vessel_tree import VesselTree
        from lumencut.volume_files.memory import as_volume

        if not isinstance(tree, VesselTree):
            raise VesselTreeError("tree", type(tree).__name__, "a VesselTree")
        volume = as_volume(volume)
        lumen = volume.sample(tree.points)
        lumen = lumen[np.isfinite(lumen)].astype(np.float64)
        radii = [np.full(len(v), _UNKNOWN_RADIUS) if v.radius is None else v.radius for v in tree]
        reach = np.concatenate(radii)[:, None, None] + _BESIDE
        beside = tree.points[:, None] + reach * np.concatenate([np.eye(3), -np.eye(3)])
        around = volume.sample(beside.reshape(-1, 3))
        around = around[np.isfinite(around)].astype(np.float64)
        if lumen.size == 0 or around.size == 0:
            return cls(300.0, 900.0)
        level = float(np.median(lumen))
        width = 3 * abs(level - float(np.median(around)))
        width = max(width, 4 * float(lumen.std()), 1e-3 * abs(level), 1e-6)
        if max(abs(level), width) > _LARGEST:
            found = f"values around {level:.3g} along the centerlines, {float(np.median(around)):.3g} beside"
            mend = "scale the voxels, or give window= where these values stand for nothing"
            raise VolumeError("window from the data", found, f"a window within ±{_LARGEST:.0e}", mend)
        return cls(level, width)


@dataclass(frozen=True)
class Opacity:
    """A linear ramp: intensities up to ``transparent`` are not shown, from ``opaque`` on they are opaque."""

    transparent: float
    opaque: float

    def __post_init__(self) -> None:
        for name in ("transparent", "opaque"):
            object.__setattr__(self, name, number(SettingsError, f"opacity {name}", getattr(self, name)))
        Settings(opacity=self)


@dataclass(frozen=True)
class Settings:
    """How the cut surface is made and shown (Auzinger et al. 2013, section 3).

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

    def __post_init__(self) -> None:
        for name in ("cost_weight", "lumen_margin", "level_distance", "silhouette_slope"):
            self._set(name, number(SettingsError, name, getattr(self, name)))
        for name in ("preserve_lumen", "lumen_first", "depth_filter", "silhouettes"):
            if not isinstance(getattr(self, name), (bool, np.bool_)):
                raise SettingsError(name, repr(getattr(self, name)), "True or False")
            self._set(name, bool(getattr(self, name)))
        self._set("levels", integers(SettingsError, "levels", [self.levels], 0, 15, 1)[0])
        self._set(
            "silhouette_color", integers(SettingsError, "silhouette_color", self.silhouette_color, 0, 255, 3)
        )
        self._set("background", integers(SettingsError, "background", self.background, 0, 255, 4))
        for name, kind in (("window", Window), ("opacity", Opacity)):
            if not isinstance(getattr(self, name), (kind, type(None))):
                raise SettingsError(name, repr(getattr(self, name)), f"a {kind.__name__} or None")
        _lumencut.check_settings(self)

    def _set(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)
