"""Colours for measured values, and what tells a reader which colour is which value."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

#: Viridis at even steps: from dark blue over green to yellow, of evenly rising lightness, so that it also
#: reads in grey and by those who see few colours. By Nathaniel Smith and Stéfan van der Walt, dedicated to
#: the public domain (CC0).
_VIRIDIS = (
    (68, 1, 84),
    (72, 40, 120),
    (62, 74, 137),
    (49, 104, 142),
    (38, 130, 142),
    (31, 158, 137),
    (53, 183, 121),
    (109, 205, 89),
    (180, 222, 44),
    (253, 231, 37),
)


def coloured(
    value: npt.NDArray[np.float32], ends: tuple[float, float], *, grey: bool = False
) -> npt.NDArray[np.uint8]:
    """Return values (H, W) as RGBA, uint8, shape (H, W, 4), from the first colour at one end to the last.

    Values that are not finite are transparent.
    """
    low, high = ends
    is_there = np.isfinite(value)
    share = np.clip((np.where(is_there, value, low) - low) / (high - low), 0.0, 1.0)
    table = np.array([(0, 0, 0), (255, 255, 255)] if grey else _VIRIDIS, dtype=np.float64)
    steps = np.linspace(0.0, 1.0, len(table))
    image = np.zeros((*value.shape, 4), np.uint8)
    for channel in range(3):
        image[..., channel] = np.round(np.interp(share, steps, table[:, channel]))
    image[..., 3] = 255
    image[~is_there] = 0
    return image


def with_scale(
    image: npt.NDArray[np.uint8],
    places: Iterable[tuple[str, npt.NDArray[np.float64]]],
    scale: tuple[float, float, str] | None,
) -> npt.NDArray[np.uint8]:
    """Return a copy of an RGBA picture (H, W, 4) with names at places, and the scale of its colours.

    Parameters
    ----------
    image : numpy.ndarray, uint8, shape (H, W, 4)
        The picture; a side below 200 pixels gets no labels.
    places : iterable of (str, numpy.ndarray of shape (2,))
        Names, each with column and row of its place.
    scale : (float, float, str), optional
        The values at both ends of the colours, and their unit.
    """
    from lumencut.annotation import SMALLEST_SIDE
    from lumencut.lettering import Sheet

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
