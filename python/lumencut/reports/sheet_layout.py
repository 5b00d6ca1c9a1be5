"""The page of a sheet of vessels, drawn by matplotlib."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut.measuring.profile import Profile
from lumencut.measuring.profile_plot import draw
from lumencut.measuring.profile_sections import Mark

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Width of the page, of its margins, and of the text right of the rows (inches).
_WIDTH, _MARGIN, _TEXT = 16.5, 0.6, 3.4
#: Height of the two pictures, of the title above a row, and of the gap below it (inches).
_TREE, _TITLE, _GAP = 6.0, 0.3, 0.42
#: Height of a lumen map and of a plot of diameters, and bounds of that of a CPR (inches).
_MAP, _PLOT, _LEAST_CPR, _MOST_CPR = 0.7, 1.6, 0.5, 1.4
_MARK = "#c8102e"
_LETTERS = 8
#: Letters of a line of text right of a row, and most lines there.
_COLUMNS, _MOST_LINES = 52, 14


@dataclass(frozen=True, eq=False)
class Strip:
    """The row of one vessel; its pictures run from left to right along it.

    Attributes
    ----------
    title : str
        The id and the name of the vessel.
    length : float
        Its length (mm).
    cut : ndarray, uint8, shape (H, W, 4)
        The straightened CPR.
    width : float
        How many mm the CPR shows across the vessel.
    wall : ndarray, uint8, shape (H, W, 4), or None
        The lumen map.
    profile : Profile or None
        Its diameters.
    marks : tuple of Mark
        The places to mark.
    findings : tuple of str
        The text right of the row.
    """

    title: str
    length: float
    cut: npt.NDArray[np.uint8]
    width: float
    wall: npt.NDArray[np.uint8] | None
    profile: Profile | None
    marks: tuple[Mark, ...]
    findings: tuple[str, ...]

    def heights(self, millimetres: float) -> list[float]:
        """Return the heights of its parts from above, given the mm of an inch."""
        cut = float(np.clip(self.width / millimetres, _LEAST_CPR, _MOST_CPR))
        return [cut] if self.profile is None else [cut, _MAP, _PLOT]


def sheet_figure(
    tree: npt.NDArray[np.uint8], untangled: npt.NDArray[np.uint8] | str, rows: Sequence[Strip], note: str
) -> Figure:
    """Return the page: both pictures of the tree, and a row for each vessel."""
    from matplotlib import style
    from matplotlib.figure import Figure

    wide = _WIDTH - 2 * _MARGIN - _TEXT
    millimetres = max(row.length for row in rows) / wide
    tall = [_TITLE + sum(row.heights(millimetres)) + _GAP for row in rows]
    height = 2 * _MARGIN + _TREE + sum(tall)
    with style.context("default"):
        figure = Figure(figsize=(_WIDTH, height))
        page = _Page(figure, height)
        half = (_WIDTH - 3 * _MARGIN) / 2
        page.picture(tree, _MARGIN, _MARGIN, half, _TREE, "From the front")
        if isinstance(untangled, str):
            words = "\n".join(textwrap.wrap(f"Untangled: {untangled}", 2 * _COLUMNS))
            page.text(2 * _MARGIN + half, _MARGIN, words)
        else:
            page.picture(untangled, 2 * _MARGIN + half, _MARGIN, half, _TREE, "Untangled")
        top = _MARGIN + _TREE + _TITLE
        for row, used in zip(rows, tall, strict=True):
            page.row(row, top, wide, millimetres)
            top += used
        notice = "Lumencut is not a medical device (research, not for diagnosis)."
        page.text(_MARGIN, height - _MARGIN / 3, " ".join(filter(None, [note, notice])))
    return figure


class _Page:
    """Places in inches from the upper left corner of the page."""

    def __init__(self, figure: Figure, height: float) -> None:
        self._figure, self._height = figure, height

    def axes(self, left: float, top: float, width: float, height: float) -> Any:
        """Return axes at a place."""
        bottom = self._height - top - height
        made = self._figure.add_axes(
            (left / _WIDTH, bottom / self._height, width / _WIDTH, height / self._height)
        )
        made.tick_params(labelsize=_LETTERS, length=2, pad=1)
        return made

    def text(self, left: float, top: float, words: str, **how: Any) -> None:
        """Write a text whose upper left corner lies at a place."""
        place = left / _WIDTH, 1 - top / self._height
        self._figure.text(*place, words, fontsize=_LETTERS, va="top", parse_math=False, **how)

    def picture(
        self, image: npt.NDArray[np.uint8], left: float, top: float, width: float, height: float, title: str
    ) -> None:
        """Show a picture as large as it fits."""
        axes = self.axes(left, top, width, height)
        axes.imshow(image)
        axes.set_title(title, loc="left", fontsize=_LETTERS + 2)
        axes.set_axis_off()

    def row(self, row: Strip, top: float, wide: float, millimetres: float) -> None:
        """Draw a vessel: its parts share one axis of arc length."""
        self.text(_MARGIN, top, f"{row.title}, {row.length:.1f} mm", weight="bold")
        wrapped = [line for words in row.findings for line in textwrap.wrap(words, _COLUMNS)]
        if len(wrapped) > _MOST_LINES:
            wrapped = [*wrapped[: _MOST_LINES - 1], "…"]
        self.text(_WIDTH - _MARGIN - _TEXT + 0.15, top + _TITLE, "\n".join(wrapped))
        top += _TITLE
        width = row.length / millimetres
        heights = row.heights(millimetres)
        for number, height in enumerate(heights):
            axes = self.axes(_MARGIN, top, width, height)
            self._part(axes, row, number)
            axes.set_xlim(0, row.length)
            if number < len(heights) - 1:
                axes.set_xticklabels([])
            for mark in row.marks:
                style = "--" if mark.is_suggestion else "-"
                axes.axvline(mark.arc_length, color=_MARK, lw=0.8, ls=style)
            top += height

    def _part(self, axes: Any, row: Strip, number: int) -> None:
        if number == 0:
            half = row.width / 2
            axes.imshow(row.cut, extent=(0, row.length, -half, half), aspect="auto")
            axes.set_ylabel("mm", fontsize=_LETTERS, labelpad=0)
        elif number == 1:
            axes.imshow(row.wall, extent=(0, row.length, -180, 180), aspect="auto")
            axes.set_yticks([-90, 0, 90])
            axes.set_ylabel("wall (°)", fontsize=_LETTERS, labelpad=0)
        else:
            assert row.profile is not None
            draw(axes, row.profile, row.marks)
            axes.get_legend().remove()
            axes.set_ylabel("mm", fontsize=_LETTERS, labelpad=0)
            axes.set_xlabel("")
