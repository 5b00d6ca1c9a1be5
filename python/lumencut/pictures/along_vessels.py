"""Values along the vessels of a tree, which colour rims and maps."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from lumencut import _lumencut
from lumencut.errors import MeasuringError, VesselTreeError
from lumencut.pictures.value_colours import Legend
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree

_Measured = tuple[_lumencut.Profile, list[_lumencut.Stenosis]]


class AlongVessels:
    """The values of the vessels of a tree, from profiles or radii; each kind is computed once.

    Parameters
    ----------
    tree : VesselTree or None
        The vessels.
    profiles : iterable of Profile, or of (Profile, iterable of Stenosis)
        Profiles of vessels of the tree, with their graded stenoses.

    Raises
    ------
    MeasuringError
        For anything else, and for a profile of another vessel.
    """

    def __init__(self, tree: VesselTree | None, profiles: Iterable[Any]) -> None:
        self._tree, self._measured = tree, _measured(profiles)
        self._known: dict[str, _lumencut.ValuesAlong] = {}
        if tree is not None and self._measured:
            self.of("diameter")

    def of(self, kind: str) -> _lumencut.ValuesAlong:
        """Return the values of a kind, a name of the setting ``rim``.

        Raises
        ------
        VesselTreeError
            Without a tree.
        MeasuringError
            If no vessel has such values.
        """
        if self._tree is None:
            raise VesselTreeError("tree", "None", "a tree with values along its vessels")
        if kind not in self._known:
            self._known[kind] = _lumencut.ValuesAlong(kind, self._tree._arrays(), self._measured)
        return self._known[kind]

    def of_rim(self, settings: Settings) -> _lumencut.ValuesAlong | None:
        """Return the values of the rim of a picture; None without a rim, or without a tree to draw it at."""
        if settings.rim is None or self._tree is None:
            return None
        return self.of(settings.rim).ranged(settings.rim_low, settings.rim_high)

    def legend(self, settings: Settings) -> Legend | None:
        """Return what the colours of a picture's rim mean."""
        values = self.of_rim(settings)
        return None if values is None else Legend(*values.legend)


def _measured(profiles: Iterable[Any]) -> list[_Measured]:
    if not isinstance(profiles, Iterable):
        raise MeasuringError("profiles", f"{profiles!r:.80}", "several Profile, such as [measure(…)]")
    return [_one(given) for given in profiles]


def _one(given: Any) -> _Measured:
    """Return a profile and its stenoses in the form of the core."""
    profile, stenoses = given if isinstance(given, tuple) and len(given) == 2 else (given, ())
    core = getattr(profile, "_core", None)
    graded = [getattr(one, "_graded", None) for one in stenoses] if isinstance(stenoses, Iterable) else [None]
    cores = [one for one in graded if isinstance(one, _lumencut.Stenosis)]
    if not isinstance(core, _lumencut.Profile) or len(cores) < len(graded):
        expected = "Profile of lumencut.measure, or (Profile, [Stenosis])"
        raise MeasuringError("profiles", f"{given!r:.80}", expected)
    return core, cores
