"""The content of a structured report: the places that a reader marked, never suggestions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut.dicom.writing.codes import DISTAL_REFERENCE, LUMEN_MINIMUM, PROXIMAL_REFERENCE, Coded
from lumencut.errors import MeasuringError
from lumencut.measuring.flags import Flag
from lumencut.measuring.profile_numbers import ProfileNumbers
from lumencut.measuring.profile_sections import Mark
from lumencut.measuring.stenosis import Stenosis
from lumencut.scene.vessel import Vessel


@dataclass(frozen=True, eq=False)
class Place:
    """A section that a reader marked.

    Attributes
    ----------
    kind : (str, str, str)
        The code of what was marked.
    marked : float
        The place that the reader marked (mm along the vessel).
    arc_length : float
        The place of the nearest measured section (mm).
    contour : numpy.ndarray, shape (m, 3)
        The wall of the lumen (mm, LPS).
    flags : Flag
        The flags of the section, such as a contour by hand.
    equivalent, uncertainty : float
        The diameter of a circle of the same area, and its standard deviation (mm).
    mean, shortest, longest : float
        Diameters (mm).
    area : float
        The area of the lumen (mm²).
    """

    kind: Coded
    marked: float
    arc_length: float
    contour: npt.NDArray[np.float64]
    flags: Flag
    equivalent: float
    uncertainty: float
    mean: float
    shortest: float
    longest: float
    area: float


@dataclass(frozen=True, eq=False)
class Measured:
    """A vessel with the marks of a reader.

    Attributes
    ----------
    name : str or None
        Its name.
    points : numpy.ndarray, shape (n, 3)
        The centerline (mm, LPS).
    length : float
        Its length (mm).
    places : tuple of Place
        The marked sections.
    stenoses : tuple of Stenosis
        Its graded stenoses.
    flags : Flag
        The flags of all its sections together.
    """

    name: str | None
    points: npt.NDArray[np.float64]
    length: float
    places: tuple[Place, ...]
    stenoses: tuple[Stenosis, ...]
    flags: Flag


def measured(
    profile: ProfileNumbers,
    stenoses: Sequence[Stenosis],
    vessel: Vessel | None = None,
    marks: Sequence[Mark] = (),
) -> Measured:
    """Return the content of a report for a profile of :func:`lumencut.measure`.

    Parameters
    ----------
    profile : Profile
        The profile.
    stenoses : sequence of Stenosis
        Its graded stenoses.
    vessel : Vessel, optional
        The vessel under the name that the report shall use, instead of the measured vessel.
    marks : sequence of Mark, default ()
        The marks of a reader that are not graded; suggestions are never used.

    Raises
    ------
    MeasuringError
        For anything that is not a stenosis, or a stenosis at a place beyond the vessel.
    """
    for one in stenoses:
        if not isinstance(one, Stenosis):
            expected, mend = "Stenosis objects", "give what profile.stenosis returned"
            raise MeasuringError("stenoses of the report", type(one).__name__, expected, mend)
        if not 0 <= one.at <= profile.arc_length[-1]:
            found = f"a stenosis at {one.at:.1f} mm of a vessel of {profile.arc_length[-1]:.1f} mm"
            raise MeasuringError("stenoses of the report", found, "stenoses of this vessel")
    kinds: dict[float, Coded] = {}
    for one in stenoses:
        kinds[one.at] = LUMEN_MINIMUM
        for place, _ in one.references:
            kinds.setdefault(place, PROXIMAL_REFERENCE if place < one.at else DISTAL_REFERENCE)
    if not stenoses:
        kinds = _marked_kinds([mark for mark in marks if not mark.is_suggestion])
    places = tuple(_place(profile, at, kind) for at, kind in sorted(kinds.items()))
    vessel = vessel or profile._vessel
    if vessel is None:
        raise MeasuringError("profile of the report", "a profile without its vessel", "one of measure")
    flags = Flag(int(np.bitwise_or.reduce(profile.flags)))
    return Measured(vessel.name, vessel.points, vessel.length, places, tuple(stenoses), flags)


def _marked_kinds(marks: Sequence[Mark]) -> dict[float, Coded]:
    """Yield the kind of each marked place; skip references without a place and noted diameters."""
    at = next((mark.arc_length for mark in marks if not (mark.is_reference or mark.is_noted)), None)
    if at is None:
        return {}
    beside = [mark.arc_length for mark in marks if mark.is_reference]
    return {at: LUMEN_MINIMUM} | {
        place: PROXIMAL_REFERENCE if place < at else DISTAL_REFERENCE for place in beside
    }


def _place(profile: ProfileNumbers, at: float, kind: Coded) -> Place:
    number = profile._core.nearest(at)
    names = ("diameter_equivalent", "uncertainty", "diameter_mean", "diameter_min", "diameter_max", "area")
    values = (float(getattr(profile, name)[number]) for name in names)
    flags = Flag(int(profile.flags[number]))
    return Place(kind, at, float(profile.arc_length[number]), profile.contour[number], flags, *values)
