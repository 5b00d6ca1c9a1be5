"""Which intensities are shown, and how opaque they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lumencut import _lumencut
from lumencut._checks import number
from lumencut.errors import SettingsError, VesselTreeError

if TYPE_CHECKING:
    from lumencut.vessel_tree import VesselTree


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
    def from_data(cls, volume: Any, tree: VesselTree | None = None) -> Window:
        """Return a window that shows lumen as middle grey, tissue darker, calcifications and stents brighter.

        The median along the centerlines stands for the lumen, the median 10 mm beyond the vessels' walls for
        the tissue around it; the window is centred on the lumen, three times as wide as their difference.

        Without a tree the 99th percentile of the volume stands for the lumen, and for the tissue the median
        of the voxels above a quarter of the way to it from the 1st percentile; of at most about a million
        voxels, evenly spread.

        Parameters
        ----------
        volume : Volume, or whatever else :func:`lumencut.render` takes as one
            The angiography.
        tree : VesselTree, optional
            Its centerlines.

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
        vessels = None if tree is None else tree._arrays()
        return cls(*_lumencut.window_from_data(as_volume(volume), vessels))

    @classmethod
    def whole(cls, volume: Any) -> Window:
        """Return a window that shows air to lumen: from the 1st percentile of the volume to the 99th.

        Parameters
        ----------
        volume : Volume, or whatever else :func:`lumencut.render` takes as one
            The angiography.

        Raises
        ------
        VolumeError
            For what is no volume, or values beyond all windows.
        """
        from lumencut.volume_files.memory import as_volume

        return cls(*_lumencut.whole_window(as_volume(volume)))


@dataclass(frozen=True)
class Opacity:
    """A linear ramp: intensities up to ``transparent`` are not shown, from ``opaque`` on they are opaque."""

    transparent: float
    opaque: float

    def __post_init__(self) -> None:
        for name in ("transparent", "opaque"):
            object.__setattr__(self, name, number(SettingsError, f"opacity {name}", getattr(self, name)))
        _lumencut.check_opacity(self.transparent, self.opaque)
