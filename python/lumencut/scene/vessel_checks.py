"""Checks of values that a vessel has for each of its points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.checks import numbers
from lumencut.errors import VesselTreeError


def radii(radius: Any, count: int) -> npt.NDArray[np.float64]:
    """Return radii (mm) per point; a single radius applies to all points."""
    if not isinstance(radius, Sequence) and np.ndim(radius) == 0:
        radius = np.full(count, numbers(VesselTreeError, "radius of the vessel", radius, ()))
    return numbers(VesselTreeError, "radius of the vessel", radius, (-1,))


def shares(confidence: Any, count: int) -> npt.NDArray[np.float64]:
    """Return values from 0 to 1, one per point."""
    shares = numbers(VesselTreeError, "confidence of the vessel", confidence, (count,))
    if not ((shares >= 0) & (shares <= 1)).all():
        found = f"{shares.min():g} to {shares.max():g}"
        raise VesselTreeError("confidence of the vessel", found, "numbers from 0 to 1")
    return shares


def marks(bridged: Any, count: int) -> npt.NDArray[np.bool_]:
    """Return True or False per point."""
    try:
        marks = np.array(bridged)
    except ValueError as error:
        expected = f"True or False for each of {count} points"
        raise VesselTreeError("bridged points of the vessel", f"{bridged!r:.80}", expected) from error
    if marks.dtype != np.bool_ or marks.shape != (count,):
        found = f"{marks.dtype} of shape {marks.shape}"
        raise VesselTreeError(
            "bridged points of the vessel", found, f"True or False for each of {count} points"
        )
    marks.flags.writeable = False
    return marks
