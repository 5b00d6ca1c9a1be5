"""The profiles of the vessels of one scan, each measured once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, SupportsIndex

from lumencut import _lumencut
from lumencut.base.checks import callback, number
from lumencut.base.pickles import by_name
from lumencut.errors import MeasuringError, SettingsError, VesselTreeError
from lumencut.measuring.profile import Profile
from lumencut.scene.images import as_volume
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.scene.wall_level import Wall, wall_level


@by_name
class Measurements:
    """The measured vessels of one volume and tree: each vessel is measured on first request only.

    The point spread is estimated once, from the vessels of the tree, and is the same for all of them, as in
    the viewer. Results apply to this volume, tree, step, wall and width of the point spread; for others
    create another object.

    >>> measurements = lumencut.Measurements(volume, tree)
    >>> measurements.profile("LAD").narrowest()

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography.
    tree : VesselTree
        The vessels; sections within the lumen of another one get :attr:`Flag.BRANCH`.
    step : float, default 0.5
        The distance of sections (mm), at most.
    fwhm : float, optional
        The full width at half maximum of the scanner's point spread (mm), as for :func:`lumencut.measure`.
    wall : pair of float or "off", optional
        The level of walls, as for :func:`lumencut.measure`.

    Raises
    ------
    SettingsError
        For a step, a width or a wall that is not a number; values out of range are refused by
        :meth:`profile`.
    VesselTreeError
        For another kind of tree.
    VolumeError
        For anything that is not a volume.
    """

    def __init__(
        self,
        volume: Volume | Any,
        tree: VesselTree,
        step: float = 0.5,
        fwhm: float | None = None,
        *,
        wall: Wall = None,
    ) -> None:
        if not isinstance(tree, VesselTree):
            raise VesselTreeError("tree of the measurements", type(tree).__name__, "a VesselTree")
        self._volume = as_volume(volume)
        self._tree = tree
        self._step = number(SettingsError, "step", step)
        self._fwhm = None if fwhm is None else number(SettingsError, "fwhm", fwhm)
        self._wall = wall_level(wall)
        self._kept = _lumencut.KeptProfiles()

    @property
    def volume(self) -> Volume:
        """The angiography."""
        return self._volume

    @property
    def tree(self) -> VesselTree:
        """The vessels."""
        return self._tree

    def profile(
        self,
        vessel: SupportsIndex | str | Vessel,
        *,
        progress: Callable[[int, int], object] | None = None,
    ) -> Profile:
        """Return the profile of a vessel, which is measured on first request.

        Parameters
        ----------
        vessel : int, str or Vessel
            The id or the name of a vessel of the tree, or another vessel, such as one that
            :meth:`VesselTree.path` made of several.
        progress : callable, optional
            Called at intervals with the work done and the total work.

        Returns
        -------
        Profile
            Diameters, area, uncertainty, flags and contours by arc length.

        Raises
        ------
        MeasuringError
            For a vessel outside the volume, or without a lumen around it.
        SettingsError
            For a step, a wall or a width of the point spread that is out of range.
        VesselTreeError
            For an id or a name that not exactly one vessel of the tree has, or a vessel without length.
        KeyboardInterrupt
            After Ctrl-C.
        """
        asked = vessel if isinstance(vessel, Vessel) else self._tree.path([vessel])
        arrays = [(one.points, one.radius) for one in self._tree]
        measured = (asked.points, asked.radius)
        how = (self._step, self._fwhm, self._wall)
        callback(MeasuringError, "progress", progress)
        core = self._kept.profile(self._volume, arrays, measured, *how, progress)
        return Profile(core, asked, self._volume._origin)

    def __repr__(self) -> str:
        return f"Measurements({self._volume!r}, {self._tree!r})"
