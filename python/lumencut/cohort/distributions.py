"""Distributions of measures over the vessels of a cohort, and over those of each name."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lumencut.cohort.result_tables import ResultTable

QUANTITIES = (
    "length_mm",
    "radius_mean_mm",
    "diameter_median_mm",
    "uncertainty_median_mm",
    "suggested_narrowest_mm",
)
COLUMNS = ("vessels", "quantity", "count", "mean", "sd", "min", "q1", "median", "q3", "max")


@dataclass(frozen=True)
class Distribution:
    """The distribution of one quantity over some vessels.

    Attributes
    ----------
    vessels : str
        The name of the vessels, or "all".
    quantity : str
        The column of ``vessels.csv``.
    count : int
        The number of vessels that have it.
    mean, sd : float
        The mean and the standard deviation (of a sample; NaN for a single vessel).
    quartiles : tuple of 5 float
        The minimum, the quartiles and the maximum.
    """

    vessels: str
    quantity: str
    count: int
    mean: float
    sd: float
    quartiles: tuple[float, ...]

    @property
    def row(self) -> list[str]:
        """Return the fields in the order of `COLUMNS`."""
        numbers = (self.mean, self.sd, *self.quartiles)
        return [self.vessels, self.quantity, str(self.count), *map(written, numbers)]


def written(number: float) -> str:
    """Return a number as the tables show it: with five digits, empty for NaN."""
    return f"{number:.5g}" if np.isfinite(number) else ""


def states_of(out: Path) -> tuple[Counter[str], Counter[str]]:
    """Return the number of studies in each state, and the reasons of failed and skipped studies."""
    studies = ResultTable(out, "studies", ("state", "reason"))
    states = studies.words("state")
    reasons = studies.words("reason")
    given = (reason for state, reason in zip(states, reasons, strict=True) if state != "done")
    return Counter(states), Counter(given)


def distributions(out: Path) -> list[Distribution]:
    """Return the distributions over all vessels of a cohort, then over those of each name, alphabetically.

    Raises
    ------
    FileError, FormatError
        For a folder without the tables of a batch.
    """
    vessels = ResultTable(out, "vessels", ("name", *QUANTITIES))
    names = np.array(vessels.words("name"), dtype=object)
    groups = {"all": np.ones(len(names), dtype=bool)}
    groups |= {name: names == name for name in sorted({name for name in names if name})}
    found = []
    for group, chosen in groups.items():
        for quantity in QUANTITIES:
            values = vessels.numbers(quantity)[chosen]
            values = values[np.isfinite(values)]
            if len(values):
                found.append(_distribution(group, quantity, values))
    return found


def _distribution(group: str, quantity: str, values: npt.NDArray[np.float64]) -> Distribution:
    sd = float(np.std(values, ddof=1)) if len(values) > 1 else float("nan")
    quartiles = tuple(float(value) for value in np.percentile(values, (0, 25, 50, 75, 100)))
    return Distribution(group, quantity, len(values), float(np.mean(values)), sd, quartiles)
