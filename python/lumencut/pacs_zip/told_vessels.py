"""Vessels that the page measured, in the form of those that Python measured, for reports."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.dicom_objects.measured import Measured, measured
from lumencut.dicom_objects.study import Origin
from lumencut.errors import VesselTreeError
from lumencut.pacs_zip.given import Given, checked, is_number, is_text, points_of, refused
from lumencut.profile_sections import Mark
from lumencut.stenosis import METHODS, Stenosis
from lumencut.vessel import Vessel

_Floats = npt.NDArray[np.float64]

#: The numbers of a section, by their names in the JSON of measured vessels.
_COLUMNS = {
    "arc_length": "arc_length_mm",
    "diameter_equivalent": "diameter_equivalent_mm",
    "uncertainty": "uncertainty_mm",
    "diameter_min": "diameter_min_mm",
    "diameter_max": "diameter_max_mm",
    "diameter_mean": "diameter_mean_mm",
    "area": "area_mm2",
}
_BITS = {words: bit for _, bit, words, *_ in _lumencut.MEASURING_FLAGS}


class ToldProfile:
    """The sections of a vessel from the page, with the parts of a profile that plots and reports need.

    Parameters
    ----------
    told : Given
        A vessel of what ``lumencut measure -o x.json`` writes.
    contours : list
        The wall of the sections that were marked: their arc length (mm) and the points (mm, LPS).

    Raises
    ------
    FormatError
        For columns of different lengths, unknown flags, and contours of no section.
    """

    def __init__(self, told: Given, contours: list[Any]) -> None:
        sections = told.object("sections")
        columns = {name: sections.column(key) for name, key in _COLUMNS.items()}
        counts, flags = sections.items("counts"), sections.items("flags")
        lengths = {len(counts), len(flags), *map(len, columns.values())}
        if len(lengths) > 1 or not np.isfinite(columns["arc_length"]).all() or not counts:
            raise refused("columns of sections that do not belong together", "as many numbers in each")
        self.arc_length: _Floats = columns["arc_length"]
        self.diameter_equivalent: _Floats = columns["diameter_equivalent"]
        self.uncertainty: _Floats = columns["uncertainty"]
        self.diameter_min: _Floats = columns["diameter_min"]
        self.diameter_max: _Floats = columns["diameter_max"]
        self.diameter_mean: _Floats = columns["diameter_mean"]
        self.area: _Floats = columns["area"]
        self.fwhm: float = told.number("fwhm_mm")
        self.flags: npt.NDArray[np.uint32] = np.array([_bits(one) for one in flags], np.uint32)
        self._core: Any = _ToldCore(self.arc_length, np.array([one is True for one in counts]))
        self._origin: Origin | None = None
        self.contour: Mapping[int, _Floats] = dict(self._contour(one) for one in contours)

    def __len__(self) -> int:
        return len(self.arc_length)

    def _contour(self, given: Any) -> tuple[int, _Floats]:
        is_pair = isinstance(given, list) and len(given) == 2 and is_number(given[0])
        pair = checked(given, "a contour", "an arc length and points", lambda _: is_pair)
        return self._core.nearest(pair[0]), points_of(pair[1], "a contour")


@dataclass(frozen=True)
class _ToldCore:
    """The part of the core of a profile that plots and reports use."""

    arc_length: _Floats
    counts: npt.NDArray[np.bool_]

    def nearest(self, at: float) -> int:
        """Return the number of the section that is nearest to an arc length (mm), the first of two."""
        return int(np.argmin(np.abs(self.arc_length - at)))


@dataclass(frozen=True)
class _ToldGrade:
    """A stenosis from the page, in place of one graded by the core."""

    told: Given
    words: str

    def numbers(self) -> tuple[float, ...]:
        """Return percentage, place, diameter, its deviation, reference, and that of the percentage."""
        names = ("percent", "at_mm", "diameter_mm", "uncertainty_mm", "reference_mm", "percent_uncertainty")
        if any(np.isnan(self.told.number_or_nan(name)) for name in ("percent", "at_mm")):
            raise refused("a stenosis without its percentage and place", "both")
        return tuple(self.told.number_or_nan(name) for name in names)

    @property
    def references(self) -> list[tuple[float, float]]:
        """The places of the references: arc length and diameter of each (mm)."""
        places = self.told.objects("references")
        return [(one.number("arc_length_mm"), one.number("diameter_mm")) for one in places]

    @property
    def method(self) -> str:
        """The method of grading."""
        return checked(self.told.text("method"), "a method", " or ".join(METHODS), METHODS.__contains__)

    @property
    def doubts(self) -> list[str]:
        """Doubts about it."""
        return self.told.texts("doubts")

    def doubtful_words(self) -> str:
        """Return the sentence and the doubts, as the core words them."""
        return f"{self.words}. {' '.join(self.doubts)}" if self.doubts else self.words


@dataclass(frozen=True, eq=False)
class ToldVessel:
    """A vessel with what a reader marked on it.

    Attributes
    ----------
    profile : ToldProfile
        Its sections.
    marks : tuple of Mark
        The places of its plot.
    measured : Measured
        Its content in a structured report.
    """

    profile: ToldProfile
    marks: tuple[Mark, ...]
    measured: Measured


def told_vessel(numbers: Given, finding: Given, *, has_name: bool) -> ToldVessel:
    """Return a vessel of the page.

    Parameters
    ----------
    numbers : Given
        Its content in ``lumencut measure -o x.json``.
    finding : Given
        Its points (mm, LPS), its length (mm), the contours and the places that were marked, and the sentence
        of its stenosis, null where none is graded.
    has_name : bool
        Whether it is called by its name.

    Raises
    ------
    FormatError
        For anything that is not such a vessel.
    """
    profile = ToldProfile(numbers, finding.items("contours"))
    marks = tuple(_mark(one, profile) for one in finding.items("marks"))
    name = numbers.text_or_none("name") if has_name else None
    try:
        vessel = Vessel(finding.points("points"), name=name or None)
    except VesselTreeError as error:
        raise refused(f"an invalid vessel ({error.found})", error.expected) from error
    graded, words = numbers.object_or_none("stenosis"), finding.text_or_none("words")
    stenoses: tuple[Stenosis, ...] = ()
    if graded is not None:
        grade: Any = _ToldGrade(graded, words or "")
        stenoses = (Stenosis(grade),)
    marked = [mark.arc_length for mark in marks if not mark.is_suggestion]
    graded_at = [place for one in stenoses for place in (one.at, *(at for at, _ in one.references))]
    if any(profile._core.nearest(at) not in profile.contour for at in (*marked, *graded_at)):
        raise refused("a marked place without the contour of its section", "one for each")
    return ToldVessel(profile, marks, measured(profile, stenoses, vessel, marks))


def _bits(words: Any) -> int:
    """The bits of flags that are told by their words."""
    names = checked(words, "flags", "a list of words", lambda one: isinstance(one, list))
    return sum(_BITS[checked(one, "a flag", "the words of a flag", _BITS.__contains__)] for one in names)


def _mark(given: Any, profile: ToldProfile) -> Mark:
    """A place from the page: name, arc length (mm), and whether it is only a suggestion."""
    is_place = isinstance(given, list) and [type(one) for one in given[::2]] == [str, bool]
    place = checked(
        given, "a mark", "a name, an arc length and whether it is a suggestion", lambda _: is_place
    )
    name, at, is_offered = place
    at = checked(at, "a mark", "an arc length", is_number)
    diameter = float(profile.diameter_equivalent[profile._core.nearest(at)])
    name = checked(name, "a mark", "a name", is_text).removesuffix(" (suggestion)")
    return Mark(name, float(at), diameter, is_offered)
