"""A vessel with its profile, places to check, and a stenosis that a reader marked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from lumencut import _lumencut
from lumencut.measuring.profile import Profile
from lumencut.measuring.profile_sections import Mark
from lumencut.measuring.stenosis import METHODS, Method, Stenosis
from lumencut.scene.vessel import Vessel

GROUPS: tuple[Literal["carotid", "coronary"], ...] = ("carotid", "coronary")


@dataclass(frozen=True)
class Marked:
    """The marks of a reader on one vessel for grading; see :meth:`lumencut.Profile.stenosis`.

    Values that the chosen method does not need are ignored.

    Attributes
    ----------
    at : float or None
        The place of a stenosis, an arc length (mm).
    references : tuple of float
        One or two places to compare it with (mm).
    method : {"nascet", "ecst", "area"}
        The method of grading.
    original, comparison : float or None
        The assumed original diameter, and that of a vessel like the normal one (mm).
    group : {"carotid", "coronary"} or None
        The kind of vessel, which selects the severity groups.
    diameters : tuple of float
        Places with noted diameters, regardless of grading (mm).
    """

    at: float | None = None
    references: tuple[float, ...] = ()
    method: Method = METHODS[0]
    original: float | None = None
    comparison: float | None = None
    group: Literal["carotid", "coronary"] | None = None
    diameters: tuple[float, ...] = ()


@dataclass(frozen=True)
class MeasuredVessel:
    """A vessel with its profile.

    Attributes
    ----------
    number : str
        Its id in the tree, or the ids of the vessels that it joins.
    vessel : Vessel
        Its centerline.
    profile : Profile
        Its sections.
    marks : tuple of Mark
        Places to check: marked by a reader, or suggested.
    """

    number: str
    vessel: Vessel
    profile: Profile
    marks: tuple[Mark, ...]
    _grade: _lumencut.Grade | None
    _suggested_name: str | None = None

    @classmethod
    def of(cls, number: str, vessel: Vessel, profile: Profile, marked: Marked) -> MeasuredVessel:
        """Return a measured vessel with the places that a reader marked on it.

        If a place cannot be graded, no error is raised: :attr:`not_graded` states the reason.

        Raises
        ------
        SettingsError
            For another method or group.
        """
        found = [Mark(*parts) for parts in _lumencut.marked_places(profile._core, marked)]
        return cls(number, vessel, profile, tuple(found), _lumencut.grade(profile._core, marked))

    @property
    def stenosis(self) -> Stenosis | None:
        """The stenosis that a reader marked; None if nothing is marked, or it is not graded."""
        graded = None if self._grade is None else self._grade.stenosis
        return None if graded is None else Stenosis(graded)

    @property
    def group(self) -> str | None:
        """The group of the stenosis, with its source; None if its method defines no groups."""
        return None if self._grade is None else self._grade.group

    @property
    def not_graded(self) -> str | None:
        """Why a marked place has no percentage: what is missing, or why a place is invalid."""
        return None if self._grade is None else self._grade.not_graded

    def with_suggested_name(self, suggested: str | None) -> MeasuredVessel:
        """Return the measured vessel with a name for a reader to confirm, unless it has a name."""
        named = None if suggested is None else _lumencut.suggested_for(self.vessel.name or "", suggested)
        return replace(self, _suggested_name=named)

    def unnamed(self) -> MeasuredVessel:
        """Return the measured vessel without its name."""
        return replace(self, vessel=Vessel(self.vessel.points, self.vessel.radius))

    @property
    def name(self) -> str:
        """The id and, if there is one, the name."""
        return self.number if self.vessel.name is None else f"{self.number} {self.vessel.name}"

    @property
    def parts(self) -> tuple[str, str | None, str | None, _lumencut.Profile, _lumencut.Grade | None]:
        """The data from which tables, JSON and reports are made."""
        return self.number, self.vessel.name, self._suggested_name, self.profile._core, self._grade

    @property
    def _not_suggested(self) -> tuple[str, ...]:
        """Why no place is suggested in addition to the marked ones, or a narrower place is not."""
        marked = [mark for mark in self.marks if not (mark.is_suggestion or mark.is_noted)]
        references = [mark.arc_length for mark in marked if mark.is_reference]
        places = [mark.arc_length for mark in marked if not mark.is_reference]
        at = places[0] if places else None
        return tuple(_lumencut.not_suggested_places(self.profile._core, at, references))

    @property
    def lines(self) -> list[str]:
        """The findings as lines: each percentage with its method, its references and diameters in mm."""
        lines = [] if self._grade is None else self._grade.lines(self.profile._core)
        if self.stenosis is None:
            lines = [*map(str, self.marks), *self._not_suggested, *lines]
        core, suggested = self.profile._core, self._suggested_name
        named = [] if suggested is None else [f"suggested name: {suggested}?"]
        walls = [words for words in (core.outer_stretch(), core.flap_stretch()) if words is not None]
        return [*named, *self.profile.not_measured(), *walls, *lines]


def vessels_csv(measured: Sequence[MeasuredVessel]) -> str:
    """Return vessels as one table: a line with the column names, then a line for each section.

    Columns with equal values in all lines of a vessel identify it, and give the place that a reader marked on
    it: ``stenosis``, ``doubts`` or ``not_graded``.
    """
    return _lumencut.vessels_csv([one.parts for one in measured])


def vessels_json(asked: Mapping[str, Any], measured: Sequence[MeasuredVessel]) -> str:
    """Return vessels with their stenoses as JSON; `asked` are the options of ``lumencut measure`` by name."""
    return _lumencut.vessels_json(asked, [one.parts for one in measured])
