"""Bland-Altman plots, drawn by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lumencut.base.paths import replace_whole
from lumencut.cohort.agreement import Agreement
from lumencut.measuring.profile_plot import check_matplotlib

#: With more points than this, they are drawn as pixels, because a vector picture would be too large.
_AS_PIXELS = 5000


def write_plot(found: Sequence[Agreement], path: Path) -> None:
    """Draw the differences of each agreement over the means, with the mean difference and the limits.

    Parameters
    ----------
    found : sequence of Agreement
        The agreements, drawn one below the other.
    path : Path
        A picture, ``.png`` or ``.svg``.

    Raises
    ------
    MissingPackageError
        Without matplotlib.
    FileError
        If the file cannot be written.
    """
    check_matplotlib()
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 3.2 * len(found)), layout="constrained")
    panels = figure.subplots(len(found), 1, squeeze=False)[:, 0]
    for axes, one in zip(panels, found, strict=True):
        means, count = (one.first + one.second) / 2, len(one.first)
        axes.scatter(means, one.differences, s=6, alpha=0.5, rasterized=count > _AS_PIXELS)
        axes.axhline(one.bias, color="black")
        for limit in one.limits:
            axes.axhline(limit, color="black", linestyle="--")
        axes.set_title(f"{one.quantity}, {count} {one.over} of {len(set(one.studies))} studies")
        axes.set_xlabel("mean of both")
        axes.set_ylabel("second minus first")
    kind = path.suffix.lower().removeprefix(".")
    replace_whole(path, lambda whole: figure.savefig(whole, format=kind, dpi=150))
