"""The lumen of a vessel in two scans, compared."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import numbers
from lumencut.base.paths import WRITABLE, checked_path, write_text
from lumencut.base.pickles import by_name
from lumencut.errors import FormatError, MeasuringError
from lumencut.measuring.profile import Profile
from lumencut.scene.patients import Patient

_Floats = npt.NDArray[np.float64]

_ENDINGS = (".csv", ".json", ".html", ".htm")


@by_name
class Change(NamedTuple):
    """A part of a vessel that is wider or narrower in the later scan; all numbers in mm.

    Attributes
    ----------
    start, end : float
        Its ends, arc lengths on the earlier vessel.
    at, later_at : float
        The place of the largest difference, on both vessels.
    before, before_uncertainty, after, after_uncertainty : float
        The diameters there, with their standard deviations.
    difference, uncertainty : float
        The later diameter minus the earlier one, and its standard deviation.
    """

    start: float
    end: float
    at: float
    later_at: float
    before: float
    before_uncertainty: float
    after: float
    after_uncertainty: float
    difference: float
    uncertainty: float


class Comparison:
    """A vessel before and after; :func:`lumencut.compare_scans` makes it.

    Arrays have one row for each section of the earlier profile, n in all; what is not measured in both scans
    is NaN. Diameters are those of circles of the same area.
    """

    def __init__(self, core: _lumencut.Comparison) -> None:
        self._core = core

    def __repr__(self) -> str:
        return f"Comparison({len(self._core.at)} sections, {len(self.changes)} changes)"

    def __str__(self) -> str:
        """What changed, one sentence in each line."""
        return "\n".join(self._core.lines)

    @property
    def arc_length(self) -> _Floats:
        """Arc length on the earlier and on the later vessel, shape (n, 2), mm."""
        return self._core.at

    @property
    def diameters(self) -> _Floats:
        """Earlier and later diameter, shape (n, 2), mm."""
        return self._core.diameter

    @property
    def uncertainties(self) -> _Floats:
        """The standard deviations of :attr:`diameters`, shape (n, 2), mm."""
        return self._core.uncertainty

    @property
    def difference(self) -> _Floats:
        """The later diameter minus the earlier one, shape (n,), mm."""
        return self._core.difference[:, 0]

    @property
    def difference_uncertainty(self) -> _Floats:
        """The standard deviation of :attr:`difference`, from both diameters and from the places, (n,), mm."""
        return self._core.difference[:, 1]

    @property
    def changes(self) -> tuple[Change, ...]:
        """Parts that differ by more than two standard deviations over at least 2 mm, in order."""
        return tuple(
            Change(*ends, *places, before, unsure, after, later_unsure, *difference)
            for ends, places, (before, after), (unsure, later_unsure), difference in self._core.changes
        )

    @property
    def typical_difference(self) -> float:
        """The median of :attr:`difference` (mm): far from 0 where the scans themselves differ."""
        return self._core.typical

    @property
    def matched(self) -> str:
        """How the vessels were matched, and how sure the places are."""
        return self._core.matched[0]

    @property
    def later_from_earlier(self) -> _Floats:
        """The rigid motion of the vessel from the earlier scan to the later one, shape (4, 4), mm, LPS."""
        made = np.eye(4)
        made[:3, :3] = self._core.motion[:9].reshape(3, 3).T
        made[:3, 3] = self._core.motion[9:]
        return made

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a table (``.csv``), JSON (``.json``) or a report (``.html``).

        Raises
        ------
        FormatError
            For another extension.
        FileError
            If the file cannot be written.
        """
        save_all([self], path)


def save_all(compared: list[Comparison], path: str | os.PathLike[str]) -> None:
    """Write compared vessels: ``.csv`` and ``.json`` hold one vessel, ``.html`` all of them."""
    checked = checked_path(path, WRITABLE)
    ending = checked.suffix.lower()
    if ending not in _ENDINGS:
        raise FormatError(str(checked), f"the extension {checked.suffix!r}", ", ".join(_ENDINGS))
    cores = [one._core for one in compared]
    made = {".csv": cores[0].csv, ".json": cores[0].json}
    write_text(checked, made[ending]() if ending in made else _lumencut.comparison_report(cores))


def compare_scans(
    earlier: Profile,
    later: Profile,
    pairs: Iterable[tuple[float, float]] = (),
    *,
    vessel: str = "vessel",
    scans: tuple[str, str] = ("earlier scan", "later scan"),
    other_patient: bool = False,
) -> Comparison:
    """Compare the lumen of a vessel in two scans, such as before and after a treatment.

    Places that belong together are found by the shape of both lines, after the rigid motion that fits best.
    If the shape does not determine them, as in a straight vessel, at least two branches do, or `pairs`.
    A difference counts as a change if it is larger than two standard deviations over at least 2 mm. Its
    standard deviation combines those of both diameters and of the places.

    Parameters
    ----------
    earlier, later : Profile
        The vessel in both scans; :func:`lumencut.measure` makes them.
    pairs : iterable of pairs of float, optional
        Places that belong together: arc lengths on the earlier and on the later vessel (mm). With one pair,
        lengths are equal on both; between several pairs they are interpolated.
    vessel : str, default "vessel"
        What the vessel is called in reports.
    scans : pair of str
        What the scans are called in reports.
    other_patient : bool, default False
        Compare scans of two patients too; the result states both.

    Raises
    ------
    MeasuringError
        If the vessels do not match, if nothing determines the places, for pairs that are not on the vessels
        or contradict each other, or for scans of two patients.
    """
    for what, given in (("earlier profile", earlier), ("later profile", later)):
        if not isinstance(given, Profile):
            raise MeasuringError(what, type(given).__name__, "a Profile")
    checked = [tuple(numbers(MeasuringError, "pair of places", pair, (2,)).tolist()) for pair in pairs]
    both = (earlier._core, later._core)
    stated = (_stated(earlier), _stated(later))
    return Comparison(_lumencut.compare_scans(both, checked, vessel, scans, stated, other_patient))


def _stated(profile: Profile) -> tuple[str, str, str]:
    """Return patient ID, issuer and modality of the scan; empty where its file states nothing."""
    study = None if profile._origin is None else profile._origin.study
    if study is None:
        return "", "", ""
    patient = Patient.in_header(study.header)
    return patient.id, patient.issuer, study.text("Modality")
