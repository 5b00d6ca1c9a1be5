"""Counts of one view, and how the counts of several views are combined."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

#: Counts of a measure in one view, by name: sums, arrays of errors, or None if it cannot be counted.
Amounts: TypeAlias = dict[str, Any]
#: The numbers of a table by column; None if undefined.
Columns: TypeAlias = dict[str, float | int | None]


def pooled(views: Sequence[Amounts]) -> Amounts:
    """Combine the amounts of several views: add sums, concatenate arrays."""
    return {name: _combined([view[name] for view in views]) for name in views[0]}


def _combined(found: list[Any]) -> Any:
    if any(one is None for one in found):
        return None
    return np.concatenate(found) if isinstance(found[0], np.ndarray) else sum(found)


def ratio(part: float | None, whole: float | None) -> float | None:
    """Return part / whole, or None if whole is 0."""
    return None if part is None or not whole else float(part / whole)


def percent(part: float | None, whole: float | None) -> float | None:
    """Return part / whole in percent, or None if whole is 0."""
    share = ratio(part, whole)
    return None if share is None else 100.0 * share


def counted(which: npt.NDArray[np.bool_]) -> int:
    """Return the number of true values."""
    return int(np.count_nonzero(which))
