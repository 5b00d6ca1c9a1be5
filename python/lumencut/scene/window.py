"""Which intensities are shown, and how opaque they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lumencut import _lumencut
from lumencut.base.checks import choice, number
from lumencut.base.pickles import by_name
from lumencut.errors import SettingsError, VesselTreeError

if TYPE_CHECKING:
    from lumencut.scene.vessel_tree import VesselTree

#: The windows that have a name, in the order to show them to users.
WINDOW_NAMES = tuple(name for name, _, _ in _lumencut.WINDOW_PRESETS)

#: Level and width of those that are the same for every volume (HU).
_FIXED = {name: fixed for name, _, fixed in _lumencut.WINDOW_PRESETS if fixed is not None}


@by_name
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
        """Return a window that distinguishes lumen from its surroundings; ``"auto"`` by name.

        With a tree the median along the centerlines stands for the lumen, the median 10 mm beyond the
        vessels' walls for the tissue. Black lies 1.5 times their difference below the lumen, up to 2.2 times
        where fat would be black, but not below what the volume holds; white where the brightest voxels are,
        as far as the lumen stays at 60 to 72 % of the range. A lumen darker than its tissue has the mirrored
        window: it lies at 28 to 40 %, or is black where nothing is darker, and its surroundings are brighter.

        Without a tree padding and air are left out first. The largest voxels of small cubes are compared:
        most are tissue, which becomes dark, and of the brighter ones the darker stand for the lumen, which
        lies at 67 % of the range; black is never below the smallest value. Where little but vessels is left,
        their edges stand for the tissue. A dark lumen cannot be found without a tree: the bright tissue is
        shown.

        Parameters
        ----------
        volume : Volume, or anything :func:`lumencut.render` takes as one
            The angiography.
        tree : VesselTree, optional
            Its centerlines.

        Raises
        ------
        VolumeError
            For anything that is not a volume, or values beyond all windows.
        VesselTreeError
            For anything that is not a tree.
        """
        from lumencut.scene.vessel_tree import VesselTree

        if not isinstance(tree, (VesselTree, type(None))):
            raise VesselTreeError("tree", type(tree).__name__, "a VesselTree or None")
        return cls._found("auto", volume, tree)

    @classmethod
    def for_mip(cls, volume: Any) -> Window:
        """Return the window of :meth:`from_data` without a tree, made wider for a MIP of the volume.

        White lies at the 99.9th percentile of all that is no padding, as far as the window becomes at most
        1.4 times as wide, so that stents, bone and lumen are not the same white. A MIP has range to spare for
        it: it shows a lumen farther above its tissue than blended contexts do.

        Parameters
        ----------
        volume : Volume, or anything :func:`lumencut.render` takes as one
            The angiography.

        Raises
        ------
        VolumeError
            For anything that is not a volume, or values beyond all windows.
        """
        return cls._found("mip", volume)

    @classmethod
    def whole(cls, volume: Any) -> Window:
        """Return a window that shows air to lumen.

        It begins at the 1st percentile of the volume and ends at the 99th of all that is no padding, which
        is a dark value that a twentieth of the voxels has.

        Parameters
        ----------
        volume : Volume, or anything :func:`lumencut.render` takes as one
            The angiography.

        Raises
        ------
        VolumeError
            For anything that is not a volume, or values beyond all windows.
        """
        return cls._found("whole", volume)

    @classmethod
    def named(cls, name: str, volume: Any = None, tree: VesselTree | None = None) -> Window:
        """Return the window that has a name.

        Those of fixed values are for HU: ``"cta"`` 900/300 (width/level), which shows contrast medium as
        middle grey and calcifications brighter, ``"soft-tissue"`` 400/40, ``"stent"`` 1500/400, ``"sac"``
        600/150 for thrombus in an aneurysm, and ``"bone"`` 2500/480 and ``"lung"`` 1500/-600, as the OHIF
        viewer has them. The others are taken from the volume: ``"auto"`` as :meth:`from_data` does,
        ``"full"`` from the smallest voxel to the largest, and ``"mra"`` all tissues of an MR angiography,
        whose values have no unit: from the 1st percentile to the 99.9th of all that is no padding.

        Parameters
        ----------
        name : {"auto", "cta", "soft-tissue", "bone", "lung", "full", "mra", "stent", "sac"}
            The name of the window.
        volume : Volume, or anything :func:`lumencut.render` takes as one, optional
            The angiography; windows of fixed values need none.
        tree : VesselTree, optional
            Its centerlines, for ``"auto"``.

        Raises
        ------
        SettingsError
            For another name.
        VolumeError
            For anything that is not a volume, or values beyond all windows.
        VesselTreeError
            For anything that is not a tree.
        """
        choice(SettingsError, "window", name, WINDOW_NAMES)
        if name in _FIXED:
            return cls(*_FIXED[name])
        if name == "auto":
            return cls.from_data(volume, tree)
        return cls._found(name, volume)

    @classmethod
    def _found(cls, name: str, volume: Any, tree: VesselTree | None = None) -> Window:
        """A window from the data, found once for each volume and the same vessels."""
        from lumencut.scene.images import as_volume

        shown = as_volume(volume)

        def find() -> tuple[float, float]:
            return _lumencut.find_window(name, shown, None if tree is None else tree._arrays())

        return cls(*shown._windows.once(shown._voxels, name, tree, find))


@by_name
@dataclass(frozen=True)
class Opacity:
    """A linear ramp: intensities up to ``transparent`` are not shown, from ``opaque`` on they are opaque."""

    transparent: float
    opaque: float

    def __post_init__(self) -> None:
        for name in ("transparent", "opaque"):
            object.__setattr__(self, name, number(SettingsError, f"opacity {name}", getattr(self, name)))
        _lumencut.check_opacity(self.transparent, self.opaque)


def checked_window(name: str, value: Any) -> Window | str | None:
    """Return the stored form of a window setting: only names that need a volume stay names.

    None stands for ``"auto"``, which differs with the context.
    """
    if isinstance(value, Window):
        return value
    if not isinstance(value, str):
        raise SettingsError(
            name, repr(value), f"a Window, one of {', '.join(map(repr, WINDOW_NAMES))} or None"
        )
    choice(SettingsError, name, value, WINDOW_NAMES, ", a Window or None")
    if value == "auto":
        return None
    return Window.named(value) if value in _FIXED else value
