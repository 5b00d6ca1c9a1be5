"""Convert arguments to arrays of a known shape, or raise an error that names the argument."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import LumencutError


def numbers(
    error: type[LumencutError], subject: str, value: Any, shape: tuple[int, ...]
) -> npt.NDArray[np.float64]:
    """Return ``value`` as a read-only float64 array of ``shape``; -1 in ``shape`` allows any length."""
    array = _floats(value)
    found = () if array is None else array.shape
    fits = len(found) == len(shape) and all(want in (-1, n) for want, n in zip(shape, found, strict=True))
    if array is None or not fits:
        wanted = " × ".join("n" if n < 0 else str(n) for n in shape) or "one number"
        raise error(subject, _short(value), f"numbers of shape {wanted}")
    array.flags.writeable = False
    return array


def number(error: type[LumencutError], subject: str, value: Any) -> float:
    """Return ``value`` as a float."""
    return float(numbers(error, subject, value, ()))


def flag(error: type[LumencutError], subject: str, value: Any) -> bool:
    """Return ``value`` as True or False; reject numbers."""
    if not isinstance(value, (bool, np.bool_)):
        raise error(subject, repr(value), "True or False")
    return bool(value)


def callback(error: type[LumencutError], subject: str, value: Any) -> None:
    """Reject anything except None and functions."""
    if value is not None and not callable(value):
        raise error(subject, _short(value), "a function, or None")


def integers(
    error: type[LumencutError], subject: str, value: Any, low: int, high: int, count: int
) -> tuple[int, ...]:
    """Return ``value`` as ``count`` integers from ``low`` to ``high``."""
    array = numbers(error, subject, value, (count,))
    if not ((array >= low) & (array <= high) & (array == np.floor(array))).all():
        found, what = (value[0], "a whole number") if count == 1 else (value, f"{count} whole numbers")
        raise error(subject, _short(found), f"{what} from {low} to {high}")
    return tuple(int(n) for n in array)


def choice(
    error: type[LumencutError], subject: str, value: Any, choices: Sequence[str], others: str = ""
) -> None:
    """Reject anything except these names; in the error, ``others`` describes further accepted values."""
    if not (isinstance(value, str) and value in choices):
        raise error(subject, _short(value), "one of " + ", ".join(map(repr, choices)) + others)


def _floats(value: Any) -> npt.NDArray[np.float64] | None:
    """Return a copy of an array of real numbers without a mask; None for anything else, such as text."""
    try:
        array = np.asarray(value)
        if value is None or array.dtype.kind not in "biufO" or np.ma.is_masked(value):
            return None
        with np.errstate(over="ignore"):
            return array.astype(np.float64)
    except (TypeError, ValueError, OverflowError):
        return None


def _short(value: Any) -> str:
    shape = getattr(value, "shape", None)
    if shape is not None and len(shape) > 0 and np.prod(shape) > 16:
        return f"an array of shape {tuple(shape)}"
    text = repr(value)
    return text if len(text) <= 80 else text[:77] + "..."
