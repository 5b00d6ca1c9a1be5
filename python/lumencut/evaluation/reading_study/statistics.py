"""Statistics of a reading study. Readers are the units: answers of one reader are not independent."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

#: Draws of the bootstrap; its seed is fixed, so that results repeat.
_DRAWS = 4000


@dataclass(frozen=True)
class Counts:
    """How many answers of each reader have a name, and how many answers each reader gave."""

    name: str
    chosen: npt.NDArray[np.int64]
    of: npt.NDArray[np.int64]

    @property
    def percent(self) -> float | None:
        """The share of all answers (percent); None without answers."""
        total = int(self.of.sum())
        return 100.0 * int(self.chosen.sum()) / total if total else None


def interval(counts: Counts) -> tuple[float | None, float | None]:
    """Return the 95 % interval of the share (percent): percentiles of the bootstrap over readers.

    It is None without answers, or with one reader.
    """
    if len(counts.of) < 2 or not counts.of.all():
        return None, None
    picks = np.random.default_rng(1).integers(len(counts.of), size=(_DRAWS, len(counts.of)))
    shares = 100.0 * counts.chosen[picks].sum(axis=1) / counts.of[picks].sum(axis=1)
    low, high = np.quantile(shares, [0.025, 0.975])
    return float(low), float(high)


def sign_test(ours: Counts, other: Counts) -> float:
    """Return the two-sided probability of the exact sign test of shares over readers, without ties."""
    difference = np.sign(ours.chosen * other.of - other.chosen * ours.of)
    plus, minus = int((difference > 0).sum()), int((difference < 0).sum())
    count = plus + minus
    tail = sum(math.comb(count, k) for k in range(min(plus, minus) + 1))
    return min(1.0, float(2 * tail / 2**count))


def holm(probabilities: Sequence[float]) -> list[float]:
    """Return probabilities after the correction for several tests.

    Holm, "A simple sequentially rejective multiple test procedure", Scandinavian Journal of Statistics 6(2),
    1979.
    """
    order = np.argsort(probabilities)
    corrected = [0.0] * len(probabilities)
    largest = 0.0
    for rank, number in enumerate(order):
        largest = max(largest, min(1.0, (len(order) - rank) * probabilities[number]))
        corrected[number] = largest
    return corrected


def agreement(votes: npt.NDArray[np.int64]) -> float | None:
    """Return Fleiss' kappa of votes, shape (questions, answers): 1 for equal votes, 0 for chance.

    It is None for fewer than two readers, or if all votes are the same. Fleiss, "Measuring nominal scale
    agreement among many raters", Psychological Bulletin 76(5), 1971, doi:10.1037/h0031619.
    """
    raters = int(votes[0].sum())
    if raters < 2:
        return None
    observed = ((votes**2).sum(axis=1) - raters) / (raters * (raters - 1))
    chance = float(((votes.sum(axis=0) / votes.sum()) ** 2).sum())
    return None if chance == 1.0 else float((observed.mean() - chance) / (1 - chance))
