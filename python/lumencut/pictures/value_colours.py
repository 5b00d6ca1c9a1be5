"""Colours for measured values, and their legends."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.pickles import by_name

if TYPE_CHECKING:
    from lumencut.pictures.lettering import Sheet


@by_name
@dataclass(frozen=True)
class Legend:
    """What colours mean.

    Attributes
    ----------
    words, unit : str
        The quantity in words, which may be empty, and its unit.
    low, high : float
        The values of the first and of the last colour.
    colours : str
        The name of the colours.
    """

    words: str
    unit: str
    low: float
    high: float
    colours: str

    def __str__(self) -> str:
        """Return the quantity and its range."""
        return f"{self.words} from {self.low:g} to {self.high:g} {self.unit}"


def coloured(
    value: npt.NDArray[np.float32], ends: tuple[float, float], colours: str = "viridis"
) -> npt.NDArray[np.uint8]:
    """Return values (H, W) as RGBA, uint8, shape (H, W, 4), coloured from the first colour to the last.

    Values that are not finite are transparent.
    """
    return _lumencut.coloured(value, ends, colours)


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
    from lumencut.pictures.lettering import SMALLEST_SIDE, Sheet

    if min(image.shape[:2]) < SMALLEST_SIDE:
        return image.copy()
    sheet = Sheet(image)
    for name, (column, row) in places:
        if np.isfinite([column, row]).all():
            sheet.write(name, (float(column), float(row)), "mm")
    if scale is not None:
        low, high, unit = scale
        write_legend(sheet, Legend("", unit, low, high, "viridis"))
    return sheet.pixels()


def write_legend(sheet: Sheet, legend: Legend) -> None:
    """Draw a colour scale at the right edge, with the quantity and its values at both ends."""
    width, height = sheet.size
    bar = max(8, sheet.line_height // 2)
    # Leaves the middle of the edge to the letter of the patient's side.
    top, bottom = (height // 3, 2 * height // 3) if not legend.words else (height // 8, 3 * height // 8)
    right = width - sheet.margin
    above = top - sheet.margin // 2
    sheet.write(f"{legend.high:g} {legend.unit}", (right, above), "rd")
    if legend.words:
        sheet.write(legend.words, (right, above - sheet.line_height), "rd")
    sheet.write(f"{legend.low:g} {legend.unit}", (right, bottom + sheet.margin // 2), "ra")
    ends = legend.low, legend.high
    ramp = np.linspace(legend.high, legend.low, bottom - top, dtype=np.float32)[:, None]
    sheet.paste(coloured(ramp.repeat(bar, axis=1), ends, legend.colours), (right - bar, top))
