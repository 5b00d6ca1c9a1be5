"""How two runs or readers of one cohort agree: Bland and Altman's limits, over vessels and over sections.

Bland and Altman, "Measuring agreement in method comparison studies", Statistical Methods in Medical Research
8(2), 1999, doi:10.1177/096228029900800204.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lumencut.cohort.distributions import written
from lumencut.cohort.result_tables import ResultTable

_Floats = npt.NDArray[np.float64]

#: Sections of two runs are the same place if their middles are at most this far apart (mm).
FARTHEST = 1.0
_OF_VESSELS = ("diameter_median_mm", "suggested_narrowest_mm", "length_mm")
_OF_SECTIONS = ("diameter_equivalent_mm", "diameter_min_mm", "area_mm2")
_KEY = ("id", "vessel", "name")
_CENTER = ("center_x_lps_mm", "center_y_lps_mm", "center_z_lps_mm")
_PLACE = ("counts", "uncertainty_mm", *_CENTER)
COLUMNS = (
    *(
        "over",
        "quantity",
        "pairs",
        "studies",
        "mean_difference",
        "mean_difference_low",
        "mean_difference_high",
    ),
    *("sd", "limit_low", "limit_high", "within_uncertainty"),
)
_NORMAL = 1.96

_Vessel = tuple[str, str]


@dataclass(frozen=True)
class Agreement:
    """One quantity of two runs at the same vessels or places.

    Attributes
    ----------
    over : {"vessels", "sections"}
        What the pairs are. Sections of one vessel are not independent: their limits are too narrow for
        other vessels.
    quantity : str
        The column of the table.
    studies : tuple of str
        The study of each pair.
    first, second : ndarray, shape (n,)
        The values, in the unit that the name of the column ends with.
    uncertainty : ndarray, shape (n,)
        The standard deviation of the differences expected from the uncertainties of both; NaN if the tables
        state none.
    """

    over: str
    quantity: str
    studies: tuple[str, ...]
    first: _Floats
    second: _Floats
    uncertainty: _Floats

    @property
    def differences(self) -> _Floats:
        """The second value minus the first one, shape (n,)."""
        return np.asarray(self.second - self.first)

    @property
    def bias(self) -> float:
        """The mean difference."""
        return float(np.mean(self.differences))

    @property
    def sd(self) -> float:
        """The standard deviation of the differences; NaN for a single pair."""
        return float(np.std(self.differences, ddof=1)) if len(self.first) > 1 else float("nan")

    @property
    def limits(self) -> tuple[float, float]:
        """The limits of agreement, which contain 95 % of normally distributed differences."""
        return self.bias - _NORMAL * self.sd, self.bias + _NORMAL * self.sd

    @property
    def within_uncertainty(self) -> float:
        """The share of differences within 1.96 of their stated standard deviations, or NaN."""
        known = np.isfinite(self.uncertainty)
        if not known.any():
            return float("nan")
        return float(np.mean(np.abs(self.differences[known]) <= _NORMAL * self.uncertainty[known]))

    @property
    def row(self) -> list[str]:
        """Return the fields in the order of `COLUMNS`."""
        half = _NORMAL * self.sd / np.sqrt(len(self.first))
        numbers = (
            self.bias,
            self.bias - half,
            self.bias + half,
            self.sd,
            *self.limits,
            self.within_uncertainty,
        )
        counts = (str(len(self.first)), str(len(set(self.studies))))
        return [self.over, self.quantity, *counts, *map(written, numbers)]


def agreements(first: Path, second: Path) -> list[Agreement]:
    """Return how two runs of one cohort agree, for each quantity that both have.

    Vessels match by name within a study, or by number if a vessel has no name or shares it. Sections match if
    their vessels match, their middles are at most 1 mm apart, and they count in both runs; each section of
    the second run is used at most once.

    Parameters
    ----------
    first, second : Path
        The folders of the results.

    Raises
    ------
    FileError, FormatError
        For a folder without the tables of a batch.
    """
    tables = [ResultTable(out, "vessels", (*_KEY, *_OF_VESSELS)) for out in (first, second)]
    found = [one for quantity in _OF_VESSELS if (one := _of_vessels(tables, quantity)) is not None]
    sections = [ResultTable(out, "sections", (*_KEY, *_PLACE, *_OF_SECTIONS)) for out in (first, second)]
    if not all(map(len, sections)):
        return found
    pairs = _same_places(*sections)
    if not len(pairs):
        return found
    found += [_of_sections(sections, pairs, quantity) for quantity in _OF_SECTIONS]
    return found


def _keys(table: ResultTable) -> list[_Vessel]:
    """Return study and vessel of each row; a vessel is known by its name if that is unique in the study."""
    rows = list(zip(table.words("id"), table.words("vessel"), table.words("name"), strict=True))
    holders = Counter((study, name) for study, _, name in set(rows))
    return [
        (study, f"name {name}" if name and holders[study, name] == 1 else f"number {vessel}")
        for study, vessel, name in rows
    ]


def _of_vessels(tables: Sequence[ResultTable], quantity: str) -> Agreement | None:
    """Return the agreement of one number per vessel; None if no vessel has it in both runs."""
    first, second = (dict(zip(_keys(table), table.numbers(quantity), strict=True)) for table in tables)
    both = [key for key in first if key in second and np.isfinite([first[key], second[key]]).all()]
    if not both:
        return None
    one, other = (np.array([found[key] for key in both]) for found in (first, second))
    unknown = np.full(len(both), np.nan)
    return Agreement("vessels", quantity, tuple(study for study, _ in both), one, other, unknown)


def _same_places(first: ResultTable, second: ResultTable) -> npt.NDArray[np.int64]:
    """Return the pairs of rows of both tables whose sections are the same place, shape (n, 2)."""
    others = _rows_of_vessels(second)
    centers, other_centers = _centers(first), _centers(second)
    pairs: list[tuple[int, int]] = []
    for key, rows in _rows_of_vessels(first).items():
        there = others.get(key)
        if there is None:
            continue
        taken: set[int] = set()
        for row in rows:
            distances = np.linalg.norm(other_centers[there] - centers[row], axis=1)
            nearest = int(distances.argmin())
            if distances[nearest] <= FARTHEST and nearest not in taken:
                taken.add(nearest)
                pairs.append((int(row), int(there[nearest])))
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)


def _rows_of_vessels(table: ResultTable) -> dict[_Vessel, npt.NDArray[np.int64]]:
    """Return the rows that count, by vessel."""
    rows: dict[_Vessel, list[int]] = {}
    for row, (key, counts) in enumerate(zip(_keys(table), table.words("counts"), strict=True)):
        if counts == "yes":
            rows.setdefault(key, []).append(row)
    return {key: np.array(found) for key, found in rows.items()}


def _centers(table: ResultTable) -> _Floats:
    """Return the middles of the sections, shape (n, 3), mm, LPS."""
    return np.stack([table.numbers(name) for name in _CENTER], axis=1)


def _of_sections(tables: Sequence[ResultTable], pairs: npt.NDArray[np.int64], quantity: str) -> Agreement:
    """Return the agreement of one number per section; its uncertainty is that of the equivalent diameter."""
    first, second = (table.numbers(quantity)[pairs[:, n]] for n, table in enumerate(tables))
    expected = np.full(len(pairs), np.nan)
    if quantity == "diameter_equivalent_mm":
        parts = [table.numbers("uncertainty_mm")[pairs[:, n]] for n, table in enumerate(tables)]
        expected = np.hypot(*parts)
    ids = tables[0].words("id")
    known = np.isfinite(first) & np.isfinite(second)
    studies = tuple(ids[row] for row in pairs[known, 0])
    return Agreement("sections", quantity, studies, first[known], second[known], expected[known])
