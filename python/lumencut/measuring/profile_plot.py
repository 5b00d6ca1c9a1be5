"""The diameter of a vessel by its arc length, drawn by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lumencut import _lumencut
from lumencut.base.paths import replace_whole
from lumencut.errors import MissingPackageError
from lumencut.measuring.plot_pixels import PER_INCH, plot_pixels
from lumencut.measuring.profile_numbers import ProfileNumbers
from lumencut.measuring.profile_sections import Mark

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Resolution of pictures (pixels per inch).
_DPI = 150

#: Size of a plot, and the width of its legend next to the frame (plot pixels).
_WIDTH, _HEIGHT, _LEGEND = 1000.0, 380.0, 246.0

#: Letters of 11 plot pixels, which fit the margins of the frame (points).
_LETTERS = 11 / PER_INCH * 72

_FRAME = _lumencut.CHART_FRAME
_LINE, _LEFT_OUT, _MARKS = "#1f4e9c", "#808080", "#c8102e"


def check_matplotlib() -> None:
    """Raise an error without matplotlib.

    Raises
    ------
    MissingPackageError
    """
    try:
        import matplotlib as mpl  # noqa: F401 - whether it is there
    except ImportError as error:
        mend = 'pip install "lumencut[plot]"'
        raise MissingPackageError("plot", "no package matplotlib", "the extra [plot]", mend) from error


def new_axes() -> Axes:
    """Return the axes of a new figure of ``matplotlib.pyplot``."""
    check_matplotlib()
    from matplotlib import pyplot as plt

    figure = plt.figure(figsize=(_WIDTH / PER_INCH, _HEIGHT / PER_INCH))
    return _framed(figure, 0, 1)


def draw(axes: Axes, sections: ProfileNumbers, marks: Sequence[Mark]) -> None:
    """Draw the diameters of sections, their flags and marked places."""
    from lumencut.measuring.plot_ticks import ChartTicks

    chart = _lumencut.diameter_chart(sections._core, plot_pixels(axes)[1])
    x, top, wide = sections.arc_length, chart["top"], np.array(chart["width"])
    deviations = f"± {_FRAME['deviations']:g} standard deviations (noise and fit)"
    for (low, high), alpha, label in (
        (chart["range"], 0.16, "shortest to longest diameter"),
        (chart["spread"], 0.4, deviations),
    ):
        axes.fill_between(x, low, high, color=_LINE, alpha=alpha, lw=0, label=label)
    axes.plot(x, wide, color=_LINE, lw=1.6, label="diameter of a circle of the same area")
    axes.plot(x[chart["isolated"]], wide[chart["isolated"]], ".", color=_LINE, ms=4)
    if chart["left_out"]:
        axes.plot(
            *zip(*chart["left_out"], strict=True), ".", color=_LEFT_OUT, ms=3, mfc="none", mew=0.6,
            label="excluded: see the flags",
        )  # fmt: skip
    if chart["limit"] is not None:
        limit, words = chart["limit"]
        axes.axhline(limit, color=_LEFT_OUT, lw=0.8, ls=":", label=f"{words} mm")
    _draw_marks(axes, marks)
    below = _draw_flags(axes, chart["flags"], chart["row"])
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(-below * top / (1 - below), top)
    axes.xaxis.set_major_locator(ChartTicks(is_along=True))
    axes.yaxis.set_major_locator(ChartTicks(is_along=False))
    axes.set_xlabel("arc length (mm)")
    axes.set_ylabel("lumen diameter (mm)")
    axes.grid(alpha=0.25)
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.03), fontsize=8, frameon=False)


def figure_of(profiles: Sequence[tuple[str, ProfileNumbers, Sequence[Mark]]]) -> Figure:
    """Return a figure of profiles below each other, each with its title."""
    check_matplotlib()
    from matplotlib import style
    from matplotlib.figure import Figure

    with style.context("default"):
        count = len(profiles)
        figure = Figure(figsize=(_WIDTH / PER_INCH, count * _HEIGHT / PER_INCH))
        for number, (title, sections, marks) in enumerate(profiles):
            axes = _framed(figure, count - number - 1, count)
            draw(axes, sections, marks)
            axes.set_title(title, loc="left", fontsize=10, parse_math=False)
        return figure


def _framed(figure: Figure, below: int, count: int) -> Axes:
    """Return axes with the margins of the frame, for one of several plots below each other."""
    wide = _WIDTH - _LEGEND - _FRAME["left"] - _FRAME["right"]
    tall = _HEIGHT - _FRAME["above"] - _FRAME["below"]
    left, bottom, height = _FRAME["left"], below * _HEIGHT + _FRAME["below"], count * _HEIGHT
    axes = figure.add_axes((left / _WIDTH, bottom / height, wide / _WIDTH, tall / height))
    axes.tick_params(labelsize=_LETTERS, length=3, pad=2)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_fontsize(_LETTERS)
        axis.labelpad = 1
    return axes


def write(figure: Figure, path: Path) -> None:
    """Write a figure as ``.png`` or ``.svg``; equal figures give equal bytes."""
    import matplotlib as mpl

    kind = path.suffix.lower().removeprefix(".")
    # The metadata contain neither a date nor the address of a web page.
    software = f"lumencut {_lumencut.__version__}"
    metadata: dict[str, Any] = {"Software": software}
    if kind == "svg":
        metadata = {"Date": None, "Creator": software}
    with mpl.rc_context({"svg.hashsalt": "lumencut"}):
        replace_whole(path, lambda whole: figure.savefig(whole, format=kind, dpi=_DPI, metadata=metadata))


def _draw_marks(axes: Axes, marks: Sequence[Mark]) -> None:
    for mark in marks:
        symbol = "D" if mark.is_reference else "v"
        axes.axvline(mark.arc_length, color=_MARKS, lw=0.7, ls="--" if mark.is_suggestion else "-")
        axes.plot(
            [mark.arc_length], [mark.diameter], symbol, color=_MARKS, ms=6,
            mfc="none" if mark.is_suggestion else _MARKS, label=str(mark),
        )  # fmt: skip


def _draw_flags(axes: Axes, flags: Sequence[tuple[str, str, Sequence[Sequence[float]]]], row: float) -> float:
    """Draw a row for each flag that is set somewhere; return the fraction of the height that rows take."""
    for number, (word, color, runs) in enumerate(reversed(flags)):
        height = row * (number + 0.5)
        for ends in runs:
            axes.fill_between(
                ends, height - 0.3 * row, height + 0.3 * row, color=color, lw=0,
                transform=axes.get_xaxis_transform(), clip_on=True,
            )  # fmt: skip
        axes.text(1.01, height, word, color=color, fontsize=8, va="center_baseline", transform=axes.transAxes)
    if flags:
        axes.axhline(0, color="black", lw=0.6)
    return row * len(flags)
