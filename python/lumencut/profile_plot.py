"""The diameter of a vessel by its arc length, drawn by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut._files import replace_whole
from lumencut.errors import MissingPackageError
from lumencut.flags import Flag
from lumencut.profile_numbers import ProfileNumbers
from lumencut.profile_sections import Mark, counts, word_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Half width of the uncertainty band (standard deviations), and resolution of pictures (pixels per inch).
_DEVIATIONS, _DPI = 2, 150

#: Size of a plot (inches), left and right edge of its axes (shares), and the other edges (inches).
_WIDTH, _HEIGHT = 10.0, 3.8
_SIDES, _BELOW, _ABOVE = (0.075, 0.65), 0.55, 0.55

_LINE, _LEFT_OUT, _MARKS = "#1f4e9c", "#9a9a9a", "#c8102e"
_FLAGS = {Flag(bit): color for _, bit, _, _, color, _ in _lumencut.MEASURING_FLAGS}


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

    figure, axes = plt.subplots(figsize=(_WIDTH, _HEIGHT))
    figure.subplots_adjust(*_edges(_HEIGHT))
    return axes


def draw(axes: Axes, sections: ProfileNumbers, marks: Sequence[Mark]) -> None:
    """Draw the diameters of sections, their flags and marked places."""
    counted = counts(sections)
    shown = [np.where(counted, values, np.nan) for values in _diameters(sections)]
    wide, low, high = shown
    spread = _DEVIATIONS * np.where(counted, sections.uncertainty, np.nan)
    x = sections.arc_length
    axes.fill_between(x, low, high, color=_LINE, alpha=0.12, lw=0, label="shortest to longest diameter")
    axes.fill_between(
        x,
        wide - spread,
        wide + spread,
        color=_LINE,
        alpha=0.4,
        lw=0,
        label=f"± {_DEVIATIONS} standard deviations (noise and fit)",
    )
    axes.plot(x, wide, color=_LINE, lw=1.6, label="diameter of a circle of the same area")
    # A section between two sections that do not count is drawn as a dot, not as a line.
    lonely = counted & ~np.append(counted[1:], False) & ~np.append(False, counted[:-1])
    axes.plot(x[lonely], wide[lonely], ".", color=_LINE, ms=4)
    top = _top(sections, counted)
    out = np.where(counted, np.nan, _diameters(sections)[0])
    if np.isfinite(out).any():
        axes.plot(
            x, np.where(out < top, out, np.nan), ".", color=_LEFT_OUT, ms=3, mfc="none", mew=0.6,
            label="excluded: see the flags",
        )  # fmt: skip
    limit = 1.5 * sections.fwhm
    if limit < top:
        axes.axhline(limit, color=_LEFT_OUT, lw=0.8, ls=":", label=f"1.5 × FWHM: {limit:.2f} mm")
    _draw_marks(axes, marks)
    below = _draw_flags(axes, sections)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(-below * top / (1 - below), top)
    axes.set_yticks([tick for tick in axes.get_yticks() if 0 <= tick <= top])
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
        height = len(profiles) * _HEIGHT
        figure = Figure(figsize=(_WIDTH, height))
        left, right = _SIDES
        for number, (title, sections, marks) in enumerate(profiles):
            bottom = (len(profiles) - number - 1) * _HEIGHT + _BELOW
            tall = _HEIGHT - _BELOW - _ABOVE
            axes = figure.add_axes((left, bottom / height, right - left, tall / height))
            draw(axes, sections, marks)
            axes.set_title(title, loc="left", fontsize=10, parse_math=False)
        return figure


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


def _diameters(sections: ProfileNumbers) -> tuple[npt.NDArray[np.float64], ...]:
    return sections.diameter_equivalent, sections.diameter_min, sections.diameter_max


def _edges(height: float) -> tuple[float, float, float, float]:
    """Return left, bottom, right and top of the axes (shares of the figure)."""
    return _SIDES[0], _BELOW / height, _SIDES[1], 1 - _ABOVE / height


def _top(sections: ProfileNumbers, counted: npt.NDArray[np.bool_]) -> float:
    """The largest diameter that fits into the plot (mm)."""
    wide = sections.diameter_max[counted]
    if not len(wide):
        wide = sections.diameter_max[np.isfinite(sections.diameter_max)]
    return 1.12 * float(wide.max()) if len(wide) else 1.0


def _draw_marks(axes: Axes, marks: Sequence[Mark]) -> None:
    for mark in marks:
        symbol = "D" if mark.is_reference else "v"
        axes.axvline(mark.arc_length, color=_MARKS, lw=0.7, ls="--" if mark.is_suggestion else "-")
        axes.plot(
            [mark.arc_length], [mark.diameter], symbol, color=_MARKS, ms=6,
            mfc="none" if mark.is_suggestion else _MARKS, label=str(mark),
        )  # fmt: skip


def _draw_flags(axes: Axes, sections: ProfileNumbers) -> float:
    """Draw a row for each flag that is set somewhere, and return the share of the height that rows take."""
    present = [flag for flag in Flag if (sections.flags & int(flag)).any()]
    row = 0.052
    for number, flag in enumerate(present):
        color, height = _FLAGS[flag], row * (number + 0.5)
        for start, width in _runs(sections, flag):
            axes.fill_between(
                [start, start + width], height - 0.3 * row, height + 0.3 * row, color=color, lw=0,
                transform=axes.get_xaxis_transform(), clip_on=True,
            )  # fmt: skip
        axes.text(
            1.01,
            height,
            word_of(flag),
            color=color,
            fontsize=8,
            va="center_baseline",
            transform=axes.transAxes,
        )
    if present:
        axes.axhline(0, color="black", lw=0.6)
    return row * len(present)


def _runs(sections: ProfileNumbers, flag: Flag) -> list[tuple[float, float]]:
    """Where stretches with a flag begin, half a step before their first section, and their lengths (mm)."""
    x = sections.arc_length
    step = float(x[1] - x[0]) if len(x) > 1 else 1.0
    is_set = np.concatenate([[False], (sections.flags & int(flag)) != 0, [False]])
    starts, ends = np.flatnonzero(is_set[1:] & ~is_set[:-1]), np.flatnonzero(is_set[:-1] & ~is_set[1:]) - 1
    return [(float(x[a]) - step / 2, float(x[b] - x[a]) + step) for a, b in zip(starts, ends, strict=True)]
