"""Colours for measured values, and their legends."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut


def coloured(
    value: npt.NDArray[np.float32], ends: tuple[float, float], *, grey: bool = False
) -> npt.NDArray[np.uint8]:
    """Return values (H, W) as RGBA, uint8, shape (H, W, 4), coloured from the first colour to the last.

    Values that are not finite are transparent.
    """
    return _lumencut.coloured(value, ends, grey)


def with_scale(
    image: npt.NDArray[np.uint8],
    places: Iterable[tuple[str, npt.NDArray[np.float64]]],
    scale: tuple[float, float, str] | None,
) -> npt.NDArray[np.uint8]:
    """Return a copy of an RGBA picture (H, W, 4) with names at given positions, and a colour scale.

    Parameters
    ----------
    image : numpy.ndarray, uint8, shape (H, W, 4)
        The picture; a side below 200 pixels gets no labels.
    places : iterable of (str, numpy.ndarray of shape (2,))
        Names, each with the column and row at which to write it.
    scale : (float, float, str), optional
        The values at both ends of the colours, and their unit.
    """
    from lumencut.pictures.annotation import SMALLEST_SIDE
    from lumencut.pictures.lettering import Sheet

    if min(image.shape[:2]) < SMALLEST_SIDE:
        return image.copy()
    sheet = Sheet(image)
    for name, (column, row) in places:
        if np.isfinite([column, row]).all():
            sheet.write(name, (float(column), float(row)), "mm")
    if scale is None:
        return sheet.pixels()
    low, high, unit = scale
    width, height = sheet.size
    bar = max(8, sheet.line_height // 2)
    top, bottom = height // 3, 2 * height // 3
    right = width - sheet.margin
    sheet.write(f"{high:g} {unit}", (right, top - sheet.margin // 2), "rd")
    sheet.write(f"{low:g} {unit}", (right, bottom + sheet.margin // 2), "ra")
    labelled = sheet.pixels()
    ramp = np.linspace(high, low, bottom - top, dtype=np.float32)[:, None].repeat(bar, axis=1)
    labelled[top:bottom, right - bar : right] = coloured(ramp, (low, high))
    return labelled
