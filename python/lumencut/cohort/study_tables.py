"""The tables of one study: a row for each vessel, and a row for each measured section."""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lumencut.base.csv_cells import read_rows
from lumencut.measuring.measured_vessel import MeasuredVessel, vessels_csv
from lumencut.measuring.profile_sections import counts
from lumencut.scene.vessel import Vessel

VESSEL_COLUMNS = (
    "id",
    "vessel",
    "name",
    "centerlines_from",
    "doubt",
    "length_mm",
    "radius_mean_mm",
    "confidence_mean",
    "sections",
    "sections_that_count",
    "diameter_median_mm",
    "uncertainty_median_mm",
    "suggested_narrowest_mm",
    "suggested_narrowest_uncertainty_mm",
    "suggested_narrowest_at_mm",
    "suggested_reference_before_mm",
    "suggested_reference_before_at_mm",
    "suggested_reference_after_mm",
    "suggested_reference_after_at_mm",
    "flags",
    "fwhm_mm",
    "fwhm_source",
    "wall_source",
    "not_measured",
)
#: Columns that precede those of ``lumencut measure``.
SECTION_BEGIN = ("id", "centerlines_from")


@dataclass(frozen=True)
class StudyVessel:
    """One vessel of a study, and its measures.

    Attributes
    ----------
    vessel : Vessel
        Its centerline.
    doubt : str
        Why it is uncertain; empty otherwise.
    measured : MeasuredVessel or None
        Its measures; None if not measured.
    not_measured : str
        Why it could not be measured; empty if not requested.
    """

    vessel: Vessel
    doubt: str = ""
    measured: MeasuredVessel | None = None
    not_measured: str = ""


def sections_rows(study_id: str, source: str, vessels: Sequence[StudyVessel]) -> list[list[str]]:
    """Return the column names and the rows of the sections of a study; empty without measures."""
    measured = [one.measured for one in vessels if one.measured is not None]
    if not measured:
        return []
    names, *rows = read_rows(io.StringIO(vessels_csv(measured), newline=""))
    return [[*SECTION_BEGIN, *names], *([study_id, source, *row] for row in rows)]


def flag_counts(sections: Sequence[Sequence[str]]) -> dict[str, Counter[str]]:
    """Return how many sections of each vessel have each flag, counted in the rows of sections."""
    if not sections:
        return {}
    vessel, flags = (sections[0].index(name) for name in ("vessel", "flags"))
    counts: dict[str, Counter[str]] = {}
    for row in sections[1:]:
        counts.setdefault(row[vessel], Counter()).update(word for word in row[flags].split("; ") if word)
    return counts


def vessels_rows(
    study_id: str, source: str, vessels: Sequence[StudyVessel], flags: dict[str, Counter[str]]
) -> list[list[str]]:
    """Return the column names and the rows of the vessels of a study."""
    rows = [list(VESSEL_COLUMNS)]
    for number, one in enumerate(vessels):
        found = {
            "id": study_id,
            "vessel": str(number),
            "name": one.vessel.name or "",
            "centerlines_from": source,
            "doubt": one.doubt,
            "length_mm": _number(one.vessel.length),
            "radius_mean_mm": _mean(one.vessel.radius),
            "confidence_mean": _mean(one.vessel.confidence),
            "flags": "; ".join(
                f"{word} {count}" for word, count in sorted(flags.get(str(number), {}).items())
            ),
            "not_measured": one.not_measured,
            **({} if one.measured is None else _measures(one.measured)),
        }
        rows.append([found.get(name, "") for name in VESSEL_COLUMNS])
    return rows


def _measures(measured: MeasuredVessel) -> dict[str, str]:
    """Return the columns of a measured vessel. Its places are suggestions to check, not findings."""
    profile = measured.profile
    numbers, counted = profile.diameter_equivalent, counts(profile)
    found = {
        "sections": str(len(profile)),
        "sections_that_count": str(int(np.count_nonzero(counted))),
        "diameter_median_mm": _median(numbers[counted]),
        "uncertainty_median_mm": _median(profile.uncertainty[counted]),
        "fwhm_mm": _number(profile.fwhm),
        "fwhm_source": profile.fwhm_source,
        "wall_source": profile.wall_source,
    }
    narrowest = profile.narrowest()
    if narrowest is None:
        return found
    found["suggested_narrowest_mm"] = _number(narrowest.diameter)
    found["suggested_narrowest_at_mm"] = _number(narrowest.arc_length)
    found["suggested_narrowest_uncertainty_mm"] = _number(profile.diameter_at(narrowest.arc_length)[1])
    places = profile.suggested_references(narrowest.arc_length)
    for side, place in zip(("before", "after"), places, strict=True):
        if place is not None:
            found[f"suggested_reference_{side}_mm"] = _number(place.diameter)
            found[f"suggested_reference_{side}_at_mm"] = _number(place.arc_length)
    return found


def _number(value: float) -> str:
    return f"{value:.7g}" if np.isfinite(value) else ""


def _mean(values: object) -> str:
    return "" if values is None else _number(float(np.mean(np.asarray(values))))


def _median(values: object) -> str:
    finite = np.asarray(values)[np.isfinite(np.asarray(values))]
    return _number(float(np.median(finite))) if len(finite) else ""
