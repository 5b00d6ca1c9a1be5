"""Which intensities are shown, and how opaque they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut._checks import number
from lumencut.errors import SettingsError, VesselTreeError, VolumeError

if TYPE_CHECKING:
    from lumencut.vessel_tree import VesselTree
    from lumencut.volume import Volume

#: How far beyond the wall a window's tissue is looked for, and the radius where it is unknown (mm).
_BESIDE, _UNKNOWN_RADIUS = 10.0, 10.0
#: The largest level and width that a window can have.
_LARGEST = 1e12
#: Of a volume alone: how many voxels are looked at; which percentiles of them stand for air and for lumen;
#: how far from the one to the other tissue begins.
_MOST_VOXELS, _AIR, _LUMEN, _TISSUE = 1e6, 1.0, 99.0, 0.25


@dataclass(frozen=True)
class Window:
    """Intensities shown from black to white: ``level`` ± ``width`` / 2, in the volume's unit (HU for CT)."""

    level: float
    width: float

    def __post_init__(self) -> None:
        for name in ("level", "width"):
            object.__setattr__(self, name, number(SettingsError, f"window {name}", getattr(self, name)))
        _lumencut.check_window(self.level, self.width)

    @classmethod
    def from_data(cls, volume: Volume, tree: VesselTree | None = None) -> Window:
        """Return a window that shows lumen as middle grey, tissue darker, calcifications and stents brighter.

        The median along the centerlines stands for the lumen, the median 10 mm beyond the vessels' walls for
        the tissue around it; the window is centred on the lumen, three times as wide as their difference.

        Without a tree the 99th percentile of the volume stands for the lumen, and for the tissue the median
        of the voxels above a quarter of the way to it from the 1st percentile; of at most about a million
        voxels, evenly spread.

        Raises
        ------
        VolumeError
            For what is no volume, or values beyond all windows.
        VesselTreeError
            For what is no tree.
        """
        from lumencut.vessel_tree import VesselTree
        from lumencut.volume_files.memory import as_volume

        if not isinstance(tree, (VesselTree, type(None))):
            raise VesselTreeError("tree", type(tree).__name__, "a VesselTree or None")
        volume = as_volume(volume)
        return cls._of_volume(volume) if tree is None else cls._along(volume, tree)

    @classmethod
    def whole(cls, volume: Volume) -> Window:
        """Return a window that shows air to lumen: from the 1st percentile of the volume to the 99th.

        Raises
        ------
        VolumeError
            For what is no volume, or values beyond all windows.
        """
        from lumencut.volume_files.memory import as_volume

        values = _spread(as_volume(volume))
        if values.size == 0:
            return cls(300.0, 900.0)
        black, white = (float(end) for end in np.percentile(values, (_AIR, _LUMEN)))
        return cls._within((black + white) / 2, white - black, f"values from {black:.3g} to {white:.3g}")

    @classmethod
    def _along(cls, volume: Volume, tree: VesselTree) -> Window:
        lumen = _finite(volume.sample(tree.points))
        radii = [np.full(len(v), _UNKNOWN_RADIUS) if v.radius is None else v.radius for v in tree]
        reach = np.concatenate(radii)[:, None, None] + _BESIDE
        beside = tree.points[:, None] + reach * np.concatenate([np.eye(3), -np.eye(3)])
        around = _finite(volume.sample(beside.reshape(-1, 3)))
        if lumen.size == 0 or around.size == 0:
            return cls(300.0, 900.0)
        level, beyond = float(np.median(lumen)), float(np.median(around))
        width = max(3 * abs(level - beyond), 4 * float(lumen.std()))
        return cls._within(
            level, width, f"values around {level:.3g} along the centerlines, {beyond:.3g} beside"
        )

    @classmethod
    def _of_volume(cls, volume: Volume) -> Window:
        values = _spread(volume)
        if values.size == 0:
            return cls(300.0, 900.0)
        air, lumen = (float(end) for end in np.percentile(values, (_AIR, _LUMEN)))
        brighter = values[values > air + _TISSUE * (lumen - air)]
        tissue = float(np.median(brighter)) if brighter.size else air
        return cls._within(lumen, 3 * abs(lumen - tissue), f"values from {air:.3g} to {lumen:.3g}")

    @classmethod
    def _within(cls, level: float, width: float, found: str) -> Window:
        """The window, never of no width; where there is no such window an error that says what was found."""
        width = max(width, 1e-3 * abs(level), 1e-6)
        if not max(abs(level), width) <= _LARGEST:
            mend = "scale the voxels, or give window= and context_window= where they stand for nothing"
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
        _lumencut.check_opacity(self.transparent, self.opaque)


def _spread(volume: Volume) -> npt.NDArray[np.float64]:
    """About as many finite voxels as are looked at, evenly spread."""
    step = max(int(np.ceil((volume.array.size / _MOST_VOXELS) ** (1 / 3))), 1)
    return _finite(volume.array[::step, ::step, ::step])


def _finite(values: npt.NDArray[np.generic]) -> npt.NDArray[np.float64]:
    numbers = values.astype(np.float64).ravel()
    return numbers[np.isfinite(numbers)]
