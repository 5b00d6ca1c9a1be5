"""A vessel with its profile and what is said of it: places to look at, a stenosis that a reader marked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from lumencut import _lumencut
from lumencut.profile import Profile
from lumencut.profile_sections import Mark, marks
from lumencut.stenosis import METHODS, Method, Stenosis
from lumencut.vessel import Vessel

#: The vessels whose stenoses have groups.
GROUPS: tuple[Literal["carotid", "coronary"], ...] = ("carotid", "coronary")


@dataclass(frozen=True)
class Marked:
    """What a reader marked on one vessel; see :meth:`lumencut.Profile.stenosis`.

    Attributes
    ----------
    at : float or None
        The place of a stenosis, an arc length (mm); nothing is marked without it.
    references : tuple of float
        One or two places to compare it with (mm).
    method : {"nascet", "ecst", "area"}
        How it is graded.
    original, comparison : float or None
        The assumed original diameter, and that of a vessel like the normal one (mm).
    group : {"carotid", "coronary"} or None
        Which vessel it is, for the groups of the field.
    """

    at: float | None = None
    references: tuple[float, ...] = ()
    method: Method = METHODS[0]
    original: float | None = None
    comparison: float | None = None
    group: Literal["carotid", "coronary"] | None = None

    def stenosis(self, profile: Profile) -> Stenosis | None:
        """Return the stenosis, or None where only a place is marked or nothing is."""
        if self.at is None or not (self.references or self.method == "ecst"):
            return None
        references = self.references or None
        return profile.stenosis(self.at, references, self.method, self.original, comparison=self.comparison)


@dataclass(frozen=True)
class MeasuredVessel:
    """A vessel with its profile.

    Attributes
    ----------
    number : str
        Its id in the tree, or those of the vessels that it is made of.
    vessel : Vessel
        Its centerline.
    profile : Profile
        Its sections.
    marks : tuple of Mark
        Places to look at: those that a reader marked, or suggestions.
    stenosis : Stenosis or None
        The stenosis that a reader marked.
    group : str or None
        The group of that, with its source.
    """

    number: str
    vessel: Vessel
    profile: Profile
    marks: tuple[Mark, ...]
    stenosis: Stenosis | None
    group: str | None

    @classmethod
    def of(cls, number: str, vessel: Vessel, profile: Profile, marked: Marked) -> MeasuredVessel:
        """Return a measured vessel with what a reader marked on it.

        Raises
        ------
        MeasuringError
            For places that cannot be graded.
        """
        stenosis = marked.stenosis(profile)
        found = marks(profile, marked.at, marked.references)
        group = None
        if stenosis is not None and marked.group is not None:
            group = stenosis.group(marked.group)
        return cls(number, vessel, profile, tuple(found), stenosis, group)

    @property
    def name(self) -> str:
        """The id and, where it has one, the name."""
        return self.number if self.vessel.name is None else f"{self.number} {self.vessel.name}"

    @property
    def told(self) -> list[str]:
        """What there is to say of it, in lines: each percentage with its method, its references and mm."""
        if self.stenosis is None:
            return [str(mark) for mark in self.marks] or ["no section counts: see the flags"]
        group = [] if self.group is None else [f"group of the field: {self.group}"]
        return [str(self.stenosis), *group]


def profiles_of(measured: Sequence[MeasuredVessel]) -> list[tuple[dict[str, str], Profile]]:
    """Return profiles with the columns that say in a table whose they are."""
    return [({"vessel": one.number, "name": one.vessel.name or ""}, one.profile) for one in measured]


def vessels_json(asked: Mapping[str, Any], measured: Sequence[MeasuredVessel]) -> str:
    """Return vessels with their stenoses as JSON; `asked` are the options of ``lumencut measure`` by name."""
    parts = [
        (
            one.number,
            one.vessel.name,
            one.profile._core,
            None if one.stenosis is None else one.stenosis._graded,
            one.group,
        )
        for one in measured
    ]
    return _lumencut.vessels_json(asked, parts)
