"""What is counted in one view, and how the counts of several views become one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

#: What a measure counts in one view, by name: amounts that add up, arrays of single errors, or None for
#: what cannot be counted.
Amounts: TypeAlias = dict[str, Any]
#: The numbers of a table by the names of their columns; None where there is nothing that they could be of.
Columns: TypeAlias = dict[str, float | int | None]


def pooled(views: Sequence[Amounts]) -> Amounts:
    """Return the amounts of several views as those of one: sums, and arrays one after the other."""
    return {name: _together([view[name] for view in views]) for name in views[0]}


def _together(found: list[Any]) -> Any:
    if any(one is None for one in found):
        return None
    return np.concatenate(found) if isinstance(found[0], np.ndarray) else sum(found)


def ratio(part: float | None, whole: float | None) -> float | None:
    """Return a part of a whole, or None where there is no whole."""
    return None if part is None or not whole else float(part / whole)


def percent(part: float | None, whole: float | None) -> float | None:
    """Return a part of a whole in percent, or None where there is no whole."""
    share = ratio(part, whole)
    return None if share is None else 100.0 * share


def counted(which: npt.NDArray[np.bool_]) -> int:
    """Return how many are true."""
    return int(np.count_nonzero(which))
